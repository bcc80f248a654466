"""From the first format, whose rows were replaced, to rows that are only added.

That format kept neither times nor people, so all that it held is entered with the time of the
migration. The tables are written out: those of the package go on changing.
"""

import hashlib
import json
from contextlib import suppress
from datetime import UTC, datetime
from itertools import count
from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "2"
down_revision = None  # the first format had no Alembic
branch_labels = None
depends_on = None

AUTHOR = "kinegrade"
REASON = "taken over from a gradebook that kept no times"
OLD = ("record", "grade", "current", "mark", "meta")
Rows = list[dict[str, Any]]


def upgrade() -> None:
    """Takes every row over; those that are damaged stay so, for their student alone."""
    connection = op.get_bind()
    old: dict[str, Rows] = {}
    for name in OLD:
        rows = connection.execute(sa.text(f"SELECT * FROM {name}"))  # noqa: S608 - our own names
        old[name] = [dict(row) for row in rows.mappings()]
        op.drop_table(name)
    _create_tables()
    for name, rows in _new_rows(old).items():
        if rows:
            columns: list[sa.ColumnClause[Any]] = [sa.column(column) for column in rows[0]]
            op.bulk_insert(sa.table(name, *columns), rows)


def _new_rows(old: dict[str, Rows]) -> dict[str, Rows]:
    """The rows of the new tables, in an order in which they can be inserted."""
    new: dict[str, Rows] = {}
    for name in ("entry", "record", "reference", "submission", "grade", "verdict", "finding"):
        new[name] = []
    new["counted"] = []
    new["mark"] = []
    ids = count(1)
    at = datetime.now(UTC).isoformat(timespec="milliseconds")

    def entry() -> int:
        number = next(ids)
        new["entry"].append({"id": number, "at": at, "author": AUTHOR, "reason": REASON})
        return number

    for row in old["record"]:
        _take_record(row, entry(), new)
    grades: dict[tuple[str, ...], int] = {}
    for row in old["grade"]:
        number = entry()
        grades[_key(row)] = number
        _take_grade(row, number, new)
    for row in old["current"]:
        if _key(row) in grades:
            place = {"student": row["student"], "sheet": row["sheet"]}
            new["counted"].append({"entry": entry(), **place, "grade": grades[_key(row)]})
    for row in old["mark"]:
        new["mark"].append({"entry": entry(), **row})
    new["submission"] = _first(new["submission"])
    return new


def _first(submissions: Rows) -> Rows:
    """One row for each file, though it may have been marked by several rules."""
    found: dict[tuple[str, ...], dict[str, Any]] = {}
    for row in submissions:
        found.setdefault((row["student"], row["sheet"], row["hash"]), row)
    return [*found.values()]


def _key(row: dict[str, Any]) -> tuple[str, ...]:
    return (row["student"], row["sheet"], row["submission"], row["rules"])


def _take_record(row: dict[str, Any], entry: int, new: dict[str, Rows]) -> None:
    row = dict(row)
    answers = row.pop("answers")
    name = {key: row[key] for key in ("student", "sheet", "exercise")}
    new["record"].append({**row, "digest": _digest(str(row["numbers"])), "entry": entry})
    new["reference"].append({"entry": entry, **name, "answers": answers})


