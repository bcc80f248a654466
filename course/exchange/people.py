"""Who is meant: ids first, then names, and nobody where two are called so or ids disagree."""

import re
import unicodedata
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import datetime

from ..settings.config import Student

WORD = re.compile(r"[^\W_]+")


@dataclass(frozen=True)
class Owner:
    """Whose file it is, as a system says it.

    Attributes:
        number: The system's own number of a person, such as Moodle's participant number.
        ids: What may be the id of the roster, or a text in another column of it.
        name: The name, in whatever order and writing.
    """

    number: str = ""
    ids: tuple[str, ...] = ()
    name: str = ""


@dataclass(frozen=True)
class Person:
    """A line of the table of people that a system exported; `received` is when the file came in."""

    owner: Owner
    received: datetime | None = None


class UnknownPersonError(Exception):
    """Nobody of the roster, or not only one, is meant; the sentence says why."""


class People:
    """The roster, and what a system's table says of numbers."""

    def __init__(self, students: Sequence[Student], table: Iterable[Person] = ()) -> None:
        """Takes the roster and the lines of a table."""
        self._ids: dict[str, set[Student]] = {}
        for student in students:
            for text in (student.id, *(text for _, text in student.more)):
                if text:
                    self._ids.setdefault(text.casefold(), set()).add(student)
        self._students = students
        self._persons: dict[str, Person] = {}
        for person in table:
            self._persons[person.owner.number] = person

    def person(self, owner: Owner) -> Person | None:
        """The line of the table with the owner's number."""
        return self._persons.get(owner.number) if owner.number else None

    def has_id(self, text: str) -> bool:
        """Whether somebody of the roster has this id, or this text in another column."""
        return text.casefold() in self._ids

    def knows(self, owner: Owner) -> bool:
        """Whether the table says who the owner is; where markers are blind, it does not."""
        person = self.person(owner)
        return person is not None and bool(person.owner.name or person.owner.ids)

    def student(self, owner: Owner) -> Student:
        """The student of the roster who is meant.

        Raises:
            UnknownPersonError: nobody is, or it cannot be told who.
        """
        person = self.person(owner)
        ids, names = [*owner.ids], [owner.name]
        if person is not None:
            ids += person.owner.ids
            names.insert(0, person.owner.name)
        by_id = self._by_ids(ids)
        if by_id is not None:
            self._refuse_another_name(by_id, owner.name)
            return by_id
        for name in names:
            found = self._by_name(name)
            if len(found) == 1:
                return found[0]
            if found:
                ids_of = ", ".join(student.id for student in found)
                raise UnknownPersonError(
                    f"{len(found)} people of the roster are called so ({ids_of}), "
                    "and no id tells them apart"
                )
        raise UnknownPersonError("nobody of roster.csv")

    def find(self, owner: Owner) -> Student | None:
        """The student who is meant; None where it cannot be told."""
        try:
            return self.student(owner)
        except UnknownPersonError:
            return None

    def _by_ids(self, ids: Iterable[str]) -> Student | None:
        """The one student to whom the ids belong; those of several people say nothing."""
        found: dict[str, str] = {}
        students: dict[str, Student] = {}
        for text in ids:
            owners = self._ids.get(text.strip().casefold(), set())
            if len(owners) == 1:
                (student,) = owners
                students[student.id] = student
                found.setdefault(student.id, text)
        if len(students) > 1:
            said = ", ".join(f"{text} is {student}" for student, text in found.items())
            raise UnknownPersonError(f"its ids are those of several people: {said}")
        return next(iter(students.values()), None)

    def _refuse_another_name(self, student: Student, name: str) -> None:
        """Numbers of one assignment mean other people in the table of another."""
        named = self._by_name(name)
        if named and student not in named:
            raise UnknownPersonError(
                f"its number or id is that of {student.id}, and its name that of {named[0].id}; "
                "the table may be that of another assignment"
            )

    def _by_name(self, name: str) -> list[Student]:
        """Everybody of that name; a group may stand in front of it, with a hyphen."""
        pieces = name.split("-")
        for i in range(len(pieces)):
            keys = name_keys("-".join(pieces[i:]))
            found = [student for student in self._students if keys & name_keys(student.name)]
            if found:
                return found
        return []


def name_keys(name: str) -> set[str]:
    """A name without spaces, accents and capitals, its words in every rotation.

    So "Lovelace, Ada" is "Ada Lovelace", and both are Canvas's "lovelaceada".
    """
    plain = unicodedata.normalize("NFKD", name.casefold())
    letters = "".join(char for char in plain if not unicodedata.combining(char))
    words = WORD.findall(letters)
    keys: set[str] = set()
    for i in range(len(words)):
        keys.add("".join(words[i:] + words[:i]))
    return keys
