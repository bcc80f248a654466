"""nbgrader's folders: submitted/<student>/<assignment>/<notebook>.ipynb with timestamp.txt."""

from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import PurePosixPath

from .archive import Contents, File
from .moments import moment
from .people import Owner
from .upload import Upload

TIMESTAMP = "timestamp.txt"
SUBMITTED = "submitted"


def recognizes(contents: Contents) -> bool:
    """Whether a download is a course folder of nbgrader's, or its submitted/."""
    return any(file.path.name == TIMESTAMP for file in contents.files)


def is_own(file: File) -> bool:
    """Whether a file is nbgrader's own: a time, or in a folder that nobody hands in."""
    return file.path.name == TIMESTAMP or not _below_submitted(file.path)


def uploads(contents: Contents) -> Iterator[Upload]:
    """Every file below a student's assignment; the student is the name of a folder."""
    times: dict[PurePosixPath, datetime | None] = {}
    for file in contents.files:
        if file.path.name == TIMESTAMP:
            text = file.read().decode("utf-8", errors="replace")
            times[file.path.parent] = moment(text, UTC)
    for file in contents.files:
        parts = _below_submitted(file.path)
        if len(parts) < 3 or file.path.name == TIMESTAMP:
            continue
        place = _folder(file.path, parts)
        owner = Owner(ids=(parts[0],))
        yield Upload(owner, file.path.name, file, times.get(place), assignment=parts[1])


def _below_submitted(path: PurePosixPath) -> tuple[str, ...]:
    """The parts of a path from the student on; none where it lies in another folder of a course."""
    if SUBMITTED in path.parts:
        return path.parts[path.parts.index(SUBMITTED) + 1 :]
    if path.parts[0] in ("source", "release", "autograded", "feedback"):
        return ()
    return path.parts


def _folder(path: PurePosixPath, parts: tuple[str, ...]) -> PurePosixPath:
    """The folder of the assignment."""
    return PurePosixPath(*path.parts[: len(path.parts) - len(parts) + 2])
