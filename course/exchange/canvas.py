"""Canvas's "Download Submissions", and the people of its gradebook.

Files are called `lovelaceada_4711_88001_one.ipynb`: the name in small letters without spaces,
`_LATE` where Canvas calls it late, Canvas's number of the person and that of the file, and the
file's own name, with `-1` at its end where it was handed in again. Where markers are blind,
`anon_Xy12z` stands in place of name and number. The zip does not say when files came in.
"""

import re
from collections.abc import Iterator

from .archive import Contents
from .people import Owner, Person
from .upload import Upload
from .worksheet import Worksheet

FILE = re.compile(
    r"(?P<name>.+?)(?:_LATE)?_(?P<number>\d+)_(?P<attachment>\d+)_(?P<file>.+)", re.DOTALL
)
BLIND = re.compile(r"anon_(?P<alias>\w{5})(?:_LATE)?_(?P<attachment>\d+)_(?P<file>.+)", re.DOTALL)
NOBODY = ("points possible", "student, test", "test student")
"""What Canvas's gradebook has among its students."""


def recognizes(contents: Contents) -> bool:
    """Whether a download is Canvas's, which has no folders."""
    names = [file.path for file in contents.files if len(file.path.parts) == 1]
    return any(FILE.fullmatch(path.name) or BLIND.fullmatch(path.name) for path in names)


def uploads(contents: Contents) -> Iterator[Upload]:
    """Every file of the download."""
    for file in contents.files:
        found = FILE.fullmatch(file.path.name)
        blind = BLIND.fullmatch(file.path.name)
        if found is not None:
            number = found["number"]
            owner = Owner(number=number, ids=(number,), name=found["name"])
            yield Upload(owner, found["file"], file)
        elif blind is not None:
            owner = Owner(number=f"anon_{blind['alias']}")
            yield Upload(owner, blind["file"], file)


def is_late(upload: Upload) -> bool:
    """Whether Canvas calls a file late."""
    start = upload.file.path.name.removesuffix(upload.name)
    return "_LATE_" in start


def persons(worksheet: Worksheet) -> Iterator[Person]:
    """The students of an exported gradebook."""
    place = worksheet.column("number")
    for row in student_rows(worksheet):
        ids = worksheet.cells(row, "ids", "email", "number")
        yield Person(Owner(row[place].strip(), ids, worksheet.cell(row, "name")))


def student_rows(worksheet: Worksheet) -> Iterator[tuple[str, ...]]:
    """The lines of an exported gradebook that are students."""
    place = worksheet.column("number")
    for row in worksheet.rows:
        name = worksheet.cell(row, "name").casefold()
        if row[place].strip() and name not in NOBODY:
            yield row
