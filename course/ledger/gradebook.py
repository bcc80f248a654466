"""The gradebook: all that was drawn, handed in and marked; a change adds rows and replaces none."""

import json
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Self

from sqlalchemy import ColumnElement, Connection, RowMapping, and_, select

from ...grader.marking.verdict import Verdict
from ..settings.config import Course, CourseError
from ..variants.record import Record, canonical, digest
from . import grades, marks
from .address import address, without_password
from .damage import DamagedError, Damages, check_row, loaded, text_of
from .database import Database
from .entries import Change, enter
from .grades import Attempt, GradeKey
from .history import Event, history
from .marks import Differing, Mark
from .opening import open_ledger
from .tables import level as levels
from .tables import record, reference
from .term import TermLedger

__all__ = ["Event", "GradeKey", "Gradebook", "Mark", "OvertakenError", "gradebook_of"]
FILE = "gradebook.sqlite"
UNREADABLE = "unreadable"
DAMAGED_GRADE = ("the grade", "`kinegrade grade` marks anew")
MARKED_ANEW = "marked anew"
"""Damaged grades that somebody asked for in order to mark what has none."""


class OvertakenError(CourseError):
    """Another kinegrade drew for this student, or drew these numbers, in the meantime."""


def gradebook_of(course: Course, place: str = "") -> "Gradebook":
    """The gradebook of a course: at `place`, where course.toml says, or in the course folder.

    Raises:
        CourseError: it cannot be opened.
    """
    written = course.settings.gradebook.url
    if place:
        return Gradebook(place)
    if written:
        return Gradebook(without_password(written))
    return Gradebook(course.folder / FILE)


class Gradebook:
    """What one course keeps.

    Where several rows speak about the same thing, the newest counts. A row that cannot be read
    costs its student's sheet, and no other; `damaged` names it.
    """

    def __init__(self, place: Path | str) -> None:
        """Opens a file or the database of a URL; makes the tables, or brings them up to date.

        Raises:
            CourseError: it is not a gradebook, one of a later version, or cannot be reached.
        """
        self._database = Database(address(place))
        self._damages = Damages()
        try:
            open_ledger(self._database)
        except BaseException:
            self.close()
            raise

    @property
    def place(self) -> str:
        """Where it lies, for sentences; without a password."""
        return self._database.place

    @property
    def term(self) -> TermLedger:
        """Deadlines of single students, what was accepted, requests and what was published."""
        return TermLedger(self._database, self._damages)

    @property
    def database(self) -> Database:
        """The database itself."""
        return self._database

    def close(self) -> None:
        """Lets go of the database."""
        self._database.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def damaged(self, sheet: str, *kinds: str) -> dict[str, str]:
        """Students of whom a row of this sheet was read that is damaged, and a sentence on it.

        With `kinds`, names of tables, rows of these alone.
        """
        return self._damages.of(sheet, kinds)

    def note_level(self, level: str) -> None:
        """Keeps at which level notebooks are run from now on, where it is another."""
        if level == self.noted_level():
            return
        with self._database.writing() as connection:
            number = enter(connection, Change())
            connection.execute(levels.insert().values(entry=number, level=level))

    def noted_level(self) -> str:
        """At which level notebooks were run last; empty where none was."""
        query = select(levels.c.level).order_by(levels.c.entry.desc()).limit(1)
        with self._database.reading() as connection:
            return text_of(connection.scalar(query) or "", UNREADABLE)

    def records(self, sheet: str) -> list[Record]:
        """Everything drawn for a sheet, with the answers that were accepted last."""
        with self._database.reading() as connection:
            drawn = _of_sheet(connection, sheet)
            accepted: dict[tuple[str, str], RowMapping] = {}
            query = select(reference).where(reference.c.sheet == sheet)
            for row in connection.execute(query.order_by(reference.c.entry)).mappings():
                accepted[row["student"], row["exercise"]] = row

        found: list[Record] = []
        for row in drawn:
            answers = accepted.get((row["student"], row["exercise"]))
            try:
                found.append(_record(row, answers))
            except DamagedError:
                what = text_of(row["exercise"], "an exercise")
                self._damages.add("record", sheet, row["student"], what, "put a backup back")
        return found

    def save_records(self, records: Sequence[Record], reason: str = "") -> None:
        """Adds the records of one student's sheet, together or not at all.

        Raises:
            OvertakenError: another kinegrade drew one of them, or its numbers for somebody else.
        """
        with self._database.writing() as connection:
            _refuse_the_overtaken(connection, records)
            entry = enter(connection, Change(reason=reason))
            for one in records:
                row = {**_name(one), "attempt": one.attempt, "numbers": json.dumps(one.numbers)}
                row |= {"digest": _digest(one), "entry": entry}
                connection.execute(record.insert().values(**row))
                _refer(connection, one, one.answers, entry)

    def accept_answers(self, one: Record, answers: dict[str, Any], reason: str = "") -> None:
        """From now on these are a record's answers; the instructor accepted that they changed."""
        with self._database.writing() as connection:
            _refer(connection, one, answers, enter(connection, Change(reason=reason)))

    def see(self, keys: Sequence[GradeKey]) -> None:
        """Notes the submissions that were not seen before, with the time."""
        if not keys:
            return
        with self._database.writing() as connection:
            grades.see(connection, keys, Change())

    def save_grades(self, graded: Mapping[GradeKey, Sequence[Verdict]], reason: str = "") -> None:
        """Grades, and that they are the ones that count, in one transaction."""
        if not graded:
            return
        with self._database.writing() as connection:
            grades.save(connection, graded, Change(reason=reason))

    def graded(
        self, keys: Sequence[GradeKey], worth: Mapping[str, float] | None = None
    ) -> dict[GradeKey, list[Verdict]]:
        """What those submissions got that were marked by these rules, and can be read.

        `worth` has the points of every part by these rules: a grade of others is damaged.
        """
        found: dict[GradeKey, list[Verdict]] = {}
        with self._database.reading() as connection:
            numbers = grades.all_newest(connection, keys)
            verdicts = grades.verdicts_of_all(connection, [*numbers.values()])
        for key, number in numbers.items():
            these = verdicts[number]
            if these is None or (worth is not None and _worth(these) != worth):
                self._damages.add(MARKED_ANEW, key.sheet, key.student, *DAMAGED_GRADE)
            else:
                found[key] = these
        return found

    def make_current(self, keys: Sequence[GradeKey]) -> None:
        """Earlier grades count again; where they already do, nothing is written."""
        with self._database.reading() as connection:
            numbers = grades.all_newest(connection, keys)
            counting: dict[tuple[str, str], int] = {}
            for sheet in {key.sheet for key in keys}:
                for student, number in grades.counting(connection, sheet).items():
                    counting[student, sheet] = number
        others = {
            key: number
            for key, number in numbers.items()
            if counting.get((key.student, key.sheet)) != number
        }
        if not others:
            return
        with self._database.writing() as connection:
            grades.let_count(connection, others, Change())

    def current(self, sheet: str, asked: Collection[str] = ()) -> dict[str, list[Verdict]]:
        """Student to verdicts: what counts now.

        Where a grade has one of the `asked` parts, a grade without it is damaged.
        """
        self._damages.forget("grade", sheet)  # what is damaged may be marked anew by now
        with self._database.reading() as connection:
            numbers = grades.counting(connection, sheet)
            verdicts = grades.verdicts_that_count(connection, sheet)
        parts: set[str] = set()
        for these in verdicts.values():
            parts |= {*_worth(these or ())}
        parts &= {*asked}  # before all are marked anew, those of an edited sheet differ

        found: dict[str, list[Verdict]] = {}
        for student, number in numbers.items():
            these = verdicts.get(number)
            if these is None or parts - {*_worth(these)}:
                self._damages.add("grade", sheet, student, *DAMAGED_GRADE)
            else:
                found[student] = these
        return found

    def attempts(self, sheet: str) -> dict[str, list[Attempt]]:
        """All marked submissions of a sheet by student, the first seen first."""
        with self._database.reading() as connection:
            return grades.attempts(connection, sheet, self._damages)

    def marks(self, sheet: str) -> dict[tuple[str, str], Mark]:
        """Marks and comments entered by hand, by student and part."""
        with self._database.reading() as connection:
            return marks.that_count(connection, sheet, self._damages)

    def save_marks(self, given: Sequence[Mark], *, author: str = "", reason: str = "") -> None:
        """Enters marks, all or none; of the same part, the last one counts."""
        with self._database.writing() as connection:
            marks.save(connection, given, Change(author, reason))

    def differing_marks(self, sheet: str) -> list[Differing]:
        """Answers of a sheet to which several markers gave other points."""
        with self._database.reading() as connection:
            return marks.differing(connection, sheet)

    def history(self, student: str, sheet: str) -> list[Event]:
        """All that happened to a student's sheet, the oldest first."""
        with self._database.reading() as connection:
            return history(connection, student, sheet)


