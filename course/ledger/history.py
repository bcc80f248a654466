"""What happened to a student's sheet: drawn, handed in, marked, changed."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from sqlalchemy import Connection, RowMapping, Table, select

from .damage import DamagedError, as_number, is_whole
from .tables import (
    counted,
    entry,
    extension,
    grade,
    mark,
    published,
    record,
    reference,
    request,
    submission,
    verdict,
)

SHORT = 8  # characters of a hash
UNKNOWN = "unknown"  # when and by whom, where the row of a change is damaged
Told = Iterator[tuple[int, str]]
"""The number of an entry, and a sentence."""


@dataclass(frozen=True)
class Event:
    """One thing that happened, when (ISO 8601, UTC), by whom and why."""

    at: str
    author: str
    what: str
    reason: str = ""


def history(connection: Connection, student: str, sheet: str) -> list[Event]:
    """All that happened to a student's sheet, the oldest first."""
    told: list[tuple[int, str]] = []
    for tell in TELLERS:
        told += tell(connection, student, sheet)
    told.sort(key=_number)

    numbers = {*map(_number, told)}
    rows = connection.execute(select(entry).where(entry.c.id.in_(numbers))).mappings()
    entries = {row["id"]: row for row in rows}
    events: list[Event] = []
    for entry_number, what in told:
        row = entries.get(entry_number)
        if row is None or not is_whole(row, entry):
            events.append(Event(UNKNOWN, UNKNOWN, what))
        else:
            events.append(Event(row["at"], row["author"], what, row["reason"]))
    return events


def _number(one: tuple[int, str]) -> int:
    """In which order it is told; what is damaged comes first."""
    number: Any = one[0]
    return number if isinstance(number, int) else 0


def _rows(connection: Connection, table: Table, student: str, sheet: str) -> Iterator[RowMapping]:
    query = select(table).where(table.c.student == student, table.c.sheet == sheet)
    yield from connection.execute(query.order_by(table.c.entry)).mappings()


def _drawn(connection: Connection, student: str, sheet: str) -> Told:
    for row in _rows(connection, record, student, sheet):
        yield row["entry"], f"{row['exercise']} drawn, attempt {row['attempt']}"


def _accepted(connection: Connection, student: str, sheet: str) -> Told:
    seen: set[str] = set()
    for row in _rows(connection, reference, student, sheet):
        exercise = row["exercise"]
        if exercise in seen:  # the first came with the draw
            yield row["entry"], f"other reference answers of {exercise} accepted"
        seen.add(exercise)


def _handed_in(connection: Connection, student: str, sheet: str) -> Told:
    for row in _rows(connection, submission, student, sheet):
        yield row["entry"], f"submission {row['hash'][:SHORT]} seen first"


def _graded(connection: Connection, student: str, sheet: str) -> Told:
    for row in _rows(connection, grade, student, sheet):
        points = _points(connection, row["entry"])
        yield row["entry"], f"submission {row['submission'][:SHORT]} marked: {points}"


def _points(connection: Connection, grade_number: int) -> str:
    """Points of a grade, and of how many, as far as its parts have any."""
    query = select(verdict.c.points, verdict.c.out_of).where(verdict.c.grade == grade_number)
    got = most = 0.0
    waiting = 0
    for points, out_of in connection.execute(query):
        try:
            most += as_number(out_of) or 0
            got += as_number(points) or 0
        except DamagedError:
            return "damaged"
        waiting += points is None
    text = f"{got:g} of {most:g}"
    if waiting:
        text += f", not graded: {waiting}"
    return text


def _counted(connection: Connection, student: str, sheet: str) -> Told:
    for row in _rows(connection, counted, student, sheet):
        if row["grade"] == row["entry"]:  # a new grade counts, as its own line says
            continue
        query = select(grade.c.submission).where(grade.c.entry == row["grade"])
        hash_ = str(connection.scalar(query))[:SHORT]
        points = _points(connection, row["grade"])
        yield row["entry"], f"the earlier marks of submission {hash_} count again: {points}"


def _marked(connection: Connection, student: str, sheet: str) -> Told:
    for row in _rows(connection, mark, student, sheet):
        what = f"{row['part']} marked by hand: {row['points']} points"
        if row["points"] is None:
            what = f"{row['part']} commented on"
        if row["comment"]:
            what += f", {row['comment']!r}"
        yield row["entry"], what


def _extended(connection: Connection, student: str, sheet: str) -> Told:
    for row in _rows(connection, extension, student, sheet):
        if row["excused"]:
            yield row["entry"], "excused"
        elif row["until"]:
            yield row["entry"], f"deadline extended until {row['until']}"
        else:
            yield row["entry"], "the deadline of all holds"


def _asked(connection: Connection, student: str, sheet: str) -> Told:
    for row in _rows(connection, request, student, sheet):
        yield row["entry"], f"asked about {row['part']}: {row['text']!r}"


def _published(connection: Connection, student: str, sheet: str) -> Told:
    for row in _rows(connection, published, student, sheet):
        yield row["entry"], "marks published"


TELLERS: tuple[Callable[[Connection, str, str], Told], ...] = (
    _drawn, _accepted, _handed_in, _graded, _counted, _marked, _extended, _asked, _published,
)  # fmt: skip
"""In the order in which things of one entry happen."""
