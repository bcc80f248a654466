"""Grades: what a submission got by some rules, and which grade counts."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from sqlalchemy import (
    Connection,
    RowMapping,
    Select,
    Table,
    func,
    select,
    tuple_,
)

from ...grader.marking.verdict import STATUS_WORDS, Finding, Verdict
from .damage import DamagedError, Damages, check_row, is_whole, loaded, plain
from .entries import Change, enter_all
from .tables import counted, finding, grade, submission, verdict

T = TypeVar("T")
Rows = list[dict[str, Any]]
AT_ONCE = 200  # keys or grades that are asked for in one statement
ROUNDED = 0.005  # points have two decimals, which may be more than a part has
ORDER = {verdict: ["grade", "place"], finding: ["grade", "place", "number"]}


@dataclass(frozen=True)
class GradeKey:
    """What a grade belongs to; the attempts drawn are part of `rules`."""

    student: str
    sheet: str
    submission: str
    rules: str


@dataclass(frozen=True)
class Attempt:
    """One submission of a student, with what it got last, and whether it is the one that counts."""

    submission: str
    verdicts: list[Verdict]
    counts: bool


def see(connection: Connection, keys: Iterable[GradeKey], change: Change) -> None:
    """Notes the submissions that were never seen before."""
    columns = (submission.c.student, submission.c.sheet, submission.c.hash)
    names = {(key.student, key.sheet, key.submission): None for key in keys}
    for some in _batches([*names]):
        there = select(*columns).where(tuple_(*columns).in_(some))
        seen = {tuple(row) for row in connection.execute(there)}
        new = [name for name in some if name not in seen]
        rows: Rows = []
        entries = enter_all(connection, change, len(new))
        for (student, sheet, found), number in zip(new, entries, strict=True):
            rows.append({"student": student, "sheet": sheet, "hash": found, "entry": number})
        _add(connection, submission, rows)


def all_newest(connection: Connection, keys: Sequence[GradeKey]) -> dict[GradeKey, int]:
    """The numbers of the last grades of those keys that have one."""
    columns = (grade.c.student, grade.c.sheet, grade.c.submission, grade.c.rules)
    found: dict[GradeKey, int] = {}
    for some in _batches(keys):
        named = [tuple(vars(key).values()) for key in some]
        query = select(*columns, func.max(grade.c.entry)).where(tuple_(*columns).in_(named))
        for *name, number in connection.execute(query.group_by(*columns)):
            found[GradeKey(*name)] = number
    return found


def verdicts_of_all(
    connection: Connection, numbers: Sequence[int]
) -> dict[int, list[Verdict] | None]:
    """The verdicts of grades, by number; None where they are damaged."""
    found: dict[int, list[Verdict] | None] = {}
    for some in _batches(numbers):
        found |= dict.fromkeys(some)
        found |= _read(connection, [*some])
    return found


def _batches(items: Sequence[T]) -> Iterator[Sequence[T]]:
    for start in range(0, len(items), AT_ONCE):
        yield items[start : start + AT_ONCE]


def save(
    connection: Connection, graded: Mapping[GradeKey, Sequence[Verdict]], change: Change
) -> None:
    """Adds grades, but for those whose last one says the same, and lets them count."""
    see(connection, graded, change)
    last = all_newest(connection, [*graded])
    same: dict[GradeKey, int] = {}
    new: list[tuple[GradeKey, Rows, Rows]] = []
    for key, verdicts in graded.items():
        judged, found = _to_rows(verdicts)
        if key in last and _says(connection, last[key], judged, found):
            same[key] = last[key]
        else:
            new.append((key, judged, found))
    let_count(connection, same, change)

    rows: dict[Table, Rows] = {grade: [], verdict: [], finding: [], counted: []}
    entries = enter_all(connection, change, len(new))
    for (key, judged, found), entry in zip(new, entries, strict=True):
        rows[grade].append({"entry": entry, **vars(key)})
        rows[verdict] += [{"grade": entry, **row} for row in judged]
        rows[finding] += [{"grade": entry, **row} for row in found]
        rows[counted].append(_counting(key, entry, entry))
    for table, added in rows.items():
        _add(connection, table, added)


def let_count(connection: Connection, numbers: Mapping[GradeKey, int], change: Change) -> None:
    """Grades that are there count from now on; of those that already do, nothing is written."""
    others = {
        key: number for key, number in numbers.items() if not _counts(connection, key, number)
    }
    entries = enter_all(connection, change, len(others))
    rows: Rows = []
    for (key, number), entry in zip(others.items(), entries, strict=True):
        rows.append(_counting(key, number, entry))
    _add(connection, counted, rows)


def _counts(connection: Connection, key: GradeKey, number: int) -> bool:
    """Whether a grade is the one that counts for the student's sheet."""
    same = (counted.c.student == key.student, counted.c.sheet == key.sheet)
    query = select(counted.c.grade).where(*same).order_by(counted.c.entry.desc()).limit(1)
    return connection.scalar(query) == number


def _add(connection: Connection, table: Table, rows: Rows) -> None:
    if rows:  # without any, a row of defaults would be added
        connection.execute(table.insert(), rows)


def _counting(key: GradeKey, number: int, entry: int) -> dict[str, Any]:
    return {"entry": entry, "student": key.student, "sheet": key.sheet, "grade": number}