def _worth(verdicts: Iterable[Verdict]) -> dict[str, float]:
    return {verdict.part: verdict.out_of for verdict in verdicts}


def _of_sheet(connection: Connection, sheet: str) -> Sequence[RowMapping]:
    query = select(record).where(record.c.sheet == sheet)
    query = query.order_by(record.c.entry, record.c.exercise)
    return connection.execute(query).mappings().all()


def _record(row: RowMapping, accepted: RowMapping | None) -> Record:
    check_row(row, record)
    if accepted is None:
        raise DamagedError
    check_row(accepted, reference)
    return Record(
        row["student"],
        row["sheet"],
        row["exercise"],
        row["attempt"],
        loaded(row["numbers"], dict),
        loaded(accepted["answers"], dict),
    )


def _refuse_the_overtaken(connection: Connection, records: Iterable[Record]) -> None:
    for one in records:
        there = select(record.c.entry).where(_is(_name(one)))
        same = {"sheet": one.sheet, "exercise": one.exercise, "digest": _digest(one)}
        for query in (there, select(record.c.entry).where(_is(same))):
            if connection.scalar(query.limit(1)) is not None:
                raise OvertakenError(
                    f"another kinegrade drew numbers of {one.exercise}, sheet {one.sheet}, while "
                    f"those of {one.student} were drawn; nothing was recorded"
                )


def _refer(connection: Connection, one: Record, answers: Mapping[str, Any], entry: int) -> None:
    row = {"entry": entry, **_name(one), "answers": json.dumps(answers)}
    connection.execute(reference.insert().values(**row))


def _is(values: Mapping[str, str]) -> ColumnElement[bool]:
    return and_(*(record.c[name] == value for name, value in values.items()))


def _name(one: Record) -> dict[str, str]:
    return {"student": one.student, "sheet": one.sheet, "exercise": one.exercise}


def _digest(one: Record) -> str:
    return digest(canonical(one.numbers).encode())
