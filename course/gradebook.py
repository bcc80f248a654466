"""The gradebook: records and marks in one SQLite file, every change one transaction."""

import json
from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from sqlalchemy import (
    URL,
    Column,
    ColumnElement,
    Connection,
    Float,
    Integer,
    MetaData,
    RowMapping,
    String,
    Table,
    Text,
    create_engine,
    select,
)
from sqlalchemy.exc import DatabaseError

from ..grader.marking.verdict import Verdict
from .config import CourseError
from .variant import Record

FORMAT = "1"
_metadata = MetaData()
_meta = Table(
    "meta",
    _metadata,
    Column("key", String, primary_key=True),
    Column("value", String, nullable=False),
)
_records = Table(
    "record",
    _metadata,
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("exercise", String, primary_key=True),
    Column("attempt", Integer, nullable=False),
    Column("numbers", Text, nullable=False),
    Column("answers", Text, nullable=False),
)
_grades = Table(
    "grade",
    _metadata,
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("submission", String, primary_key=True),  # hash of the bytes handed in
    Column("rules", String, primary_key=True),  # hash of what they were marked by
    Column("verdicts", Text, nullable=False),
)
_current = Table(
    "current",
    _metadata,
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("submission", String, nullable=False),
    Column("rules", String, nullable=False),
)
_marks = Table(
    "mark",
    _metadata,
    Column("student", String, primary_key=True),
    Column("sheet", String, primary_key=True),
    Column("part", String, primary_key=True),
    Column("points", Float, nullable=False),
    Column("comment", Text, nullable=False),
    Column("answer", String, nullable=False),  # a short name of the answer that was read
)


@dataclass(frozen=True)
class Mark:
    """What a marker gave by hand for one answer.

    `answer` names the one that was read, so that another answer needs another mark.
    """

    student: str
    sheet: str
    part: str
    points: float
    comment: str
    answer: str


@dataclass(frozen=True)
class GradeKey:
    """What a grade belongs to; the attempts drawn are part of `rules`."""

    student: str
    sheet: str
    submission: str
    rules: str


