"""Marking a class: every submission on its own, every grade one transaction, nothing marked twice."""

import logging
import os
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import closing
from dataclasses import dataclass, replace
from importlib.metadata import version
from typing import Any

from ..exercises.exercise import Exercise, Manual
from ..exercises.files.finding import exercise_files
from ..grader.collecting.ask import Ask, Limits
from ..grader.collecting.wire import Raw
from ..grader.marking.mark import mark
from ..grader.marking.verdict import Verdict, not_graded
from .config import Course, CourseError, Sheet, Student
from .gradebook import Gradebook, GradeKey
from .marks import with_marks
from .rules import rules_hash
from .sheet.submissions import Submission, find_submission, misnamed
from .sheets import exercises_of
from .variant import Record, canonical, digest, fingerprint, moved_parts

log = logging.getLogger(__name__)
CHANGED = (
    "The reference answer of this part is no longer the one of the day the sheet was handed out; "
    "`kinegrade grade --accept-change` marks by the new one."
)


@dataclass(frozen=True)
class Result:
    """One student's sheet: verdicts in the order of the parts, or the reason why there are none."""

    student: Student
    sheet: str
    verdicts: tuple[Verdict, ...] = ()
    reason: str = ""

    @property
    def points(self) -> float | None:
        """Points so far; None while any part waits for the instructor, or when nothing was handed in."""
        if not self.verdicts or any(verdict.points is None for verdict in self.verdicts):
            return None
        return round(sum(verdict.points or 0.0 for verdict in self.verdicts), 2)

    @property
    def out_of(self) -> float:
        """Points that could be had."""
        return sum(verdict.out_of for verdict in self.verdicts)


@dataclass(frozen=True)
class _Work:
    """What marking one submission takes."""

    student: Student
    submission: Submission
    records: dict[str, Record]
    moved: frozenset[str]
    key: GradeKey


