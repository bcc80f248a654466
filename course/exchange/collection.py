"""A download taken into a course: which system it is from, and how that one is read."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, tzinfo
from pathlib import Path

from ..errors import CourseError
from ..machine.console import counted
from ..settings.config import Course
from ..text.escape import printable
from . import canvas, classroom, gradescope, moodle, nbgrader
from .archive import Contents, File, opened_download
from .claims import look
from .people import People, Person
from .taking import Taken, take
from .upload import Upload
from .worksheet import Worksheet, read_worksheet


@dataclass(frozen=True)
class System:
    """How a system's downloads are read.

    Attributes:
        recognizes: Whether a download is from it.
        uploads: The files of a download with their owners.
        persons: The lines of its table of people.
        without_times: What is said where files came in without a time.
        is_late: Whether the system calls a file late of which it says no time.
        is_own: Whether a file is the system's, which nobody handed in.
    """

    recognizes: Callable[[Contents], bool]
    uploads: Callable[[Contents, People], Iterator[Upload]]
    persons: Callable[[Worksheet, tzinfo | None], Iterator[Person]]
    without_times: str
    is_late: Callable[[Upload], bool] = lambda _: False
    is_own: Callable[[File], bool] = lambda _: False


@dataclass(frozen=True)
class Wanted:
    """What is said of a download.

    Attributes:
        system: Which system it is from; empty where that is to be found out.
        worksheet: The table of people that the system exported.
        sheet: Which sheet files are for that do not say so.
        zone: Of times that name none; None is the machine's.
        received: When files came in of which the download says no time.
    """

    system: str = ""
    worksheet: Path | None = None
    sheet: str = ""
    zone: tzinfo | None = None
    received: datetime | None = None


def _no_table(worksheet: Worksheet, _: tzinfo | None) -> Iterator[Person]:
    raise CourseError(f"{worksheet.path}: this system's download says itself whose files it holds")


SYSTEMS: dict[str, System] = {
    "moodle": System(
        moodle.recognizes,
        moodle.uploads,
        moodle.persons,
        "the times of submission stand in the grading worksheet: --worksheet W.csv",
    ),
    "canvas": System(
        canvas.recognizes,
        lambda contents, _: canvas.uploads(contents),
        lambda worksheet, _: canvas.persons(worksheet),
        "Canvas's download has none: --received TIME",
        canvas.is_late,
    ),
    "gradescope": System(
        gradescope.recognizes,
        lambda contents, _: gradescope.uploads(contents),
        _no_table,
        "the export names none for them",
        is_own=gradescope.is_own,
    ),
    "nbgrader": System(
        nbgrader.recognizes,
        lambda contents, _: nbgrader.uploads(contents),
        _no_table,
        "there is no timestamp.txt beside them",
        is_own=nbgrader.is_own,
    ),
    "classroom": System(
        classroom.recognizes,
        classroom.uploads,
        classroom.persons,
        "the times of submission stand in the table of grades: --worksheet GRADES.csv",
    ),
}


def collect(course: Course, download: Path, wanted: Wanted | None = None) -> Taken:
    """Takes the newest answers of a download into submitted/, with the times that it has.

    Raises:
        CourseError: the download, the worksheet or one of the names cannot be meant.
    """
    wanted = wanted or Wanted()
    if wanted.sheet:
        course.sheets((wanted.sheet,))
    with opened_download(download) as contents:
        system = _system(download, contents, wanted.system)
        people = _people(course, system, wanted)
        found = [_timed(upload, system, wanted) for upload in system.uploads(contents, people)]
        taken = take(course, look(course, people, found, wanted.sheet))
        taken.conflicts[:0] = contents.refused
        taken.notes += _on_strangers(system, contents, found)
    taken.notes += _on_times(system, found)
    return taken


def _people(course: Course, system: System, wanted: Wanted) -> People:
    """The roster, with what the system's table says of numbers."""
    if wanted.worksheet is None:
        return People(course.students)
    table = system.persons(read_worksheet(wanted.worksheet), wanted.zone)
    return People(course.students, table)


def _on_strangers(system: System, contents: Contents, found: Sequence[Upload]) -> Iterator[str]:
    """What is said of files of which the download does not say whose they are."""
    known = {upload.file.path for upload in found}
    for file in contents.files:
        if file.path not in known and not system.is_own(file):
            place = printable(str(file.path))
            yield f"{place}: not called as this system calls what is handed in; not taken"


def _on_times(system: System, found: Sequence[Upload]) -> Iterator[str]:
    """What is said of files that came late, or without a time."""
    late = [upload.place for upload in found if system.is_late(upload)]
    if late:
        yield f"Called late there: {', '.join(late)}"
    timeless = [upload for upload in found if upload.received is None]
    if timeless:
        files = counted(len(timeless), "file", "files")
        yield f"{files} came without a time; {system.without_times}"


def _timed(upload: Upload, system: System, wanted: Wanted) -> Upload:
    """With the time that was said for all, where the download has none and does not say late."""
    if upload.received is not None or system.is_late(upload):
        return upload
    return replace(upload, received=wanted.received)


def _system(download: Path, contents: Contents, name: str) -> System:
    if name:
        if name not in SYSTEMS:
            raise CourseError(f"--from takes one of {', '.join(SYSTEMS)}, got {name!r}")
        return SYSTEMS[name]
    for system in SYSTEMS.values():
        if system.recognizes(contents):
            return system
    raise CourseError(
        f"{download}: this is not known as the download of a system; "
        f"--from says which one it is from: {', '.join(SYSTEMS)}"
    )