class Gradebook:
    """Records and marks of one course."""

    def __init__(self, path: Path) -> None:
        """Opens the file, or makes it.

        Raises:
            CourseError: the file is not a gradebook, or one of a later version.
        """
        self._path = path
        self._engine = create_engine(URL.create("sqlite", database=str(path)))
        try:
            self._prepare()
        except CourseError:
            self.close()
            raise

    def _prepare(self) -> None:
        with self.transaction() as connection:
            _metadata.create_all(connection)
            found = connection.scalar(select(_meta.c.value).where(_meta.c.key == "format"))
            if found is None:
                connection.execute(_meta.insert().values(key="format", value=FORMAT))
            elif found != FORMAT:
                raise CourseError(
                    f"{self._path}: the gradebook has format {found}; this version reads {FORMAT}"
                )

    def close(self) -> None:
        """Lets go of the file."""
        self._engine.dispose()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @contextmanager
    def transaction(self) -> Generator[Connection]:
        """All of what is done inside, or nothing.

        Raises:
            CourseError: the file cannot be read or written.
        """
        try:
            with self._engine.begin() as connection:
                yield connection
        except DatabaseError as error:
            raise CourseError(
                f"{self._path}: not a gradebook that can be used: {error.orig}"
            ) from error

    def note_level(self, level: str) -> None:
        """Keeps at which level notebooks were run last."""
        with self.transaction() as connection:
            connection.execute(_meta.delete().where(_meta.c.key == "level"))
            connection.execute(_meta.insert().values(key="level", value=level))

    def noted_level(self) -> str:
        """At which level notebooks were run last; empty where none was."""
        with self.transaction() as connection:
            query = select(_meta.c.value).where(_meta.c.key == "level")
            return connection.scalar(query) or ""

    def records(self, sheet: str) -> list[Record]:
        """Everything drawn for a sheet."""
        return [_record(row) for row in self._rows_of(_records, sheet)]

    def _rows_of(self, table: Table, sheet: str) -> Sequence[RowMapping]:
        with self.transaction() as connection:
            found = connection.execute(select(table).where(table.c.sheet == sheet))
            return found.mappings().all()

    def save_records(self, records: Sequence[Record]) -> None:
        """Adds the records of one student's sheet, together or not at all."""
        with self.transaction() as connection:
            for record in records:
                connection.execute(_records.insert().values(**_row(record)))

    def accept_answers(self, record: Record, answers: dict[str, Any]) -> None:
        """Replaces a record's answers after the instructor accepted that the reference changed."""
        key = {"student": record.student, "sheet": record.sheet, "exercise": record.exercise}
        update = _records.update().where(*_same(_records, key))
        with self.transaction() as connection:
            connection.execute(update.values(answers=json.dumps(answers)))

    def verdicts(self, key: GradeKey) -> list[Verdict] | None:
        """What this submission got by these rules, or None when it was never marked by them."""
        with self.transaction() as connection:
            text = connection.scalar(select(_grades.c.verdicts).where(*_same(_grades, vars(key))))
        if text is None:
            return None
        return _verdicts(text)

    def save_grade(self, key: GradeKey, verdicts: Sequence[Verdict]) -> None:
        """The grade and that it is the current one, in one transaction."""
        text = json.dumps([verdict.to_json() for verdict in verdicts])
        with self.transaction() as connection:
            connection.execute(_grades.delete().where(*_same(_grades, vars(key))))
            connection.execute(_grades.insert().values(**vars(key), verdicts=text))
            _point_to(connection, key)

    def make_current(self, key: GradeKey) -> None:
        """An earlier grade counts again; where it already does, nothing is written."""
        with self.transaction() as connection:
            _point_to(connection, key)

    def marks(self, sheet: str) -> dict[tuple[str, str], Mark]:
        """Marks entered by hand, by student and part."""
        marks = [Mark(**row) for row in self._rows_of(_marks, sheet)]
        return {(mark.student, mark.part): mark for mark in marks}

    def save_marks(self, marks: Sequence[Mark]) -> None:
        """Enters marks, all or none; an earlier mark of the same part is replaced."""
        with self.transaction() as connection:
            for mark in marks:
                key = {"student": mark.student, "sheet": mark.sheet, "part": mark.part}
                connection.execute(_marks.delete().where(*_same(_marks, key)))
                connection.execute(_marks.insert().values(**vars(mark)))

    def current(self, sheet: str) -> dict[str, list[Verdict]]:
        """Student to verdicts: what counts now."""
        same = [_current.c[column.name] == column for column in _grades.primary_key]
        query = select(_grades.c.student, _grades.c.verdicts)
        query = query.where(*same, _current.c.sheet == sheet)
        with self.transaction() as connection:
            return {student: _verdicts(text) for student, text in connection.execute(query)}


def _point_to(connection: Connection, key: GradeKey) -> None:
    there = connection.scalar(select(_current.c.student).where(*_same(_current, vars(key))))
    if there is not None:
        return
    other = _same(_current, {"student": key.student, "sheet": key.sheet})
    connection.execute(_current.delete().where(*other))
    connection.execute(_current.insert().values(**vars(key)))


def _same(table: Table, key: Mapping[str, str]) -> list[ColumnElement[bool]]:
    return [table.c[name] == value for name, value in key.items()]


def _row(record: Record) -> dict[str, Any]:
    return {
        **vars(record),
        "numbers": json.dumps(record.numbers),
        "answers": json.dumps(record.answers),
    }


def _record(row: RowMapping) -> Record:
    numbers = json.loads(row["numbers"])
    answers = json.loads(row["answers"])
    return Record(**{**row, "numbers": numbers, "answers": answers})


def _verdicts(text: str) -> list[Verdict]:
    return [Verdict.from_json(data) for data in json.loads(text)]
