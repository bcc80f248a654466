"""A robot of the catalogue as one student has it: with the lengths, the form and the q drawn."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Exercise
from ...solutions.robot import Robot
from ..ledger.gradebook import Gradebook
from ..settings.asked import exercises_of
from ..settings.config import Course, CourseError, Sheet

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class OwnRobot:
    """A robot with a student's lengths [m] and joint values (n,), and where they were drawn."""

    robot: Robot
    lengths: Mapping[str, float]
    q: Array | None
    sheet: str
    exercise: str

    @property
    def place(self) -> str:
        """Where it is asked about."""
        return f"{self.exercise} of sheet {self.sheet}"


def own_robot(
    course: Course,
    gradebook: Gradebook,
    sheets: Sequence[Sheet],
    student: str,
    robot: Robot,
    exercise: str | None = None,
    *,
    at_q: bool = False,
) -> OwnRobot:
    """The robot as a student has it in the one exercise of these sheets that asks about it.

    Several exercises will do where it is the same arm in all of them, and `at_q` at the same q.

    Raises:
        CourseError: nobody has that id, nothing was drawn, or no exercise, or several, ask about
            the robot.
    """
    course.student(student)  # refused where nobody has that id
    found: list[OwnRobot] = []
    others: list[str] = []
    for sheet in sheets:
        for one, numbers in _drawn(course, gradebook, sheet, student):
            if one.robot == robot.name and exercise in (None, one.slug):
                found.append(_own(robot, one, numbers, sheet.name))
            elif one.robot:
                others.append(f"{one.robot} in {one.slug} of sheet {sheet.name}")

    if not found:
        raise CourseError(_nothing_found(student, robot, exercise, others))
    if any(_differs(found[0], one, at_q=at_q) for one in found[1:]):
        places = ", ".join(one.place for one in found)
        raise CourseError(
            f"{student} has {robot.name} in {len(found)} exercises: {places}; "
            "say which with --sheet or --exercise"
        )
    return found[0]


def _nothing_found(student: str, robot: Robot, exercise: str | None, others: Sequence[str]) -> str:
    """The sentence where a student has no such robot."""
    asked = f"no exercise about {robot.name}"
    if exercise:
        asked = f"no exercise {exercise} about {robot.name}"
    if not others:
        return (
            f"{student} has {asked}, nor about another robot; "
            "`kinegrade generate` draws what was not drawn yet"
        )
    return f"{student} has {asked}; there are {', '.join(others)}"


def _differs(one: OwnRobot, other: OwnRobot, *, at_q: bool) -> bool:
    """Whether a figure of one is not one of the other."""
    if _arm(one) != _arm(other):
        return True
    if not at_q or one.q is None or other.q is None:
        return at_q and one.q is not other.q
    return not np.array_equal(one.q, other.q)


def _arm(own: OwnRobot) -> tuple[Any, ...]:
    """What tells one arm from another."""
    robot = own.robot
    return robot.rows, robot.base, robot.tool, robot.convention, dict(own.lengths)


def _drawn(
    course: Course, gradebook: Gradebook, sheet: Sheet, student: str
) -> Iterator[tuple[Exercise, dict[str, Any]]]:
    """The exercises of a sheet of which something was drawn for a student, and the numbers."""
    known = {exercise.slug: exercise for exercise in exercises_of(course, sheet)}
    for record in gradebook.records(sheet.name):
        if record.student == student and record.exercise in known:
            yield known[record.exercise], record.numbers


def _own(robot: Robot, exercise: Exercise, numbers: dict[str, Any], sheet: str) -> OwnRobot:
    """The arm of an exercise; of one without, the robot with what was drawn of its lengths."""
    if exercise.arm is not None:
        arm = exercise.arm(numbers)
        own: Robot = arm.robot
        if own.kinds == robot.kinds:  # the rows whose determinant is looked at
            own = replace(own, task_rows=robot.task_rows, title=robot.title)
        return OwnRobot(own, arm.lengths, arm.q, sheet, exercise.slug)
    lengths = {name: float(numbers[name]) for name in robot.parameters if name in numbers}
    q = np.asarray(numbers.get("q", ()), dtype=float)
    return OwnRobot(robot, lengths, q if q.shape == (robot.n,) else None, sheet, exercise.slug)
