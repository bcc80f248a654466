"""The one folder that a notebook may write to: filled before it, emptied after it."""

import os
import shutil

OPEN = 0o700


def fill(folder, files):
    """Copies of what lies beside the notebook."""
    for name, data in files.items():
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)


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
