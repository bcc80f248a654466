"""Marking a class: every submission on its own, every grade one transaction, nothing twice."""

import logging
import os
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from contextlib import closing
from dataclasses import dataclass, replace
from importlib.metadata import version
from typing import Any

from ..exercises.exercise import Exercise, Manual, Part
from ..exercises.files.finding import exercise_files
from ..grader.collecting.ask import Ask, Limits
from ..grader.collecting.wire import Raw
from ..grader.jail.jail import Jail
from ..grader.jail.level import Level
from ..grader.marking.follow import Peers
from ..grader.marking.guesses import counted
from ..grader.marking.mark import mark
from ..grader.marking.price import Bill, Price
from ..grader.marking.verdict import Verdict, not_graded
from .config import Course, CourseError, Sheet, Student
from .gradebook import Gradebook, GradeKey
from .handed_out import HandedOut
from .marks import with_marks
from .received import listed_times
from .results import UNSAFE_STAMP, Result, recorded_results
from .rules import rules_hash
from .same_numbers import marked_for_it, same_numbers
from .sheet.handed_in import find_submission, misnamed
from .sheet.submissions import Submission
from .sheets import asked_parts, drop_solutions, exercises_of
from .variant import Record, canonical, digest

__all__ = ["Result", "SheetMarker", "recorded_results"]
log = logging.getLogger(__name__)
CHANGED = (
    "The reference answer of this part is no longer the one of the day the sheet was handed out; "
    "`kinegrade grade --accept-change` marks by the new one."
)
NO_SHEET = "no sheet was generated for this student; `kinegrade generate` adds it"


_Raws = dict[str, Raw] | Exception
"""What came out of a submission by variable, or why nothing did."""


@dataclass(frozen=True)
class _Work:
    """What marking one submission takes."""

    student: Student
    submission: Submission
    records: Mapping[str, Record]
    moved: frozenset[str]
    key: GradeKey


