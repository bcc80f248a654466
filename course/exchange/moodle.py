"""Moodle's "Download all submissions", and the people of its grading worksheet.

Folders are called `Full Name_12345_assignsubmission_file` (before 4.1 with one more `_`); without
folders the name of the file follows. 12345 is Moodle's own number of a participant in this
assignment. A group may stand in front of the name, and for blind marking the word for
"Participant" in its place.
"""

import re
from collections.abc import Iterator
from datetime import tzinfo
from pathlib import PurePosixPath

from .archive import Contents, File
from .moments import moment
from .people import Owner, People, Person
from .upload import Upload
from .worksheet import Worksheet, digits_at_end

FOLDER = re.compile(
    r"(?P<name>[^_]*)_(?P<number>\d+)_assign(?:submission|feedback)_(?P<plugin>[a-z]+)(?:_(?P<file>.*))?",
    re.DOTALL,
)


def recognizes(contents: Contents) -> bool:
    """Whether a download is Moodle's."""
    return any(_folder(file.path) for file in contents.files)


def uploads(contents: Contents, people: People) -> Iterator[Upload]:
    """Every file of the download; its time is that of the worksheet."""
    for file in contents.files:
        found = _folder(file.path)
        if found is None:
            continue
        owner = Owner(number=found["number"], name=found["name"])
        person = people.person(owner)
        received = None if person is None else person.received
        yield Upload(owner, _name(file, found), file, received)


def _folder(path: PurePosixPath) -> re.Match[str] | None:
    """The part of a path that names a participant."""
    for part in path.parts:
        found = FOLDER.fullmatch(part)
        if found is not None:
            return found
    return None


def _name(file: File, found: re.Match[str]) -> str:
    """What the student called the file; without folders it follows the participant."""
    if found[0] == file.path.name and found["file"]:
        return found["file"]
    return file.path.name


def persons(worksheet: Worksheet, zone: tzinfo | None) -> Iterator[Person]:
    """The participants of a grading worksheet, with the times of their submissions."""
    place = worksheet.column("number")
    for row in worksheet.rows:
        owner = Owner(
            number=digits_at_end(row[place]),
            ids=worksheet.cells(row, "ids", "email"),
            name=worksheet.cell(row, "name"),
        )
        if owner.number:
            yield Person(owner, moment(worksheet.cell(row, "received"), zone))
