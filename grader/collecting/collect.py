"""From a notebook to named raw values: the whole interface to student code.

The notebook runs in a process of its own that holds no answer: a clean environment, an empty
folder, limits on processor time, memory, file size, output and the wall clock, and an alarm for
every cell.
"""

import json
import os
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Generator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from .ask import Ask, Limits
from .wire import Raw, read_frame

try:
    import resource
except ImportError:  # Windows; there, files of matrices are marked all the same
    resource = None

RUNNER = Path(__file__).with_name("runner.py")
MAX_FRAME = 2 << 20
MAX_NOTEBOOK = 20 << 20


def collect(notebook: bytes, asks: Sequence[Ask], limits: Limits | None = None) -> dict[str, Raw]:
    """The asked variables by name, after all cells ran.

    A cell that fails or loops costs only its own variables. A function that is asked with calls is
    called inside, after the cell that sets it and again after the last cell, and comes back as
    `Raw("calls", [Raw, ...])`. A call that fails, loops or returns nonsense costs only itself.
    """
    limits = limits or Limits()
    names = [ask.name for ask in asks]
    reason = cannot_run()
    if len(notebook) > MAX_NOTEBOOK:
        reason = (
            f"the file has {len(notebook) >> 20} MB; a notebook may have {MAX_NOTEBOOK >> 20} MB"
        )
    if reason:
        return {name: Raw("error", reason) for name in names}

    calls: dict[str, tuple[tuple[Any, ...], ...]] = {}
    for ask in asks:
        if ask.calls:
            calls[ask.name] = ask.calls
    request = {
        "notebook": notebook.decode("utf-8-sig", errors="replace"),
        "asks": names,
        "calls": calls,
        "cell_seconds": limits.cell_seconds,
    }
    frame, why = _run(json.dumps(request, default=_plain).encode(), limits)
    return read_frame(frame, names, why, {name: len(asked) for name, asked in calls.items()})


def cannot_run() -> str:
    """Why no notebook can run on this machine; empty where it can."""
    if hasattr(resource, "prlimit"):
        return ""
    return (
        "notebooks are marked on Linux (on Windows: WSL2, on macOS: a Linux machine); "
        ".json, .csv and .mat anywhere"
    )


def _plain(array: Any) -> Any:
    return array.tolist()


def _run(request: bytes, limits: Limits) -> tuple[bytes, str]:
    """The last complete frame that the runner wrote, and why it was stopped.

    The reason is empty where the runner ended by itself.
    """
    with _scratch() as folder:
        ours, theirs = os.pipe()
        try:
            process = _started(folder, theirs)
        finally:
            os.close(theirs)
        _limit(process.pid, limits)
        try:
            return _exchange(process, ours, request, limits.notebook_seconds)
        finally:
            os.close(ours)
            _end(process)


def _started(folder: str, pipe: int) -> "subprocess.Popen[bytes]":
    return subprocess.Popen(  # noqa: S603 - the interpreter and our own runner
        [sys.executable, "-I", str(RUNNER), str(pipe)],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        pass_fds=(pipe,),
        cwd=folder,
        env=_environment(folder),
        start_new_session=True,  # so that _end reaches what the notebook started, too
    )


@contextmanager
def _scratch() -> Generator[str]:
    """An empty folder that is gone afterwards, whatever was put into it."""
    folder = tempfile.mkdtemp(prefix="notebook-")
    try:
        yield folder
    finally:
        try:
            shutil.rmtree(folder, ignore_errors=True)
        except RecursionError:  # thousands of folders in one another
            command = ["/bin/rm", "-rf", "--", folder]
            subprocess.run(command, check=False)  # noqa: S603 - our own folder


def _environment(folder: str) -> dict[str, str]:
    return {
        "PATH": "/usr/bin:/bin",
        "HOME": folder,
        "TMPDIR": folder,
        "LANG": "C.UTF-8",
        "MPLBACKEND": "Agg",
        "MPLCONFIGDIR": folder,
        "OPENBLAS_NUM_THREADS": "1",  # one thread starts faster and fits the memory limit
        "OMP_NUM_THREADS": "1",
    }


def _limit(pid: int, limits: Limits) -> None:
    assert resource is not None  # noqa: S101 - cannot_run has said so
    megabyte = 1 << 20
    most = {
        resource.RLIMIT_CPU: int(limits.notebook_seconds) + 1,
        resource.RLIMIT_AS: limits.memory_mb * megabyte,
        resource.RLIMIT_FSIZE: limits.file_mb * megabyte,
        resource.RLIMIT_NOFILE: 128,
        resource.RLIMIT_CORE: 0,
    }
    for what, amount in most.items():
        resource.prlimit(pid, what, (amount, amount))


def _exchange(
    process: "subprocess.Popen[bytes]", ours: int, request: bytes, seconds: float
) -> tuple[bytes, str]:
    """Hands the request over and reads frames until the runner ends.

    Only the newest complete frame is kept.
    """
    end = time.monotonic() + seconds
    _hand_over(process, request)
    buffer = newest = b""
    while True:
        left = end - time.monotonic()
        if left <= 0:
            return newest, f"the notebook was stopped after {seconds:g} s"
        ready, _, _ = select.select([ours], [], [], left)
        if not ready:
            continue

        chunk = os.read(ours, 1 << 16)
        if not chunk:
            return newest, ""
        buffer += chunk

        # A frame is eight bytes of length and as many bytes as they say.
        while len(buffer) >= 8:
            length = int.from_bytes(buffer[:8], "little")
            if length > MAX_FRAME:
                return newest, "the notebook wrote more than its answers can hold"
            if len(buffer) < 8 + length:
                break
            newest = buffer[8 : 8 + length]
            buffer = buffer[8 + length :]


def _hand_over(process: "subprocess.Popen[bytes]", request: bytes) -> None:
    assert process.stdin is not None  # noqa: S101 - Popen was given a pipe
    # It may end before reading; the empty frame says so.
    with suppress(BrokenPipeError), process.stdin as pipe:
        pipe.write(request)


def _end(process: "subprocess.Popen[bytes]") -> None:
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    # A tracer in the student's session could hold the dead process back.
    with suppress(subprocess.TimeoutExpired):
        process.wait(timeout=5)
