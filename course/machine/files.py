"""Writing files so that nobody ever sees half of one."""

import os
import tempfile
from pathlib import Path

PART = ".*.part"
"""What files are called that are not complete yet."""


def write_atomically(
    path: Path, data: bytes | str, mode: int = 0o644, *, synced: bool = True
) -> None:
    """The whole new content or the old: written under a temporary name, synced, then renamed.

    What is not `synced` may be empty after a power cut: for files that are made anew where they do
    not hold what they should.

    Raises:
        OSError: it cannot be written; its filename is set, also where the system names none.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(data, str):
        # A student's text may hold half a surrogate pair, for which a question mark stands.
        data = data.encode("utf-8", errors="replace")
    try:
        _write(path, data, mode, synced=synced)
    except OSError as error:
        error.filename = str(path)  # a full disk names no file, and ours is a temporary one
        raise


def _write(path: Path, data: bytes, mode: int, *, synced: bool) -> None:
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            if synced:
                file.flush()
                os.fsync(file.fileno())
        os.chmod(name, mode)  # noqa: PTH101 - mkstemp gives 0600; a sheet is for its student
        os.replace(name, path)  # noqa: PTH105
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
