"""What came in for a sheet: of every student the submission, or why there is nothing to mark."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...exercises.exercise import Exercise
from ...grader.jail.level import Level
from ..grading.place import Place
from ..grading.work import waiting
from ..ledger.gradebook import GradeKey
from ..machine.code import installed
from ..results.hand_ins import HandIns
from ..results.result import Result
from ..settings.asked import asked_parts
from ..settings.config import Course, CourseError, Sheet, Student
from ..sheet.submissions import Submission
from ..variants.record import Record, canonical, digest
from .handed_out import HandedOut

NO_SHEET = "no sheet was generated for this student; `kinegrade generate` adds it"


@dataclass(frozen=True)
class Arrival:
    """A submission as it lies there, with what its grade is known by; its bytes are read for it."""

    student: Student
    submission: Submission
    beside: Mapping[str, bytes]
    key: GradeKey

    @property
    def file(self) -> Path:
        """What was handed in: the file, or the archive in which it came."""
        return self.submission.handed_in or self.submission.path


class Incoming:
    """The folder of submissions, looked at for one sheet."""

    def __init__(
        self,
        course: Course,
        sheet: Sheet,
        exercises: Sequence[Exercise],
        rules: Mapping[str, str],
        handed_out: HandedOut,
        damaged: Mapping[str, str],
        place: Place,
    ) -> None:
        """Takes what all submissions have in common.

        `rules` has of every exercise a hash of what marks follow from; `damaged` says of whom the
        gradebook cannot be read.
        """
        self._course = course
        self._sheet = sheet
        self._exercises = exercises
        self._parts = asked_parts(exercises)
        self._hashes = [rules[slug] for slug in sheet.exercises]
        self._handed_out = handed_out
        self._damaged = damaged
        self._place = place
        self._hand_ins = HandIns(course, sheet)

    def of(self, student: Student) -> Arrival | Result:
        """A student's submission, or the reason why none can be marked."""
        if student.id in self._damaged:
            return self.waits(student, self._damaged[student.id])
        try:
            submission = self._hand_ins.of(student.id)
            beside = self._hand_ins.beside(submission) if submission else {}
        except CourseError as error:
            return self.waits(student, str(error))
        if submission is None:
            return Result(student, self._sheet.name, reason=self._no_submission(student))
        records = self._handed_out.records(student.id)
        if len(records) < len(self._exercises):
            return self.waits(student, NO_SHEET)

        rules = self._rules(records, self._handed_out.moved(student.id), submission, beside)
        key = GradeKey(student.id, self._sheet.name, digest(submission.data), rules)
        return Arrival(student, submission, beside, key)

    def waits(self, student: Student, reason: str) -> Result:
        """All parts wait, and why."""
        verdicts = tuple(waiting(self._parts.values(), reason))
        return Result(student, self._sheet.name, verdicts, reason=reason)

    def _no_submission(self, student: Student) -> str:
        other = self._hand_ins.misnamed(student.id)
        if not other:
            return "no submission"
        takes = f"the file takes the name {self._sheet.name}.ipynb"
        return f"no submission; {other} is there, but {takes}"

    def _rules(
        self,
        records: Mapping[str, Record],
        moved: frozenset[str],
        submission: Submission,
        beside: Mapping[str, bytes],
    ) -> str:
        """A hash of all that a grade follows from besides the submission's bytes."""
        ordered = [records[slug] for slug in sorted(records)]
        followed = (
            installed("kinegrade"),
            submission.path.suffix,
            self._hashes,
            [(record.attempt, record.numbers, record.answers) for record in ordered],
            sorted(moved),
            self._course.settings.limits.model_dump(),
            self._course.settings.marking.model_dump(),
            *self._run_with(submission, beside),
            *self._adjusted(),
        )
        return digest(canonical(followed).encode())

    def _adjusted(self) -> list[Any]:
        """What course.toml sets otherwise than the exercises; nothing where it sets nothing."""
        adjustments = self._sheet.adjustments()
        return [adjustments] if adjustments else []

    def _run_with(self, submission: Submission, beside: Mapping[str, bytes]) -> list[Any]:
        """What else a notebook's marks follow from, where there is anything.

        What was run without walls is run again as soon as there are some.
        """
        if not submission.is_run:
            return []
        followed: list[Any] = [(name, digest(data)) for name, data in beside.items()]
        if self._course.settings.packages.allow:
            followed.append(self._course.settings.packages.allow)
        permission = self._place.walls.permission
        if permission.unsafe and self._place.level is Level.UNSAFE:
            followed.append(Level.UNSAFE)
        return followed
