"""Marking a class: every submission on its own, every grade saved as it comes, nothing twice."""

from collections.abc import Callable, Collection, Generator, Iterable, Sequence
from contextlib import closing
from dataclasses import replace
from typing import TYPE_CHECKING

from ...exercises.exercise import Manual
from ...grader.jail.level import Level
from ...grader.marking.verdict import Verdict, not_graded
from ..grading.holding import Holding
from ..grading.place import Place
from ..grading.task import MARK
from ..grading.work import Came, Done, failed, waiting
from ..ledger.gradebook import Gradebook, GradeKey
from ..results.result import UNSAFE_STAMP, Result, standing
from ..results.same_numbers import marked_for_it, same_numbers, tells
from ..settings.asked import asked_parts, exercises_of
from ..settings.config import Course, Sheet, Student
from .arrivals import note_arrivals
from .handed_out import HandedOut, drop_solutions, refuse_a_lost_gradebook
from .incoming import Arrival, Incoming
from .jobs import Desk, Job, job_of
from .owners import Owners
from .saving import Saving

if TYPE_CHECKING:
    from pathlib import Path

CHANGED = (
    "The reference answer of this part is no longer the one of the day the sheet was handed out; "
    "`kinegrade grade --accept-change` marks by the new one."
)
KEPT = "the submission is kept and will be marked again"