class SheetMarker:
    """Marks the submissions of one sheet of a course.

    A submission is looked at (`_look`), its values are collected (`_collected`) and marked
    (`_mark`), exercise by exercise; then its grade is saved.
    """

    def __init__(
        self,
        course: Course,
        gradebook: Gradebook,
        sheet: Sheet,
        *,
        jail: Jail | None = None,
        accept_change: bool = False,
        again: bool = False,
    ) -> None:
        """Reads the exercises and the records.

        Notebooks run in `jail`, which is left open, else in one for this sheet alone. With
        `accept_change`, moved references become the recorded ones; with `again`, marked files are
        marked anew.

        Raises:
            CourseError: the sheet was handed out, but the gradebook knows nothing of it.
        """
        self.course = course
        self.gradebook = gradebook
        self.sheet = sheet
        self.jail = jail or Jail(packages=course.settings.packages.allow)
        self._own_jail = jail is None
        self.again = again
        self.absent: dict[str, set[str]] = {}  # students by the package that their notebooks miss
        self.limits = Limits(**course.settings.limits.model_dump())
        self._price = Price(**course.settings.marking.model_dump())
        self.exercises = exercises_of(course, sheet)
        self._parts = asked_parts(self.exercises)

        files = exercise_files(course.folder / "exercises")
        self._hashes = [rules_hash(files[slug]) for slug in sheet.exercises]
        self._marks = gradebook.marks(sheet.name)
        self._received = listed_times(course.folder / "submitted")
        self._handed_out = HandedOut(
            gradebook,
            sheet.name,
            self.exercises,
            accept_change=accept_change,
            before_accepting=lambda student: drop_solutions(course, sheet, student),
        )
        self._damaged = gradebook.damaged(sheet.name)
        self._refuse_a_lost_gradebook()

    @property
    def accepted(self) -> frozenset[str]:
        """Students whose answers changed since the hand-out, which was accepted just now."""
        return self._handed_out.accepted

    def _refuse_a_lost_gradebook(self) -> None:
        suffix = self.course.settings.formats[0]
        released = self.course.folder.glob(f"released/*/{self.sheet.name}.{suffix}")
        if self._handed_out.nothing and not self._damaged and any(released):
            raise CourseError(
                f"{self.gradebook.place} knows nothing of sheet "
                f"{self.sheet.name}, though it was released; put the backup back, or run "
                "`kinegrade generate`, which draws the same numbers from the same secret"
            )

    def results(self, step: Callable[[], None] = lambda: None) -> list[Result]:
        """A result for every student of the roster, in its order; `step` is called after each.

        Raises:
            JailError: there is a notebook among the submissions, and none can run as it should.
        """
        try:
            return self._results(step)
        finally:
            if self._own_jail:
                self.jail.close()

    def _results(self, step: Callable[[], None]) -> list[Result]:
        done: dict[str, Result] = {}
        todo: list[_Work] = []
        for student in self.course.students:
            found = self._look(student)
            if isinstance(found, Result):
                done[student.id] = found
                step()
            else:
                todo.append(found)

        self.gradebook.see([work.key for work in todo])
        came_in: dict[str, _Raws] = {}
        with closing(self._collected(todo)) as collected:  # also when Ctrl-C comes between two
            for work, raws in collected:
                done[work.student.id] = self._mark(work, raws)
                came_in[work.student.id] = raws
                step()
        self._look_at_same_numbers(done, came_in)
        return [done[student.id] for student in self.course.students]

    def _look_at_same_numbers(self, done: dict[str, Result], came_in: Mapping[str, _Raws]) -> None:
        """Marks those again who have the same wrong numbers, now that all answers are there.

        Also those who had them when they were marked, and no longer have.
        """
        marked = {student: result.verdicts for student, result in done.items()}
        shared = same_numbers(self._parts, marked)
        todo: list[_Work] = []
        for student in self.course.students:
            known = marked_for_it(marked[student.id])
            work = self._work(student) if (student.id in shared) != known else None
            if not isinstance(work, _Work):
                continue
            if student.id in came_in:
                peers = shared.get(student.id, {})
                done[student.id] = self._mark(work, came_in[student.id], peers)
            else:
                todo.append(work)
        with closing(self._collected(todo)) as collected:
            for work, raws in collected:
                peers = shared.get(work.student.id, {})
                done[work.student.id] = self._mark(work, raws, peers)

    def _look(self, student: Student) -> Result | _Work:
        """The grade that is there already, the reason why there can be none, or the work to do."""
        work = self._work(student)
        if isinstance(work, Result):
            return work
        verdicts = self.gradebook.verdicts(work.key)
        if self.again or verdicts is None or self._unfinished(verdicts):
            return work
        self.gradebook.make_current(work.key)
        return self._result(work, verdicts)

    def _work(self, student: Student) -> Result | _Work:
        """What marking the student's submission takes, or the reason why it cannot be marked."""
        if student.id in self._damaged:
            return self._waits(student, self._damaged[student.id])
        try:
            submission = find_submission(
                self.course.folder, student.id, self.sheet.name, self._names, self._received
            )
        except CourseError as error:
            return self._waits(student, str(error))
        if submission is None:
            return Result(student, self.sheet.name, reason=self._no_submission(student))

        records = self._handed_out.records(student.id)
        if len(records) < len(self.exercises):
            return self._waits(student, NO_SHEET)

        moved = self._handed_out.moved(student.id)
        rules = self._rules(records, moved, submission)
        key = GradeKey(student.id, self.sheet.name, digest(submission.data), rules)
        return _Work(student, submission, records, moved, key)

    @property
    def _names(self) -> list[str]:
        return [sheet.name for sheet in self.course.settings.sheet]

    def _no_submission(self, student: Student) -> str:
        other = misnamed(self.course.folder, student.id, self._names)
        if not other:
            return "no submission"
        takes = f"the file takes the name {self.sheet.name}.ipynb"
        return f"no submission; {other} is there, but {takes}"

    def _rules(
        self, records: Mapping[str, Record], moved: frozenset[str], submission: Submission
    ) -> str:
        """A hash of all that a grade follows from besides the submission's bytes."""
        ordered = [records[slug] for slug in sorted(records)]
        followed = (
            version("kinegrade"),
            submission.path.suffix,
            self._hashes,
            [(record.attempt, record.numbers, record.answers) for record in ordered],
            sorted(moved),
            self.course.settings.limits.model_dump(),
            self.course.settings.marking.model_dump(),
            *self._run_with(submission),
        )
        return digest(canonical(followed).encode())

    def _run_with(self, submission: Submission) -> list[Any]:
        """What else a notebook's marks follow from, where there is anything.

        What was run without walls is run again as soon as there are some.
        """
        if not submission.is_run:
            return []
        followed: list[Any] = []
        for name, data in submission.beside().items():
            followed.append((name, digest(data)))
        if self.course.settings.packages.allow:
            followed.append(self.course.settings.packages.allow)
        if self.jail.permission.unsafe and self.jail.level is Level.UNSAFE:
            followed.append(Level.UNSAFE)
        return followed

    def _unfinished(self, verdicts: Sequence[Verdict]) -> bool:
        """Whether the grader left something open; what is marked by hand is not its business."""
        for verdict in verdicts:
            answer = self._parts[verdict.part].answer
            by_hand = isinstance(answer, Manual) and (answer.on_paper or verdict.answer is not None)
            if verdict.points is None and not by_hand:
                return True
        return False

    def _collected(self, todo: Sequence[_Work]) -> Generator[tuple[_Work, _Raws]]:
        """Raw values as they come in; notebooks run side by side, each in a process of its own.

        Raises:
            JailError: there is a notebook among them, and none can run as it should.
        """
        if any(work.submission.is_run for work in todo):
            self.gradebook.note_level(self.jail.level)
        with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
            futures: dict[Future[dict[str, Raw]], _Work] = {}
            for work in todo:
                asks = self._asks(work)
                future = pool.submit(work.submission.raws, asks, self.limits, self.jail)
                futures[future] = work
            try:
                for future in as_completed(futures):
                    yield futures[future], _raws_or_error(future)
            finally:
                # Stopped on the way, it does not run the rest of the class.
                pool.shutdown(cancel_futures=True)

    def _asks(self, work: _Work) -> list[Ask]:
        asks: list[Ask] = []
        for exercise in self.exercises:
            asks += work.submission.asks(exercise, work.records[exercise.slug].numbers)
        return asks

    def _mark(self, work: _Work, raws: _Raws, peers: Peers | None = None) -> Result:
        """The grade of one submission, saved; where the grader fails, the submission waits."""
        if not isinstance(raws, Exception):
            for raw in raws.values():
                if raw.absent:
                    self.absent.setdefault(raw.absent, set()).add(work.student.id)
        try:
            verdicts = self._verdicts(work, raws, peers or {})
        except Exception as error:
            log.exception(
                "%s, sheet %s: the submission could not be marked", work.student.id, self.sheet.name
            )
            verdicts = self._waiting(
                f"the grader failed with {type(error).__name__}; "
                "the submission is kept and will be marked again"
            )
        verdicts = self._stamped(work, verdicts)
        self.gradebook.save_grade(work.key, verdicts)
        return self._result(work, verdicts)

    def _stamped(self, work: _Work, verdicts: Sequence[Verdict]) -> Sequence[Verdict]:
        """With a note for the instructor, where a notebook was run without walls."""
        if not work.submission.is_run or self.jail.level is not Level.UNSAFE or not verdicts:
            return verdicts
        first, *others = verdicts
        return [replace(first, findings=(*first.findings, UNSAFE_STAMP)), *others]

    def _verdicts(self, work: _Work, raws: _Raws, peers: Peers) -> Sequence[Verdict]:
        if isinstance(raws, Exception):
            raise raws
        bill = Bill(self._price)
        verdicts: list[Verdict] = []
        for exercise in self.exercises:
            verdicts += self._mark_exercise(exercise, work, raws, peers, bill)
        return verdicts

    def _mark_exercise(
        self,
        exercise: Exercise,
        work: _Work,
        raws: dict[str, Raw],
        peers: Peers,
        bill: Bill,
    ) -> Iterator[Verdict]:
        numbers = work.records[exercise.slug].numbers
        others = self._handed_out.answers_of_others(exercise, work.student.id)
        try:
            verdicts = mark(exercise, numbers, raws, others, peers=peers, bill=bill)
            verdicts = counted(exercise, verdicts)
        except Exception as error:
            log.exception(
                "%s, sheet %s: %s could not be marked",
                work.student.id,
                self.sheet.name,
                exercise.slug,
            )
            why = f"exercise {exercise.slug} failed with {type(error).__name__}"
            verdicts = _not_graded(exercise.asked, f"{why}; your answer is kept")

        for verdict in verdicts:
            if verdict.part in work.moved:
                yield not_graded(verdict.part, verdict.out_of, CHANGED)
            else:
                yield verdict

    def _waits(self, student: Student, reason: str) -> Result:
        return Result(student, self.sheet.name, self._waiting(reason), reason=reason)

    def _waiting(self, reason: str) -> tuple[Verdict, ...]:
        return tuple(_not_graded(self._parts.values(), reason))

    def _result(self, work: _Work, verdicts: Sequence[Verdict]) -> Result:
        student = work.student
        marked = with_marks(verdicts, student.id, self._marks, self._parts)
        return Result(student, self.sheet.name, marked, passed_over=work.submission.unread)


def _raws_or_error(future: Future[dict[str, Raw]]) -> dict[str, Raw] | Exception:
    error = future.exception()
    if error is None:
        return future.result()
    if isinstance(error, Exception):
        return error
    return RuntimeError(repr(error))  # what would end this process ended a thread only


def _not_graded(parts: Iterable[Part], reason: str) -> list[Verdict]:
    return [not_graded(part.variable, part.points, reason) for part in parts]
