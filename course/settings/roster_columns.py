"""Which columns of a roster hold ids and names: ours, and those that other systems export."""

from collections.abc import Sequence
from dataclasses import dataclass

STUDENT = "student"
IDS = (
    STUDENT, "student id", "studentid", "student number", "matrikelnummer", "matrikel-nr.",
    "matrikelnr.", "matrikelnr", "matrikel", "matr.-nr.", "kennung", "id number", "idnumber",
    "id-nummer", "sis user id", "sid", "username", "user name", "benutzername", "anmeldename",
    "login", "sis login id", "id",
)  # fmt: skip
"""What a column of ids is called, in small letters; the first that is there and filled counts."""
NAMES = (
    "name", "full name", "fullname", "student name", "vollständiger name", "nom complet",
    "nombre completo", "nome completo",
)  # fmt: skip
FIRST_NAMES = ("first name", "first name(s)", "firstname", "given name", "vorname", "prénom")
LAST_NAMES = ("last name", "lastname", "surname", "family name", "nachname", "nom")
CANVAS = ("student", "id", "section")
CANVAS_IDS = ("sis user id", "sis login id", "id")
CANVAS_NOBODY = ("points possible", "student, test")
"""What an exported gradebook of Canvas has among its students."""


@dataclass(frozen=True)
class Columns:
    """Places of columns.

    Attributes:
        ids: Those that may hold ids; the first that everybody has counts.
        names: Those that make a name together.
        more: All others that are kept.
        nobody: Names in small letters of lines that are no people.
    """

    ids: tuple[int, ...]
    names: tuple[int, ...]
    more: tuple[int, ...]
    nobody: tuple[str, ...] = ()


def roster_columns(heading: Sequence[str]) -> Columns:
    """The columns of a first line; without ids or names where none is called so."""
    plain = [" ".join(cell.split()).casefold() for cell in heading]
    if _is_of_canvas(plain):
        return _of_canvas(plain)
    ids = _places(plain, IDS)
    if STUDENT in plain:
        ids = ids[:1]
    names = _places(plain, NAMES)[:1]
    if not names:
        names = _places(plain, FIRST_NAMES)[:1] + _places(plain, LAST_NAMES)[:1]
    kept = [i for i, cell in enumerate(plain) if cell and i not in names]
    return Columns(ids, names, tuple(kept))


def _is_of_canvas(plain: Sequence[str]) -> bool:
    """Whether it is an exported gradebook of Canvas, in which `Student` is a name."""
    return set(CANVAS) <= set(plain) and not set(NAMES) & set(plain)


def _of_canvas(plain: Sequence[str]) -> Columns:
    """Grades, which stand behind the section, are no part of a roster."""
    kept = [i for i in range(plain.index("section") + 1) if plain[i] not in ("", "student")]
    names = (plain.index("student"),)
    return Columns(_places(plain, CANVAS_IDS), names, tuple(kept), CANVAS_NOBODY)


def _places(plain: Sequence[str], headings: Sequence[str]) -> tuple[int, ...]:
    """Where these headings stand, in the order in which they are preferred."""
    return tuple(plain.index(heading) for heading in headings if heading in plain)
