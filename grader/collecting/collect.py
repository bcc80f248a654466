"""From a notebook to named raw values: the whole interface to student code.

The notebook runs in a jail, in a process of its own that holds no answer and decides nothing; what
it says is checked by wire.py.
"""

import json
import signal
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..jail.jail import FOR_ONE, Jail, on_linux
from ..jail.level import ON_LINUX, Permission
from ..jail.zygote import End, Order
from .ask import Ask, Limits
from .wire import ENDED, Raw, read_frame

RUN = Path(__file__).parents[1] / "inside" / "start.py"
"""Where the student's process begins: it is started by path, never imported."""
SIGKILL = getattr(signal, "SIGKILL", 9)  # Windows has neither, and imports this
SIGSYS = getattr(signal, "SIGSYS", 31)
LITTLE = 0.5  # of the time on the clock: less of the processor, and it did not compute but wait
STOPPED = "the notebook was stopped from outside; it will be run again"
WAITED = (
    "after {seconds:g} s the notebook had computed for {cpu:.1f} s only: "
    "it waited, or this machine was busy; it will be run again"
)
CRASHES = (signal.SIGSEGV, signal.SIGABRT, signal.SIGFPE, signal.SIGILL)
CRASHED = "Python itself crashed before the notebook finished"
FORBIDDEN = "a cell did what no notebook may, and its process was stopped"


def collect(
    notebook: bytes,
    asks: Sequence[Ask],
    limits: Limits | None = None,
    *,
    jail: Jail | None = None,
    beside: Mapping[str, bytes] | None = None,
    script: str = "",
) -> dict[str, Raw]:
    """The asked variables by name, after all cells ran.

    A cell that fails or loops costs only its own variables. A function that is asked with calls is
    called inside, after the cell that sets it and again after the last cell, and comes back as
    `Raw("calls", [Raw, ...])`. A call that fails, loops or returns nonsense costs only itself.
    What is missing because the notebook was stopped from outside is of kind "interrupted".

    A `jail` that is kept saves starting one for every notebook. The notebook sees copies of the
    files `beside` it, by name. With `script`, the name of a .py file, it is run as that.

    Raises:
        JailError: no notebook can run on this machine as it should.
    """
    if jail is None:
        with Jail(Permission(), preload=FOR_ONE) as own:
            return collect(notebook, asks, limits, jail=own, beside=beside, script=script)

    limits = limits or Limits()
    names = [ask.name for ask in asks]
    calls: dict[str, tuple[tuple[Any, ...], ...]] = {}
    for ask in asks:
        if ask.calls:
            calls[ask.name] = ask.calls
    about: dict[str, Any] = {"asks": names, "calls": calls, "script": script}
    about["cell_seconds"] = limits.cell_seconds
    request = _request(about, notebook, beside or {})

    end = jail.run(Order(request, limits.notebook_seconds, limits.memory_mb, limits.file_mb))
    frame = end.frame if end else b""
    counts = {name: len(asked) for name, asked in calls.items()}
    return read_frame(frame, names, _instead(end, limits), counts)


def cannot_run() -> str:
    """Why no notebook can run on this machine; empty where it can."""
    if on_linux():
        return ""
    return f"{ON_LINUX}; .json, .csv and .mat anywhere"


def _request(about: dict[str, Any], notebook: bytes, beside: Mapping[str, bytes]) -> bytes:
    """A line that says what follows it, the notebook, and the files."""
    sizes = [(name, len(data)) for name, data in beside.items()]
    line = json.dumps(about | {"size": len(notebook), "beside": sizes}, default=_plain)
    return b"".join([line.encode(), b"\n", notebook, *beside.values()])


def _plain(array: Any) -> Any:
    return array.tolist()


def _instead(end: End | None, limits: Limits) -> Raw | None:
    """What stands for the values that did not come; None where the notebook ended by itself.

    It is no fault of the notebook's when somebody else stops it, or lets it wait.
    """
    if end is None:
        return Raw("interrupted", STOPPED)
    seconds = limits.notebook_seconds
    if end.clock:
        return _at_its_time(end, seconds)
    if end.stopped:
        return Raw("error", end.stopped)
    if end.signal == SIGKILL and end.cpu < seconds:
        return Raw("interrupted", STOPPED)
    if end.signal:
        said = {
            SIGSYS: FORBIDDEN,
            SIGKILL: f"the notebook computed for more than {seconds:g} s",
        }
        said |= dict.fromkeys(CRASHES, CRASHED)
        return Raw("error", said.get(end.signal, ENDED))
    return None


def _at_its_time(end: End, seconds: float) -> Raw:
    """What is said of a notebook that we stopped by the clock."""
    if end.cpu < LITTLE * seconds:
        return Raw("interrupted", WAITED.format(seconds=seconds, cpu=end.cpu))
    return Raw("error", f"the notebook was stopped after {seconds:g} s")
