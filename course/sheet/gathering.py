"""All files that a student handed in, with those in archives and in the folder of the sheet."""

from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import CourseError
from .archive import ZIP, uploads_in
from .file_names import called_after
from .submissions import READERS
from .upload import OWN_FILE, Upload, is_folder, is_link, on_disk, refuse_links, visible_names

MAX_DEPTH = 4  # folders inside one another, below that of a sheet
MAX_FILES = 500


@dataclass(frozen=True)
class Wanted:
    """Whose file for which sheet is looked for; `sheets` are all of the course."""

    folder: Path
    student: str
    sheet: str
    sheets: tuple[str, ...]

    @property
    def own(self) -> Path:
        """Where the student's files lie."""
        return self.folder / "submitted" / self.student

    def called(self, path: Path) -> str:
        """The sheet that a file is called after."""
        return called_after(path.stem, self.sheets)


def gathered(wanted: Wanted) -> list[Upload]:
    """All that a student handed in, with what lies in archives and in the folder of the sheet."""
    names = visible_names(wanted.own)
    files = [name for name in names if Path(name).suffix.lower() in (*READERS, ZIP)]
    found: list[Upload] = []
    for name in names:
        path = wanted.own / name
        if name.casefold() == wanted.sheet.casefold():
            found += _in_folder(path)
        elif path.suffix.lower() == ZIP:
            found += _in_archive(wanted, path, alone=len(files) == 1)
        elif path.suffix.lower() in READERS:
            found.append(on_disk(path))
    return found


def _in_archive(wanted: Wanted, path: Path, *, alone: bool) -> list[Upload]:
    """What an archive holds; one that is called after nothing is looked into where it is alone.

    One that cannot be looked into is a file that cannot be read.
    """
    called = wanted.called(path)
    if not called and not alone:
        return []
    own = called == wanted.sheet or len(wanted.sheets) == 1
    try:
        refuse_links(path)
        return [replace(one, packed=own) for one in uploads_in(path)]
    except CourseError as error:
        if called not in ("", wanted.sheet):
            return []
        return [refused(path, str(error))]


def _in_folder(folder: Path) -> list[Upload]:
    """The files in the folder of a sheet, and in folders in it."""
    if is_link(folder):
        return [refused(folder, f"{folder} is a link; {OWN_FILE}")]
    found: list[Upload] = []
    waiting = [(folder, MAX_DEPTH)]
    while waiting and len(found) < MAX_FILES:
        place, depth = waiting.pop(0)
        for name in visible_names(place):
            path = place / name
            if depth > 1 and is_folder(path):
                waiting.append((path, depth - 1))
            elif path.suffix.lower() in READERS:
                found.append(on_disk(path, packed=True))
    return found


def refused(path: Path, why: str) -> Upload:
    """What is there and is not read."""
    return Upload(path, path, 0, bytes, packed=True, refusal=why)
