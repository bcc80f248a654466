"""Marks that were given by hand."""

from collections.abc import Iterable
from dataclasses import dataclass

from sqlalchemy import Connection, RowMapping, select

from .damage import Damages, is_whole, plain, text_of
from .entries import Change, enter
from .tables import entry, mark


@dataclass(frozen=True)
class Mark:
    """What a marker gave by hand for one answer.

    `answer` names the one that was read, so that another answer needs another mark. Without points
    it is a comment alone. `ticks` are the lines of the rubric that were met, as "1,3".
    """

    student: str
    sheet: str
    part: str
    points: float | None
    comment: str
    answer: str
    ticks: str = ""


def save(connection: Connection, marks: Iterable[Mark], change: Change) -> None:
    """Adds marks, with one entry for all; a mark that says what the last one said adds nothing."""
    number = 0
    for one in marks:
        row = {**vars(one), "comment": plain(one.comment)}
        if _last(connection, one) == row:
            continue
        number = number or enter(connection, change)
        connection.execute(mark.insert().values(entry=number, **row))


def _last(connection: Connection, one: Mark) -> dict[str, object] | None:
    columns = [column for column in mark.c if column.name != "entry"]
    place = (mark.c.student == one.student, mark.c.sheet == one.sheet, mark.c.part == one.part)
    query = select(*columns).where(*place).order_by(mark.c.entry.desc()).limit(1)
    row = connection.execute(query).mappings().first()
    if row is None:
        return None
    return dict(row)


@dataclass(frozen=True)
class Differing:
    """One answer, and the points that several markers gave for it, by marker."""

    student: str
    sheet: str
    part: str
    points: dict[str, float]


def differing(connection: Connection, sheet: str) -> list[Differing]:
    """Answers to which markers gave other points; of each marker, the last ones."""
    query = select(mark, entry.c.author).join(entry, entry.c.id == mark.c.entry)
    rows = connection.execute(query.where(mark.c.sheet == sheet).order_by(mark.c.entry))
    given: dict[tuple[str, str, str], dict[str, float]] = {}
    for row in rows.mappings():
        points = row["points"]
        if points is not None and is_whole(row, mark):
            place = (row["student"], row["part"], row["answer"])
            given.setdefault(place, {})[row["author"]] = points
    found: list[Differing] = []
    for (student, part, _), points in given.items():
        if len(set(points.values())) > 1:
            found.append(Differing(student, sheet, part, points))
    return found


def that_count(connection: Connection, sheet: str, damages: Damages) -> dict[tuple[str, str], Mark]:
    """The last mark of every part that has one, by student and part."""
    last: dict[tuple[str, str], RowMapping] = {}
    rows = connection.execute(select(mark).where(mark.c.sheet == sheet).order_by(mark.c.entry))
    for row in rows.mappings():
        last[row["student"], row["part"]] = row

    marks: dict[tuple[str, str], Mark] = {}
    for (student, part), row in last.items():
        points = row["points"]
        if not is_whole(row, mark) or (points is not None and points < 0):
            what = f"the mark of {text_of(part, 'a part')}"
            damages.add("mark", sheet, student, what, "`kinegrade marks set` enters it")
            continue
        marks[student, part] = Mark(
            student, sheet, part, points, row["comment"], row["answer"], row["ticks"]
        )
    return marks