class SheetMarker:
    """Marks the submissions of one sheet of a course.

    What came in is looked at, what has no grade yet is marked in some place, and every grade is
    saved as it comes. At the end those are marked again who have the same wrong numbers.
    """

    def __init__(
        self,
        course: Course,
        gradebook: Gradebook,
        sheet: Sheet,
        place: Place,
        *,
        accept_change: bool = False,
        again: bool = False,
        only: Collection[str] = (),
    ) -> None:
        """Reads the exercises and the records.

        Submissions are marked in `place`. With `accept_change`, moved references become the
        recorded ones; with `again`, marked files are marked anew. Of students who are not among
        `only`, if that names any, what is recorded stands.

        Raises:
            CourseError: the sheet was handed out, but the gradebook knows nothing of it.
        """
        self.course = course
        self.gradebook = gradebook
        self.sheet = sheet
        self.again = again
        self._only = only
        self.absent: dict[str, set[str]] = {}  # students by the package that their notebooks miss
        self._place = place
        exercises = exercises_of(course, sheet)
        self._parts = asked_parts(exercises)

        holding = Holding(course, sheet.name, sheet.exercises)
        self._handed_out = HandedOut(
            gradebook,
            sheet.name,
            exercises,
            lambda records: holding.moved(records, place),
            accept_change=accept_change,
            before_accepting=lambda student: drop_solutions(course, sheet, student),
        )
        refuse_a_lost_gradebook(course, gradebook, sheet, nothing=self._handed_out.nothing)
        damaged = gradebook.damaged(sheet.name, "record")
        self._incoming = Incoming(
            course, sheet, exercises, holding.rules, self._handed_out, damaged, place
        )
        self._desk = Desk(course, sheet, exercises, self._incoming, self._handed_out, place)
        self._owners = Owners(exercises, self._handed_out.answers)
        self._saving = Saving(gradebook)
        self._done: dict[str, Result] = {}
        self._arrived: dict[tuple[str, str], Path] = {}  # files by student and hash
        self._came_in: dict[str, Came] = {}  # of those whose numbers may be somebody else's

    @property
    def accepted(self) -> frozenset[str]:
        """Students whose answers changed since the hand-out, which was accepted just now."""
        return self._handed_out.accepted

    def results(self, step: Callable[[], None] = lambda: None) -> list[Result]:
        """A result for every student of the roster, in its order; `step` is called after each.

        Raises:
            JailError: there is a notebook among the submissions, and none can run as it should.
        """
        todo = self._unmarked(step)
        self.gradebook.see([job.key for job in todo])
        note_arrivals(self.course, self.gradebook, self.sheet, self._arrived)
        with self._saving:
            self._mark_all(todo, step)
            self._look_at_same_numbers()
        results = [self._done[student.id] for student in self.course.students]
        return standing(self.course, self.gradebook, self.sheet, results)

    def _unmarked(self, step: Callable[[], None]) -> list[Job]:
        """What is to be marked; of all others the result is known."""
        jobs: list[Job] = []
        if self._only:
            self._take_recorded(step)
        for student in self.course.students:
            if student.id in self._done:
                continue
            found = self._incoming.of(student)
            if isinstance(found, Arrival):
                jobs.append(job_of(found))
                self._arrived[student.id, found.key.submission] = found.file
            else:
                self._done[student.id] = found
                step()

        worth = {name: part.points for name, part in self._parts.items()}
        known = self.gradebook.graded([job.key for job in jobs], worth)
        todo: list[Job] = []
        counting: list[GradeKey] = []
        for job in jobs:
            verdicts = known.get(job.key)
            if self.again or verdicts is None or self._unfinished(verdicts):
                todo.append(job)
                continue
            counting.append(job.key)
            self._done[job.student.id] = self._result(job, verdicts)
            step()
        self.gradebook.make_current(counting)
        return todo

    def _take_recorded(self, step: Callable[[], None]) -> None:
        """What the gradebook has of those who are not marked now."""
        current = self.gradebook.current(self.sheet.name, self._parts)
        damaged = self.gradebook.damaged(self.sheet.name, "grade")
        for student in self.course.students:
            if student.id in self._only:
                continue
            if student.id in damaged:
                self._done[student.id] = self._incoming.waits(student, damaged[student.id])
            else:
                verdicts = tuple(current.get(student.id, ()))
                reason = "" if verdicts else "nothing marked yet"
                self._done[student.id] = Result(student, self.sheet.name, verdicts, reason)
            step()

    def _unfinished(self, verdicts: Sequence[Verdict]) -> bool:
        """Whether the grader left something open; what is marked by hand is not its business."""
        for verdict in verdicts:
            answer = self._parts[verdict.part].answer
            by_hand = isinstance(answer, Manual) and (answer.on_paper or verdict.answer is not None)
            if verdict.points is None and not by_hand:
                return True
        return False

    def _mark_all(self, todo: Sequence[Job], step: Callable[[], None]) -> None:
        """Marks and saves; who handed in somebody else's answers is marked with these at hand."""
        not_own: list[Job] = []
        with closing(self._marked(todo)) as marked:  # also when Ctrl-C comes between two
            for job, done in marked:
                owners = self._owners.of(job.student.id, done.verdicts)
                if owners:
                    not_own.append(replace(job, others=owners, came=done.came))
                else:
                    self._save(job, done)
                    step()
        with closing(self._marked(not_own)) as marked:
            for job, done in marked:
                self._save(job, done)
                step()

    def _look_at_same_numbers(self) -> None:
        """Marks those again who have the same wrong numbers, now that all answers are there.

        Also those who had them when they were marked, and no longer have.
        """
        verdicts = {student.id: self._done[student.id].verdicts for student in self.course.students}
        shared = same_numbers(self._parts, verdicts)
        todo: list[Job] = []
        for student in self.course.students:
            own = verdicts[student.id]
            left_alone = self._only and student.id not in self._only
            if left_alone or (student.id in shared) == marked_for_it(own):
                continue
            found = self._incoming.of(student)
            if isinstance(found, Arrival):
                owners = self._owners.of(student.id, own)
                peers = shared.get(student.id, {})
                came = self._came_in.get(student.id)
                todo.append(replace(job_of(found), others=owners, peers=peers, came=came))
        with closing(self._marked(todo)) as marked:
            for job, done in marked:
                self._save(job, done)

    def _marked(self, jobs: Sequence[Job]) -> Generator[tuple[Job, Done]]:
        """What came of each, as they are done.

        Raises:
            JailError: there is a notebook among them, and none can run as it should.
        """
        if any(job.is_run and job.came is None for job in jobs):
            self.gradebook.note_level(self._place.level)
        works = self._desk.works(jobs, self._keep)
        with closing(self._place.run(MARK, works, len(jobs))) as results:
            for job, done in results:
                if isinstance(done, BaseException):
                    yield job, Done(failure=failed(done))
                else:
                    yield job, done

    def _keep(self, result: Result) -> None:
        self._done[result.student.id] = result

    def _save(self, job: Job, done: Done) -> None:
        """The grade of one submission; where the grader failed, the submission waits."""
        for package in done.absent:
            self.absent.setdefault(package, set()).add(job.student.id)
        verdicts = self._with_moved(job.student, done.verdicts)
        if done.failure:
            verdicts = waiting(self._parts.values(), f"{done.failure}; {KEPT}")
        if done.came.level is Level.UNSAFE and verdicts:
            first, *rest = verdicts
            verdicts = [replace(first, findings=(*first.findings, UNSAFE_STAMP)), *rest]
        self._saving.add(job.key, verdicts)
        self._done[job.student.id] = self._result(job, verdicts)
        if any(tells(self._parts.get(verdict.part), verdict) for verdict in verdicts):
            self._came_in[job.student.id] = done.came

    def _with_moved(self, student: Student, verdicts: Iterable[Verdict]) -> list[Verdict]:
        """Verdicts, but for those parts whose reference moved."""
        moved = self._handed_out.moved(student.id)
        found: list[Verdict] = []
        for verdict in verdicts:
            if verdict.part in moved:
                found.append(not_graded(verdict.part, verdict.out_of, CHANGED))
            else:
                found.append(verdict)
        return found

    def _result(self, job: Job, verdicts: Sequence[Verdict]) -> Result:
        student = job.student
        return Result(student, self.sheet.name, tuple(verdicts), passed_over=job.unread)
