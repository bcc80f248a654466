"""A download taken into a course: which system it is from, and how that one is read."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import tzinfo
from pathlib import Path

from ..config import Course
from ..errors import CourseError
from . import moodle
from .archive import Contents, opened_download
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
        uploads: The files of a download with their owners; a time without a zone is in the given.
        persons: The lines of its table of people.
        without_times: What is said where files came in without a time.
    """

    recognizes: Callable[[Contents], bool]
    uploads: Callable[[Contents, People, tzinfo | None], Iterator[Upload]]
    persons: Callable[[Worksheet, tzinfo | None], Iterator[Person]]
    without_times: str


SYSTEMS: dict[str, System] = {
    "moodle": System(
        moodle.recognizes,
        lambda contents, people, _: moodle.uploads(contents, people),
        moodle.persons,
        "the times of submission stand in the grading worksheet: --worksheet W.csv",
    ),
}


def collect(
    course: Course,
    download: Path,
    system: str = "",
    worksheet: Path | None = None,
    sheet: str = "",
    zone: tzinfo | None = None,
) -> Taken:
    """Takes the newest answers of a download into submitted/, with the times that it has.

    Raises:
        CourseError: the download, the worksheet or one of the names cannot be meant.
    """
    if sheet:
        course.sheets((sheet,))
    with opened_download(download) as contents:
        chosen = _system(download, contents, system)
        table: list[Person] = []
        if worksheet is not None:
            table += chosen.persons(read_worksheet(worksheet), zone)
        people = People(course.students, table)
        found = list(chosen.uploads(contents, people, zone))
        taken = take(course, look(course, people, found, sheet))
        taken.conflicts[:0] = contents.refused
    timeless = [upload for upload in found if upload.received is None]
    if timeless:
        taken.notes.append(f"{len(timeless)} files came without a time; {chosen.without_times}")
    return taken


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
