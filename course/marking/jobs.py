"""Submissions to be marked: kept by name, read as bytes only when their turn comes."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from ...exercises.exercise import Exercise
from ...exercises.files.finding import exercise_files
from ...exercises.files.text import exercise_text
from ...grader.collecting.ask import Limits
from ...grader.marking.price import Price
from ..grading.place import Place
from ..grading.work import Came, Work
from ..ledger.gradebook import GradeKey
from ..results.result import Result
from ..settings.config import Course, Sheet, Student
from ..sheet.submissions import RUN
from .handed_out import HandedOut
from .incoming import Arrival, Incoming

Others = dict[str, dict[str, dict[str, Any]]]
"""Reference answers by exercise, student and variable."""


@dataclass(frozen=True)
class Job:
    """A submission to be marked, without its bytes.

    Attributes:
        student: Whose it is.
        key: What its grade is known by.
        file: Its name.
        others: Reference answers of others that are in it.
        peers: What others handed in, too, by student.
        unread: Names of other files for the sheet.
        came: What came out of it before.
    """

    student: Student
    key: GradeKey
    file: str
    others: Others = field(default_factory=Others)
    peers: Mapping[str, Mapping[str, Any]] = field(default_factory=dict[str, Mapping[str, Any]])
    unread: tuple[str, ...] = ()
    came: Came | None = None

    @property
    def is_run(self) -> bool:
        """Whether it is a notebook or a script."""
        return Path(self.file).suffix.lower() in RUN


def job_of(found: Arrival) -> Job:
    """The job of a submission that was looked at."""
    submission = found.submission
    return Job(found.student, found.key, submission.path.name, unread=submission.unread)


class Desk:
    """What all submissions of one sheet are marked by, and where they are read."""

    def __init__(
        self,
        course: Course,
        sheet: Sheet,
        exercises: Sequence[Exercise],
        incoming: Incoming,
        handed_out: HandedOut,
        place: Place,
    ) -> None:
        """Reads the texts of the exercises.

        Raises:
            ExerciseError: one cannot be read.
        """
        files = exercise_files(course.folder / "exercises")
        self._sheet = sheet.name
        self._adjustments = sheet.adjustments()
        self._slugs = [exercise.slug for exercise in exercises]
        self._texts = tuple(exercise_text(files[slug]) for slug in self._slugs)
        self._limits = Limits(**course.settings.limits.model_dump())
        self._price = Price(**course.settings.marking.model_dump())
        self._incoming = incoming
        self._handed_out = handed_out
        self._place = place

    def works(
        self, jobs: Iterable[Job], gone: Callable[[Result], None]
    ) -> Iterator[tuple[Job, Work]]:
        """Submissions read one by one, as they are taken; `gone` gets what is there no more.

        Who handed in anew in the meantime is marked by what lies there now.
        """
        for job in jobs:
            found = self._incoming.of(job.student)
            if isinstance(found, Result):
                gone(found)
                continue
            came = job.came if found.key == job.key else None
            fresh = replace(job_of(found), others=job.others, peers=job.peers, came=came)
            yield fresh, self._work(fresh, found)

    def _work(self, job: Job, found: Arrival) -> Work:
        records = self._handed_out.records(job.student.id)
        return Work(
            student=job.student.id,
            sheet=self._sheet,
            name=job.file,
            data=found.submission.data if job.came is None else b"",
            beside=dict(found.beside),
            exercises=self._texts,
            adjustments=self._adjustments,
            numbers=tuple(records[slug].numbers for slug in self._slugs),
            limits=self._limits,
            price=self._price,
            walls=self._place.walls,
            others=job.others,
            peers={student: dict(answers) for student, answers in job.peers.items()},
            came=job.came,
        )
