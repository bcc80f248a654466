"""Handing out: what is not drawn yet is drawn, what is released is never touched again."""

from collections import defaultdict
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ...exercises.exercise import Exercise
from ..grading.holding import Holding
from ..ledger.gradebook import Gradebook, OvertakenError
from ..machine.console import say
from ..settings.asked import exercises_of
from ..settings.config import Course, CourseError, Sheet, Student
from ..sheet.given import printed
from ..sheet.handout import read_handout
from ..variants.record import Record, canonical
from ..variants.secret import read_secret
from ..variants.variant import draw_record
from ..variants.variant_code import variant_code
from .release import Order, write_all, write_solutions


@dataclass(frozen=True)
class Released:
    """What `generate` did for one student's sheet."""

    student: str
    sheet: str
    path: Path
    new: bool


def generate(
    course: Course,
    gradebook: Gradebook,
    sheets: tuple[Sheet, ...],
    step: Callable[[], None] = lambda: None,
) -> list[Released]:
    """A sheet, a worked solution and, where asked, a MATLAB script for every student.

    `step` is called after each. A student whose records are damaged is named and left out.
    """
    done: list[Released] = []
    secret = cache(lambda: read_secret(course))  # not asked for where all is drawn
    for sheet in sheets:
        exercises = exercises_of(course, sheet)
        draws = _Draws(secret, sheet, exercises, gradebook)
        holding = Holding(course, sheet.name, sheet.exercises)
        new = {student.id for student in course.students if _is_new(course, sheet, student)}
        orders = _orders(course, sheet, draws, holding, step)
        try:
            for _ in write_all(orders, exercises, expected=len(new)):
                step()
        finally:
            holding.save()
        for student in course.students:
            if student.id not in draws.damaged:
                path = _released(course, sheet, student)
                done.append(Released(student.id, sheet.name, path, new=student.id in new))
    return done


def _orders(
    course: Course,
    sheet: Sheet,
    draws: "_Draws",
    holding: Holding,
    step: Callable[[], None],
) -> Iterator[Order]:
    """What is to be written for every student, whose numbers are recorded before that."""
    for student in course.students:
        damage = draws.damaged.get(student.id)
        if damage is not None:
            say(f"{student.id}, sheet {sheet.name}: {damage}")
            step()
            continue
        records = _recorded(draws, student, _released(course, sheet, student, "ipynb"), holding)
        yield _order(course, sheet, student, records, draws.all_of(student))


def renew_solutions(
    course: Course, gradebook: Gradebook, sheet: Sheet, students: Collection[str]
) -> int:
    """Writes the worked solutions of these students again; how many students that were."""
    exercises = exercises_of(course, sheet)
    draws = _Draws(lambda: "", sheet, exercises, gradebook)
    renewed = 0
    for student in course.students:
        if student.id not in students or student.id in draws.damaged:
            continue
        order = _order(course, sheet, student, draws.of(student), draws.all_of(student))
        write_solutions(order, exercises)
        renewed += 1
    return renewed


def _order(
    course: Course,
    sheet: Sheet,
    student: Student,
    records: Sequence[Record],
    recorded: Sequence[Record],
) -> Order:
    return Order(
        course.folder,
        course.settings.title,
        course.settings.formats,
        sheet,
        student,
        tuple(record.numbers for record in records),
        variant_code(recorded),
        course.settings.limits,
        course.settings.packages,
    )


def _recorded(draws: "_Draws", student: Student, path: Path, holding: Holding) -> list[Record]:
    """A student's records, drawn and saved where they were not."""
    while True:
        fresh = draws.complete(student)
        records = draws.of(student)
        if not fresh:
            return records
        _agree(path, draws.exercises, records)
        try:
            draws.gradebook.save_records(fresh)
        except OvertakenError:  # what another kinegrade drew in the meantime holds
            draws.read()
        else:
            for record in fresh:
                holding.add(record)
            return records


class _Draws:
    """What is drawn of one sheet, so that no two students get the same numbers."""

    def __init__(
        self,
        secret: Callable[[], str],
        sheet: Sheet,
        exercises: list[Exercise],
        gradebook: Gradebook,
    ) -> None:
        self._secret = secret
        self._sheet = sheet
        self.exercises = exercises
        self.gradebook = gradebook
        self.read()

    def read(self) -> None:
        """Takes what the gradebook holds by now, and forgets what was drawn and not saved."""
        self._records: defaultdict[str, dict[str, Record]] = defaultdict(dict)
        self._taken: defaultdict[str, set[str]] = defaultdict(set)  # numbers as `canonical` text
        for record in self.gradebook.records(self._sheet.name):
            self._add(record)
        self.damaged = self.gradebook.damaged(self._sheet.name, "record")

    def _add(self, record: Record) -> None:
        self._records[record.student][record.exercise] = record
        self._taken[record.exercise].add(canonical(record.numbers))

    def of(self, student: Student) -> list[Record]:
        """A student's records in the order of the exercises."""
        own = self._records[student.id]
        return [own[exercise.slug] for exercise in self.exercises]

    def all_of(self, student: Student) -> list[Record]:
        """A student's records, also of exercises that are no longer on the sheet."""
        return [*self._records[student.id].values()]

    def complete(self, student: Student) -> list[Record]:
        """Draws what was not drawn for the student before, and returns that."""
        fresh: list[Record] = []
        for exercise in self.exercises:
            slug = exercise.slug
            if slug in self._records[student.id]:
                continue
            pinned = self._sheet.pinned.get(slug)
            record = draw_record(
                self._secret(), self._sheet.name, student.id, exercise, self._taken[slug], pinned
            )
            self._add(record)
            fresh.append(record)
        return fresh


def _agree(path: Path, exercises: list[Exercise], records: list[Record]) -> None:
    """Refuses to record numbers for a notebook that was handed out with others."""
    if not path.exists():
        return
    drawn: dict[str, dict[str, Any]] = {}
    for exercise, record in zip(exercises, records, strict=True):
        drawn[exercise.slug] = printed(exercise, record.numbers)
    try:
        same = read_handout(path).numbers == drawn
    except CourseError:
        same = False
    if not same:
        raise CourseError(
            f"{path} was handed out with other exercises or numbers than would be drawn now, "
            "so nothing was recorded; give new exercises a sheet of their own, "
            "or bring back the gradebook and the secret of that day"
        )


def _released(course: Course, sheet: Sheet, student: Student, suffix: str = "") -> Path:
    """The student's file, in the first format where none is named."""
    suffix = suffix or course.settings.formats[0]
    return course.folder / "released" / student.id / f"{sheet.name}.{suffix}"


def _is_new(course: Course, sheet: Sheet, student: Student) -> bool:
    """Whether a file is missing that students get."""
    formats = course.settings.formats
    return not all(_released(course, sheet, student, suffix).exists() for suffix in formats)
