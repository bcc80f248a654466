"""The one folder that a notebook may write to: filled before it, emptied after it."""

import contextlib
import os
import shutil

OPEN = 0o700
MAX_BYTES = 256 << 20  # of all files together, where no file system of its own says so
MAX_ENTRIES = 20_000


def fill(folder, files):
    """Copies of what lies beside the notebook."""
    for name, data in files.items():
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)


def is_too_full(folder):
    """Whether a folder holds more than any sheet asks for; what cannot be looked at counts."""
    if os.path.ismount(folder):  # its size is bounded, and it knows how many files it has
        about = os.statvfs(folder)
        return about.f_files - about.f_ffree > MAX_ENTRIES
    left, count = MAX_BYTES, 0
    waiting = [folder]
    while waiting:
        try:
            entries, folders, size = _looked_at(waiting.pop(), os.path.realpath(folder))
        except (FileNotFoundError, NotADirectoryError):
            continue  # it is gone again
        except OSError:  # a path of more than 4096 characters
            return True
        waiting += folders
        left -= size
        count += entries
        if left < 0 or count > MAX_ENTRIES:
            return True
    return False


def _looked_at(folder, within):
    """How many entries a folder has, those that are folders, and the bytes of all."""
    if not os.access(folder, os.R_OK | os.X_OK):  # its owner took the right to look away
        _open_up(folder, within)
    entries = list(os.scandir(folder))
    folders, size = [], 0
    for entry in entries:
        with contextlib.suppress(FileNotFoundError):  # it is gone again, and the others are not
            size += entry.stat(follow_symlinks=False).st_blocks * 512
        if entry.is_dir(follow_symlinks=False):
            folders.append(entry.path)
    return len(entries), folders, size


def _open_up(folder, within):
    """Takes the right to look into a folder, while the notebook may put a link in its place."""
    handle = os.open(folder, os.O_PATH | os.O_NOFOLLOW | os.O_DIRECTORY)
    try:
        opened = f"/proc/self/fd/{handle}"
        if os.readlink(opened).startswith(f"{within}/"):
            os.chmod(opened, OPEN)
    finally:
        os.close(handle)


def empty(folder):
    """Removes all that lies in a folder; False where that takes more than a simple walk."""
    try:
        os.chmod(folder, OPEN)
        for entry in os.scandir(folder):
            if entry.is_dir(follow_symlinks=False):
                _remove(entry.path)
            else:
                os.unlink(entry.path)
    except (OSError, RecursionError):  # such as thousands of folders in one another
        return False
    return True


def _remove(folder):
    """A folder and all in it, also where its owner took the right to look into it away."""
    os.chmod(folder, OPEN)
    for place, names, _ in os.walk(folder):
        for name in names:
            path = os.path.join(place, name)
            if not os.path.islink(path):
                os.chmod(path, OPEN)
    shutil.rmtree(folder)
