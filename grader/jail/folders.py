"""Temporary folders of notebooks: held by whoever made one, and cleared away when that is gone."""

import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows runs no notebooks
    fcntl = None

PREFIX = "kinegrade-notebooks-"
NEW_SECONDS = 5  # a folder this young may not be held yet
_held: dict[str, int] = {}
"""Descriptors of the folders of this process, whose locks end with it, even if it is killed."""


def new_folder() -> Path:
    """A folder of our own, known to be in use."""
    folder = Path(tempfile.mkdtemp(prefix=PREFIX)).resolve()
    if fcntl is not None:
        handle = os.open(folder, os.O_RDONLY)
        _held[str(folder)] = handle
        with suppress(OSError):  # the file system knows no locks
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    return folder


def remove(folder: str) -> None:
    """Removes a folder, whatever was put into it."""
    if not folder:
        return
    if folder in _held:
        os.close(_held.pop(folder))
    if not Path(folder).is_dir():
        return
    try:
        shutil.rmtree(folder)
    except (OSError, RecursionError):  # folders in one another, or without the right to look in
        for words in (["/bin/chmod", "-R", "u+rwX"], ["/bin/rm", "-rf"]):
            subprocess.run(  # noqa: S603 - our own folder
                [*words, "--", folder], check=False, stderr=subprocess.DEVNULL
            )


def clear_folders() -> None:
    """Removes the folders of processes that were killed with all that could have done so."""
    if fcntl is None:
        return
    for folder in _ours():
        with suppress(OSError):  # it is held, or gone by now
            handle = os.open(folder, os.O_RDONLY | os.O_NOFOLLOW)
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                remove(str(folder))
            finally:
                os.close(handle)


def _ours() -> Iterator[Path]:
    """Folders of that name that are this user's, and not made just now."""
    young = time.time() - NEW_SECONDS
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        with suppress(OSError):
            about = folder.lstat()
            if about.st_uid == os.getuid() and about.st_mtime < young and folder.is_dir():
                yield folder
