"""GitHub Classroom's repositories, as `gh classroom clone student-repos` leaves them.

A folder is called after the assignment and the user, `one-lady-ada`. Who that is stands in the
table that Classroom's page of the assignment gives ("Download grades"), with the time of the
submission, or in the one of its roster.
"""

from collections.abc import Iterator
from datetime import tzinfo

from .archive import Contents
from .moments import moment
from .people import Owner, People, Person
from .upload import Upload
from .worksheet import Worksheet


def recognizes(contents: Contents) -> bool:
    """Nothing tells these folders from any others."""
    return False


def uploads(contents: Contents, people: People) -> Iterator[Upload]:
    """Every file of every repository whose name ends with a user of the table, or with an id."""
    for file in contents.files:
        for part in file.path.parts[:-1]:
            owner = _owner(part, people)
            if owner is None:
                continue
            person = people.person(owner)
            received = None if person is None else person.received
            yield Upload(owner, file.path.name, file, received)
            break
        else:
            if len(file.path.parts) > 1:
                yield Upload(Owner(ids=(file.path.parts[0],)), file.path.name, file)


def _owner(folder: str, people: People) -> Owner | None:
    """Whom a repository belongs to: the longest end of its name that is known."""
    pieces = folder.split("-")
    for i in range(len(pieces)):
        owner = Owner(number="-".join(pieces[i:]).casefold(), ids=("-".join(pieces[i:]),))
        if people.person(owner) is not None or people.has_id(owner.ids[0]):
            return owner
    return None


def persons(worksheet: Worksheet, zone: tzinfo | None) -> Iterator[Person]:
    """The users of a table of grades, or of the roster."""
    place = worksheet.column("user")
    for row in worksheet.rows:
        user = row[place].strip()
        if user:
            ids = worksheet.cells(row, "ids", "number", "email")
            owner = Owner(user.casefold(), ids, worksheet.cell(row, "name"))
            yield Person(owner, moment(worksheet.cell(row, "received"), zone))
