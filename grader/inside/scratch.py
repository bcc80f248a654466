"""The one folder that a notebook may write to: filled before it, emptied after it."""

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
    left, count = MAX_BYTES, 0
    waiting = [folder]
    while waiting:
        try:
            entries = list(os.scandir(waiting.pop()))
            count += len(entries)
            for entry in entries:
                left -= entry.stat(follow_symlinks=False).st_blocks * 512
                if entry.is_dir(follow_symlinks=False):
                    waiting.append(entry.path)
        except (FileNotFoundError, NotADirectoryError, PermissionError):
            continue  # it is gone again, or nobody can write there either
        except OSError:  # a path of more than 4096 characters
            return True
        if left < 0 or count > MAX_ENTRIES:
            return True
    return False


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