def counting(connection: Connection, sheet: str) -> dict[str, int]:
    """Student to the number of the grade that counts."""
    query = select(counted.c.student, counted.c.grade)
    found: dict[str, int] = {}
    for row in connection.execute(query.where(counted.c.entry.in_(_last(sheet)))).mappings():
        found[row["student"]] = row["grade"]
    return found


def verdicts_that_count(connection: Connection, sheet: str) -> dict[int, list[Verdict] | None]:
    """The verdicts of the grades that count, by number; None where they are damaged."""
    numbers = select(counted.c.grade).where(counted.c.entry.in_(_last(sheet)))
    return _read(connection, numbers)


def attempts(connection: Connection, sheet: str, damages: Damages) -> dict[str, list[Attempt]]:
    """All marked submissions by student, the first seen first; none that is damaged."""
    newest_grades = select(func.max(grade.c.entry)).where(grade.c.sheet == sheet)
    newest_grades = newest_grades.group_by(grade.c.student, grade.c.submission)
    verdicts = _read(connection, newest_grades)
    counted_now = counting(connection, sheet)
    names = select(grade.c.entry, grade.c.student, grade.c.submission)
    submissions: dict[int, tuple[str, str]] = {}
    for number, student, hash_ in connection.execute(names.where(grade.c.sheet == sheet)):
        submissions[number] = (student, hash_)

    order = select(submission.c.student, submission.c.hash).where(submission.c.sheet == sheet)
    seen = [tuple(row) for row in connection.execute(order.order_by(submission.c.entry))]
    order_seen = dict.fromkeys([*seen, *submissions.values()])  # also those whose row is damaged
    found: dict[tuple[str, str], Attempt] = {}
    for number, these in verdicts.items():
        student, hash_ = submissions[number]
        if these is None:
            damages.add("attempt", sheet, student, "an attempt", "put a backup back")
        else:
            last = submissions.get(counted_now.get(student, 0))
            found[student, hash_] = Attempt(hash_, these, counts=last == (student, hash_))
    ordered: dict[str, list[Attempt]] = {}
    for student, hash_ in order_seen:
        if (student, hash_) in found:
            ordered.setdefault(student, []).append(found[student, hash_])
    return ordered


def _last(sheet: str) -> "Select[Any]":
    last = select(func.max(counted.c.entry)).where(counted.c.sheet == sheet)
    return last.group_by(counted.c.student)


def _read(
    connection: Connection, numbers: "Select[Any] | list[int]"
) -> dict[int, list[Verdict] | None]:
    found: dict[tuple[int, int], list[Finding]] = {}
    damaged: set[int] = set()
    for row in _rows(connection, finding, numbers):
        place = (row["grade"], row["place"])
        found.setdefault(place, []).append(Finding(row["text"], private=row["private"]))
        if not is_whole(row, finding):
            damaged.add(row["grade"])

    read: dict[int, list[Verdict] | None] = {}
    for row in _rows(connection, verdict, numbers):
        verdicts = read.setdefault(row["grade"], [])
        if verdicts is None:
            continue
        if row["grade"] in damaged or row["place"] != len(verdicts):  # one before it is lost
            read[row["grade"]] = None
            continue
        try:
            verdicts.append(_verdict(row, found.get((row["grade"], row["place"]), [])))
        except DamagedError:
            read[row["grade"]] = None
    return read


def _rows(
    connection: Connection, table: Table, numbers: "Select[Any] | list[int]"
) -> Sequence[RowMapping]:
    order = [table.c[name] for name in ORDER[table]]
    query = select(table).where(table.c.grade.in_(numbers)).order_by(*order)
    return connection.execute(query).mappings().all()


def _verdict(row: RowMapping, findings: Iterable[Finding]) -> Verdict:
    check_row(row, verdict)
    points, out_of = row["points"], row["out_of"]
    if row["status"] not in STATUS_WORDS or out_of < 0:
        raise DamagedError
    if points is not None and not 0 <= points <= out_of + ROUNDED:
        raise DamagedError
    return Verdict(
        part=row["part"],
        status=row["status"],
        points=points,
        out_of=out_of,
        findings=tuple(findings),
        reading=row["reading"],
        right=loaded(row["mask"]),
        answer=loaded(row["answer"]),
    )


def _to_rows(verdicts: Iterable[Verdict]) -> tuple[Rows, Rows]:
    """The rows of verdicts and of their findings, without the number of the grade."""
    judged: Rows = []
    found: Rows = []
    for place, one in enumerate(verdicts):
        judged.append(
            {
                "place": place,
                "part": one.part,
                "status": one.status,
                "points": one.points,
                "out_of": one.out_of,
                "reading": plain(one.reading),
                "mask": json.dumps(one.right),
                "answer": json.dumps(one.answer),
            }
        )
        for number, sentence in enumerate(one.findings):
            row = {"place": place, "number": number}
            text = {"text": plain(sentence.text), "private": sentence.private}
            found.append({**row, **text})
    return judged, found


def _says(connection: Connection, number: int, judged: Rows, found: Rows) -> bool:
    """Whether a grade that is there has these rows and no others."""
    for table, rows in ((verdict, judged), (finding, found)):
        there = [dict(row) for row in _rows(connection, table, [number])]
        if there != [{"grade": number, **row} for row in rows]:
            return False
    return True
