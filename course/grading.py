"""Marking a class: every submission on its own, every grade one transaction, nothing marked twice."""

import hashlib
import logging
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, replace
from importlib.metadata import version
from typing import Any

from ..exercises.catalogue import exercise_files
from ..exercises.exercise import Exercise
from ..grader.collect import Ask, Limits
from ..grader.mark import mark
from ..grader.verdict import Verdict, not_graded
from ..grader.wire import Raw
from .config import Course, CourseError, Sheet, Student
from .gradebook import GradeKey, Gradebook
from .sheets import exercises_of
from .submissions import Submission, find_submission
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
    notes: tuple[str, ...] = ()

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

    def __init__(self, course: Course, gradebook: Gradebook, sheet: Sheet, *, accept_change: bool = False) -> None:
        """Reads the exercises and the records; with `accept_change`, moved references become the recorded ones."""
        self.course, self.gradebook, self.sheet = course, gradebook, sheet
        self.exercises = exercises_of(course, sheet)
        self.limits = Limits(**course.settings.limits.model_dump())
        self._files = exercise_files(course.folder / "exercises")
        self._records: dict[str, dict[str, Record]] = {}
        self._moved: dict[str, frozenset[str]] = {}
        self._read_records(accept_change=accept_change)

    def _read_records(self, *, accept_change: bool) -> None:
        known = {exercise.slug: exercise for exercise in self.exercises}
        for record in self.gradebook.records(self.sheet.name):
            exercise = known.get(record.exercise)
            if exercise is None:
                continue
            moved = moved_parts(record, exercise)
            if moved and accept_change:
                answers = fingerprint(exercise, record.numbers)
                self.gradebook.accept_answers(record, answers)
                record, moved = replace(record, answers=answers), []  # noqa: PLW2901 - the record as it now stands
            self._records.setdefault(record.student, {})[record.exercise] = record
            self._moved[record.student] = self._moved.get(record.student, frozenset()) | frozenset(moved)

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
        for work, raws in self._collected(todo):
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
            return Result(student, self.sheet.name, reason="no submission")
        records = self._records.get(student.id, {})
        if len(records) < len(self.exercises):
            reason = "no sheet was generated for this student; `kinegrade generate` adds it"
            return Result(student, self.sheet.name, self._waiting(reason), reason=reason)
        moved = self._moved[student.id]
        key = GradeKey(student.id, self.sheet.name, digest(submission.data), self._rules(records, moved, submission))
        verdicts = self.gradebook.verdicts(key)
        if verdicts is not None and all(verdict.status != "not_graded" for verdict in verdicts):
            self.gradebook.save_grade(key, verdicts)  # it may not be the current one
            return Result(student, self.sheet.name, tuple(verdicts))
        return _Work(student, submission, records, moved, key)

    def _rules(self, records: dict[str, Record], moved: frozenset[str], submission: Submission) -> str:
        """A hash of all that a grade follows from besides the submission's bytes."""
        texts = [hashlib.sha256(self._files[slug].read_bytes()).hexdigest() for slug in self.sheet.exercises]
        drawn = [[record.attempt, record.numbers, record.answers] for _, record in sorted(records.items())]
        kind = submission.path.suffix
        parts = (version("kinegrade"), kind, texts, drawn, sorted(moved), self.course.settings.limits.model_dump())
        return digest(canonical(parts).encode())

    def _waiting(self, reason: str) -> tuple[Verdict, ...]:
        return tuple(not_graded(part.variable, part.points, reason) for part in self._parts())

    def _parts(self) -> Iterator[Any]:
        return (part for exercise in self.exercises for part in exercise.asked)

    def _collected(self, todo: Sequence[_Work]) -> Iterator[tuple[_Work, dict[str, Raw] | Exception]]:
        """Raw values as they come in; notebooks run side by side, each in a process of its own."""
        asks = [Ask(part.variable) for part in self._parts()]
        with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
            futures = {pool.submit(work.submission.raws, asks, self.limits): work for work in todo}
            for future in as_completed(futures):
                error = future.exception()
                yield futures[future], future.result() if error is None else _plain(error)

    def _mark(self, work: _Work, raws: dict[str, Raw] | Exception) -> Result:
        try:
            if isinstance(raws, Exception):
                raise raws  # noqa: TRY301 - both ways of failing leave the same verdicts
            verdicts = [verdict for exercise in self.exercises for verdict in self._mark_exercise(exercise, work, raws)]
        except Exception as error:
            log.exception("%s, sheet %s: the submission could not be marked", work.student.id, self.sheet.name)
            reason = f"the grader failed with {type(error).__name__}; the submission is kept and will be marked again"
            verdicts = [*self._waiting(reason)]
        self.gradebook.save_grade(work.key, verdicts)
        return Result(work.student, self.sheet.name, tuple(verdicts))

    def _mark_exercise(self, exercise: Exercise, work: _Work, raws: dict[str, Raw]) -> Iterator[Verdict]:
        others = self._others(exercise, work.student)
        for verdict in mark(exercise, work.records[exercise.slug].numbers, raws, others):
            moved = verdict.part in work.moved
            yield not_graded(verdict.part, verdict.out_of, CHANGED) if moved else verdict

    def _others(self, exercise: Exercise, student: Student) -> dict[str, dict[str, Any]]:
        return {
            other: records[exercise.slug].answers
            for other, records in self._records.items()
            if other != student.id and exercise.slug in records
        }


def _plain(error: BaseException) -> Exception:
    return error if isinstance(error, Exception) else RuntimeError(repr(error))


def recorded_results(course: Course, gradebook: Gradebook, sheet: Sheet) -> list[Result]:
    """What the gradebook holds for every student of the roster, without looking at submissions."""
    current = gradebook.current(sheet.name)
    return [
        Result(student, sheet.name, tuple(current[student.id]))
        if student.id in current
        else Result(student, sheet.name, reason="nothing marked yet")
        for student in course.students
    ]