class SheetMarker:
    """Marks the submissions of one sheet of a course."""

    def __init__(
        self,
        course: Course,
        gradebook: Gradebook,
        sheet: Sheet,
        *,
        accept_change: bool = False,
        again: bool = False,
    ) -> None:
        """Reads the exercises and the records.

        With `accept_change`, moved references become the recorded ones; with `again`, marked files are marked anew.

        Raises:
            CourseError: the sheet was handed out, but the gradebook knows nothing of it.
        """
        self.course, self.gradebook, self.sheet, self.again = course, gradebook, sheet, again
        self.exercises = exercises_of(course, sheet)
        self._parts = {
            part.variable: part for exercise in self.exercises for part in exercise.asked
        }
        self._marks = gradebook.marks(sheet.name)
        self.limits = Limits(**course.settings.limits.model_dump())
        files = exercise_files(course.folder / "exercises")
        self._hashes = [rules_hash(files[slug]) for slug in sheet.exercises]
        self._records: dict[str, dict[str, Record]] = {}
        self._moved: dict[str, frozenset[str]] = {}
        self._read_records(accept_change=accept_change)
        if not self._records and any(course.folder.glob(f"released/*/{sheet.name}.ipynb")):
            raise CourseError(
                f"{course.folder / 'gradebook.sqlite'} knows nothing of sheet {sheet.name}, though it was released; "
                "put the backup back, or run `kinegrade generate`, which draws the same numbers from the same secret"
            )

    def _read_records(self, *, accept_change: bool) -> None:
        known = {exercise.slug: exercise for exercise in self.exercises}
        for record in self.gradebook.records(self.sheet.name):
            exercise = known.get(record.exercise)
            if exercise is None:
                continue
            moved = _changed(record, exercise)
            if moved and accept_change:
                record, moved = self._accepted(record, exercise), []  # noqa: PLW2901 - the record as it now stands
            self._records.setdefault(record.student, {})[record.exercise] = record
            self._moved[record.student] = self._moved.get(record.student, frozenset()) | frozenset(
                moved
            )

    def _accepted(self, record: Record, exercise: Exercise) -> Record:
        """The record with the answers of today, here and in the gradebook."""
        try:
            answers = fingerprint(exercise, record.numbers)
        except Exception as error:
            raise CourseError(
                f"exercise {exercise.slug} cannot be accepted: it fails with {type(error).__name__}: {error} on the "
                f"numbers of {record.student}, which were handed out before it changed"
            ) from error
        self.gradebook.accept_answers(record, answers)
        return replace(record, answers=answers)

    def results(self, step: Callable[[], None] = lambda: None) -> list[Result]:
        """A result for every student of the roster, in its order; `step` is called after each."""
        done: dict[str, Result] = {}
        todo: list[_Work] = []
        for student in self.course.students:
            found = self._look(student)
            if isinstance(found, Result):
                done[student.id] = found
                step()
            else:
                todo.append(found)
        with closing(self._collected(todo)) as collected:  # also when Ctrl-C comes between two
            for work, raws in collected:
                done[work.student.id] = self._mark(work, raws)
                step()
        return [done[student.id] for student in self.course.students]

    def _look(self, student: Student) -> Result | _Work:
        """The grade that is there already, the reason why there can be none, or the work to do."""
        try:
            submission = find_submission(self.course.folder, student.id, self.sheet.name)
        except CourseError as error:
            return Result(student, self.sheet.name, self._waiting(str(error)), reason=str(error))
        if submission is None:
            other = misnamed(
                self.course.folder, student.id, [sheet.name for sheet in self.course.settings.sheet]
            )
            hint = (
                f"; {other} is there, but the file takes the name {self.sheet.name}.ipynb"
                if other
                else ""
            )
            return Result(student, self.sheet.name, reason=f"no submission{hint}")
        records = self._records.get(student.id, {})
        if len(records) < len(self.exercises):
            reason = "no sheet was generated for this student; `kinegrade generate` adds it"
            return Result(student, self.sheet.name, self._waiting(reason), reason=reason)
        moved = self._moved[student.id]
        key = GradeKey(
            student.id,
            self.sheet.name,
            digest(submission.data),
            self._rules(records, moved, submission),
        )
        verdicts = self.gradebook.verdicts(key)
        if not self.again and verdicts is not None and not self._unfinished(verdicts):
            self.gradebook.make_current(key)
            return self._result(student, verdicts)
        return _Work(student, submission, records, moved, key)

    def _rules(
        self, records: dict[str, Record], moved: frozenset[str], submission: Submission
    ) -> str:
        """A hash of all that a grade follows from besides the submission's bytes."""
        drawn = [
            [record.attempt, record.numbers, record.answers]
            for _, record in sorted(records.items())
        ]
        kind = submission.path.suffix
        parts = (
            version("kinegrade"),
            kind,
            self._hashes,
            drawn,
            sorted(moved),
            self.course.settings.limits.model_dump(),
        )
        return digest(canonical(parts).encode())

    def _waiting(self, reason: str) -> tuple[Verdict, ...]:
        return tuple(
            not_graded(part.variable, part.points, reason) for part in self._parts.values()
        )

    def _collected(
        self, todo: Sequence[_Work]
    ) -> Generator[tuple[_Work, dict[str, Raw] | Exception]]:
        """Raw values as they come in; notebooks run side by side, each in a process of its own."""
        with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
            futures = {
                pool.submit(work.submission.raws, self._asks(work), self.limits): work
                for work in todo
            }
            try:
                for future in as_completed(futures):
                    error = future.exception()
                    yield futures[future], future.result() if error is None else _plain(error)
            finally:
                pool.shutdown(
                    cancel_futures=True
                )  # stopped on the way, it does not run the rest of the class

    def _asks(self, work: _Work) -> list[Ask]:
        pairs = ((exercise, work.records[exercise.slug].numbers) for exercise in self.exercises)
        return [ask for exercise, v in pairs for ask in work.submission.asks(exercise, v)]

    def _mark(self, work: _Work, raws: dict[str, Raw] | Exception) -> Result:
        try:
            if isinstance(raws, Exception):
                raise raws  # noqa: TRY301 - both ways of failing leave the same verdicts
            verdicts = [
                verdict
                for exercise in self.exercises
                for verdict in self._mark_exercise(exercise, work, raws)
            ]
        except Exception as error:
            log.exception(
                "%s, sheet %s: the submission could not be marked", work.student.id, self.sheet.name
            )
            reason = f"the grader failed with {type(error).__name__}; the submission is kept and will be marked again"
            verdicts = [*self._waiting(reason)]
        self.gradebook.save_grade(work.key, verdicts)
        return self._result(work.student, verdicts)

    def _unfinished(self, verdicts: Sequence[Verdict]) -> bool:
        """Whether the grader left something open; what is marked by hand is not its business."""
        return any(
            v.points is None and not isinstance(self._parts[v.part].answer, Manual)
            for v in verdicts
        )

    def _result(self, student: Student, verdicts: Sequence[Verdict]) -> Result:
        return Result(
            student, self.sheet.name, with_marks(verdicts, student.id, self._marks, self._parts)
        )

    def _mark_exercise(
        self, exercise: Exercise, work: _Work, raws: dict[str, Raw]
    ) -> Iterator[Verdict]:
        others = self._others(exercise, work.student)
        try:
            verdicts = mark(exercise, work.records[exercise.slug].numbers, raws, others)
        except Exception as error:
            log.exception(
                "%s, sheet %s: %s could not be marked",
                work.student.id,
                self.sheet.name,
                exercise.slug,
            )
            reason = (
                f"exercise {exercise.slug} failed with {type(error).__name__}; your answer is kept"
            )
            verdicts = [not_graded(part.variable, part.points, reason) for part in exercise.asked]
        for verdict in verdicts:
            moved = verdict.part in work.moved
            yield not_graded(verdict.part, verdict.out_of, CHANGED) if moved else verdict

    def _others(self, exercise: Exercise, student: Student) -> dict[str, dict[str, Any]]:
        return {
            other: records[exercise.slug].answers
            for other, records in self._records.items()
            if other != student.id and exercise.slug in records
        }


def _changed(record: Record, exercise: Exercise) -> list[str]:
    try:
        return moved_parts(record, exercise)
    except Exception:  # an exercise edited since may need numbers that were never drawn
        log.exception("exercise %s fails on the numbers of %s", exercise.slug, record.student)
        return [part.variable for part in exercise.asked]


def _plain(error: BaseException) -> Exception:
    return error if isinstance(error, Exception) else RuntimeError(repr(error))


def recorded_results(course: Course, gradebook: Gradebook, sheet: Sheet) -> list[Result]:
    """What the gradebook holds for every student of the roster, without looking at submissions."""
    current, marks = gradebook.current(sheet.name), gradebook.marks(sheet.name)
    parts = {
        part.variable: part for exercise in exercises_of(course, sheet) for part in exercise.asked
    }
    return [
        Result(student, sheet.name, with_marks(current[student.id], student.id, marks, parts))
        if student.id in current
        else Result(student, sheet.name, reason="nothing marked yet")
        for student in course.students
    ]
