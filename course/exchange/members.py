"""The lines of an exported table, each with the student of the roster who is meant."""

from collections.abc import Iterable
from dataclasses import dataclass

from ..errors import CourseError
from ..machine.console import say
from ..settings.config import Course, Student
from .people import Owner, People, UnknownPersonError
from .worksheet import Worksheet


@dataclass(frozen=True)
class Member:
    """One line of a table; `student` is None where nobody of the roster is meant."""

    row: tuple[str, ...]
    student: Student | None


def members(course: Course, worksheet: Worksheet, rows: Iterable[tuple[str, ...]]) -> list[Member]:
    """The people of a table; those of whom it cannot be told who they are are said.

    Raises:
        CourseError: nobody of the roster is among them.
    """
    people = People(course.students)
    found: list[Member] = []
    for row in rows:
        name = worksheet.cell(row, "name")
        owner = Owner(ids=worksheet.cells(row, "ids", "email", "number"), name=name)
        try:
            found.append(Member(row, people.student(owner)))
        except UnknownPersonError as error:
            who = " ".join(filter(None, [worksheet.cell(row, "number"), name]))
            who = who or ", ".join(filter(None, row))  # no column is known, so all that it has
            say(f"{worksheet.path}: {who}: {error}; left as it is.")
            found.append(Member(row, None))
    if all(member.student is None for member in found):
        raise CourseError(f"{worksheet.path}: nobody of roster.csv is in it")
    return found
