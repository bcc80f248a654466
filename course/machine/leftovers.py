"""What a killed run left, cleared away by the next that has the course folder to itself."""

import os
from collections.abc import Generator, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ...grader.jail.folders import clear_folders
from .files import PART

try:
    import fcntl
except ImportError:  # Windows; there, what is left is only a file too many
    fcntl = None

WRITTEN = (
    "", "report", "exchange", "released/*", "solutions/*", "feedback/*", "submitted", "submitted/*",
)  # fmt: skip
"""Where the commands write files."""


@contextmanager
def cleared(folder: Path) -> Generator[None]:
    """Clears leftovers away, unless another kinegrade is at work in the folder and may need them.

    The others know of this one until it ends, even if it is killed: the system keeps the lock.
    Temporary folders of notebooks that nobody holds any more are cleared away in any case.
    """
    clear_folders()
    if fcntl is None:
        yield
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):  # another is at work, or the file system knows no locks
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            _clear(folder)
        with suppress(OSError):
            fcntl.flock(handle, fcntl.LOCK_SH)
        yield
    finally:
        os.close(handle)


def _clear(folder: Path) -> None:
    for path in _leftovers(folder):
        path.unlink(missing_ok=True)


def _leftovers(folder: Path) -> Iterator[Path]:
    for place in WRITTEN:
        yield from folder.glob(f"{place}/{PART}".lstrip("/"))