def _digest(numbers: str) -> str:
    """The name of drawn numbers, as `variant.digest` makes it of their canonical text."""
    with suppress(ValueError):  # damaged; nobody draws the same
        numbers = json.dumps(json.loads(numbers), sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(numbers.encode(errors="replace")).hexdigest()[:32]


def _take_grade(row: dict[str, Any], entry: int, new: dict[str, Rows]) -> None:
    name = {"student": row["student"], "sheet": row["sheet"]}
    new["submission"].append({**name, "hash": row["submission"], "entry": entry})
    key = {"submission": row["submission"], "rules": row["rules"]}
    new["grade"].append({"entry": entry, **name, **key})
    try:
        verdicts, findings = _judged(json.loads(row["verdicts"]), entry)
    except (ValueError, TypeError, KeyError, AttributeError):
        verdicts, findings = [_damaged(row["verdicts"], entry)], []
    new["verdict"] += verdicts
    new["finding"] += findings


def _judged(data: Any, grade: int) -> tuple[Rows, Rows]:
    verdicts: Rows = []
    findings: Rows = []
    for place, verdict in enumerate(data):
        verdicts.append(
            {
                "grade": grade,
                "place": place,
                "part": verdict["part"],
                "status": str(verdict["status"]),
                "points": _number(verdict["points"]),
                "out_of": float(verdict["out_of"]),
                "reading": _plain(verdict["reading"]),
                "mask": json.dumps(verdict["right"]),
                "answer": json.dumps(verdict["answer"]),
            }
        )
        for number, finding in enumerate(verdict["findings"]):
            text = {"text": _plain(finding["text"]), "private": bool(finding["private"])}
            findings.append({"grade": grade, "place": place, "number": number, **text})
    return verdicts, findings


def _number(value: Any) -> float | None:
    if value is None:
        return None
    return float(value)


def _plain(text: str) -> str:
    """Text that both databases take."""
    return text.encode(errors="replace").decode().replace("\0", "\N{REPLACEMENT CHARACTER}")


def _damaged(text: str, grade: int) -> dict[str, Any]:
    """One verdict that cannot be read, either, and holds what was there."""
    return {
        "grade": grade,
        "place": 0,
        "part": "",
        "status": "damaged",
        "points": None,
        "out_of": 0,
        "reading": _plain(str(text)),
        "mask": "null",
        "answer": "null",
    }


def _create_tables() -> None:
    _create_records()
    _create_grades()
    op.create_table(
        "level",
        _entry(primary_key=True),
        sa.Column("level", sa.String, nullable=False),
    )
    op.create_table(
        "mark",
        _entry(primary_key=True),
        sa.Column("student", sa.String, primary_key=True),
        sa.Column("sheet", sa.String, primary_key=True),
        sa.Column("part", sa.String, primary_key=True),
        sa.Column("points", sa.Float),
        sa.Column("comment", sa.Text, nullable=False),
        sa.Column("answer", sa.String, nullable=False),
    )
    op.create_index("mark_sheet", "mark", ["sheet", "student"])


def _entry(*, primary_key: bool = False) -> "sa.Column[int]":
    return sa.Column(
        "entry", sa.Integer, sa.ForeignKey("entry.id"), nullable=False, primary_key=primary_key
    )


def _create_records() -> None:
    op.create_table(
        "entry",
        sa.Column("id", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("at", sa.String, nullable=False),
        sa.Column("author", sa.String, nullable=False),
        sa.Column("reason", sa.Text, nullable=False),
    )
    op.create_table(
        "record",
        sa.Column("student", sa.String, primary_key=True),
        sa.Column("sheet", sa.String, primary_key=True),
        sa.Column("exercise", sa.String, primary_key=True),
        sa.Column("attempt", sa.Integer, nullable=False),
        sa.Column("numbers", sa.Text, nullable=False),
        sa.Column("digest", sa.String, nullable=False),
        _entry(),
    )
    op.create_index("record_digest", "record", ["sheet", "exercise", "digest"])
    op.create_table(
        "reference",
        _entry(primary_key=True),
        sa.Column("student", sa.String, primary_key=True),
        sa.Column("sheet", sa.String, primary_key=True),
        sa.Column("exercise", sa.String, primary_key=True),
        sa.Column("answers", sa.Text, nullable=False),
    )
    op.create_index("reference_sheet", "reference", ["sheet", "student"])


def _create_grades() -> None:
    op.create_table(
        "submission",
        sa.Column("student", sa.String, primary_key=True),
        sa.Column("sheet", sa.String, primary_key=True),
        sa.Column("hash", sa.String, primary_key=True),
        _entry(),
    )
    op.create_table(
        "grade",
        _entry(primary_key=True),
        sa.Column("student", sa.String, nullable=False),
        sa.Column("sheet", sa.String, nullable=False),
        sa.Column("submission", sa.String, nullable=False),
        sa.Column("rules", sa.String, nullable=False),
    )
    op.create_index("grade_key", "grade", ["student", "sheet", "submission", "rules"])
    op.create_table(
        "verdict",
        sa.Column("grade", sa.Integer, sa.ForeignKey("grade.entry"), primary_key=True),
        sa.Column("place", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("part", sa.String, nullable=False),
        sa.Column("status", sa.String, nullable=False),
        sa.Column("points", sa.Float),
        sa.Column("out_of", sa.Float, nullable=False),
        sa.Column("reading", sa.Text, nullable=False),
        sa.Column("mask", sa.Text, nullable=False),
        sa.Column("answer", sa.Text, nullable=False),
    )
    op.create_table(
        "finding",
        sa.Column("grade", sa.Integer, sa.ForeignKey("grade.entry"), primary_key=True),
        sa.Column("place", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("number", sa.Integer, primary_key=True, autoincrement=False),
        sa.Column("text", sa.Text, nullable=False),
        sa.Column("private", sa.Boolean, nullable=False),
    )
    op.create_table(
        "counted",
        _entry(primary_key=True),
        sa.Column("student", sa.String, nullable=False),
        sa.Column("sheet", sa.String, nullable=False),
        sa.Column("grade", sa.Integer, sa.ForeignKey("grade.entry"), nullable=False),
    )
    op.create_index("counted_sheet", "counted", ["sheet", "student"])
