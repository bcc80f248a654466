"""The tables of a gradebook. Rows are only ever added; where several speak, the newest counts."""

from typing import Any

from sqlalchemy import (
    Boolean,
    Column,
    Float,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    String,
    Table,
    Text,
)

LEDGER = MetaData()
VERSION = "3"  # of the newest file in migrations/versions; the first format had no migrations


class Flag(Boolean):
    """A truth value; what else SQLite holds in its place stays as it is, so that it is seen."""

    def result_processor(self, dialect: Any, coltype: object) -> Any:  # noqa: ARG002 - SQLAlchemy's
        """Reads 0 and 1."""
        return _truth


def _truth(cell: Any) -> Any:
    return bool(cell) if cell in (0, 1) else cell


version = Table(
    "alembic_version",  # the table and the column in which Alembic looks
    LEDGER,
    Column("version_num", String(32), primary_key=True),
)
entry = Table(
    "entry",
    LEDGER,
    Column("id", Integer, primary_key=True, autoincrement=False),  # in the order of the changes
    Column("at", String, nullable=False),  # ISO 8601, UTC
    Column("author", String, nullable=False),
    Column("reason", Text, nullable=False),
)
"""A change: when, by whom and why. All other rows belong to one."""


def _change(*, primary_key: bool = False) -> "Column[int]":
    return Column("entry", Integer, ForeignKey(entry.c.id), nullable=False, primary_key=primary_key)


record = Table(
    "record",
    LEDGER,
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("exercise", String, primary_key=True),
    Column("attempt", Integer, nullable=False),
    Column("numbers", Text, nullable=False),  # JSON
    Column("digest", String, nullable=False),  # of the numbers, which nobody else may get
    _change(),
    Index("record_digest", "sheet", "exercise", "digest"),
)
reference = Table(
    "reference",
    LEDGER,
    _change(primary_key=True),
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("exercise", String, primary_key=True),
    Column("answers", Text, nullable=False),  # JSON
    Index("reference_sheet", "sheet", "student"),
)
"""What the answers of a record came to: first at the hand-out, then whenever it was accepted."""

submission = Table(
    "submission",
    LEDGER,
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("hash", String, primary_key=True),  # of the bytes handed in
    _change(),
)
"""When a submission was seen first."""

grade = Table(
    "grade",
    LEDGER,
    _change(primary_key=True),
    Column("student", String, nullable=False),
    Column("sheet", String, nullable=False),
    Column("submission", String, nullable=False),
    Column("rules", String, nullable=False),  # a hash of what it was marked by
    Index("grade_key", "student", "sheet", "submission", "rules"),
)
verdict = Table(
    "verdict",
    LEDGER,
    Column("grade", Integer, ForeignKey(grade.c.entry), primary_key=True),
    Column("place", Integer, primary_key=True, autoincrement=False),  # in the order of the sheet
    Column("part", String, nullable=False),
    Column("status", String, nullable=False),
    Column("points", Float),
    Column("out_of", Float, nullable=False),
    Column("reading", Text, nullable=False),
    Column("mask", Text, nullable=False),  # JSON: which entries are right
    Column("answer", Text, nullable=False),  # JSON
)
finding = Table(
    "finding",
    LEDGER,
    Column("grade", Integer, ForeignKey(grade.c.entry), primary_key=True),
    Column("place", Integer, primary_key=True, autoincrement=False),  # of the verdict
    Column("number", Integer, primary_key=True, autoincrement=False),
    Column("text", Text, nullable=False),
    Column("private", Flag, nullable=False),
)
counted = Table(
    "counted",
    LEDGER,
    _change(primary_key=True),
    Column("student", String, nullable=False),
    Column("sheet", String, nullable=False),
    Column("grade", Integer, ForeignKey(grade.c.entry), nullable=False),
    Index("counted_sheet", "sheet", "student"),
)
"""Which grade counts from then on."""

level = Table(
    "level",
    LEDGER,
    _change(primary_key=True),
    Column("level", String, nullable=False),
)
"""Behind which walls notebooks are run from then on."""

mark = Table(
    "mark",
    LEDGER,
    _change(primary_key=True),
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("part", String, primary_key=True),
    Column("points", Float),  # none: a comment alone
    Column("comment", Text, nullable=False),
    Column("answer", String, nullable=False),  # a short name of the answer that was read
    Column("ticks", String, nullable=False, server_default=""),  # lines of the rubric: "1,3"
    Index("mark_sheet", "sheet", "student"),
)
"""What was given by hand."""

arrival = Table(
    "arrival",
    LEDGER,
    _change(primary_key=True),
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("hash", String, primary_key=True),  # of the bytes handed in
    Column("at", String, nullable=False),  # ISO 8601
    Index("arrival_sheet", "sheet", "student"),
)
"""When a submission was handed in, as far as is known."""

extension = Table(
    "extension",
    LEDGER,
    _change(primary_key=True),
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("until", String),  # ISO 8601; none: the deadline of all
    Column("excused", Flag, nullable=False),
    Index("extension_sheet", "sheet", "student"),
)
"""Another deadline for one student, or a sheet that does not count for one."""

acceptance = Table(
    "acceptance",
    LEDGER,
    _change(primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("part", String, primary_key=True),
    Column("kind", String, nullable=False),  # what is accepted: a finding, or an answer
    Column("text", Text, nullable=False),  # the finding's sentence, or the answer's JSON
    Column("share", Float),  # of the points; none: accepted no longer
    Index("acceptance_sheet", "sheet"),
)
"""What counts for everybody from then on."""

request = Table(
    "request",
    LEDGER,
    _change(primary_key=True),
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("part", String, primary_key=True),
    Column("text", Text, nullable=False),
    Index("request_sheet", "sheet", "student"),
)
"""What a student asks to have looked at again."""

published = Table(
    "published",
    LEDGER,
    _change(primary_key=True),
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("result", Text, nullable=False),  # JSON
    Index("published_sheet", "sheet", "student"),
)
"""Marks as students were told them, which stay until they are published again."""
