"""Whether an answer is right for another value of one length, or for another angle of one joint.

A Jacobian is affine in every length, and in cosine and sine of every joint angle, so that the one
unknown value follows from the answer; all other entries then have to agree.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .bank import changed
from .mistake import Known, Mistake
from .steps import SIZE, Array, Steps
from .switches import Switches
from .views import View

CIRCLE = 0.02  # by which c^2 + s^2 may miss 1, with rounded entries
LEAST_LENGTH, LEAST_ANGLE = 3, 4  # entries that have to follow from the one value
LEAST_NUMBERS = 3  # that an answer depends on: of one alone, anybody's is one for another value
LEAST_ENTRIES = 4  # of an answer
FAR = 10.0  # tolerances by which some entry is off: another number is no inaccuracy
TURNS = (0.0, np.pi / 2, np.pi)
OTHER_LENGTH = Known(
    "another length",
    "It fits another value of {name}; all else agrees.",
    "{name} has another value",
    "slip",
    "numbers",
    prior=0.4,
)
OTHER_STROKE = Known(
    "another stroke",
    "It fits another stroke of joint {i}; all else agrees.",
    "joint {i} has another stroke",
    "slip",
    "numbers",
    prior=0.4,
)
OTHER_ANGLE = Known(
    "another angle",
    "It fits another angle of joint {i}; all else agrees.",
    "joint {i} has another angle",
    "slip",
    "numbers",
    prior=0.45,
)


@dataclass(frozen=True, eq=False)
class Line:
    """Where an answer (entries,) lies for other values of one number: reference + t direction."""

    mistake: Mistake
    direction: Array

    @property
    def moves(self) -> bool:
        """Whether the number changes the answer."""
        return bool(np.abs(self.direction).max(initial=0.0) > SIZE)


@dataclass(frozen=True, eq=False)
class Circle:
    """Where it lies for other angles of one joint: middle + cosine c + sine s."""

    mistake: Mistake
    middle: Array
    cosine: Array
    sine: Array

    @property
    def moves(self) -> bool:
        """Whether the angle changes the answer."""
        return bool(max(np.abs(self.cosine).max(), np.abs(self.sine).max()) > SIZE)


class OtherNumbers:
    """The lines and circles of one part's answers."""

    def __init__(self, steps: Steps, view: View, reference: Array) -> None:
        """Takes the arm, what of it is asked, and the right answer."""
        self.reference = reference.ravel()
        moved = _moved(steps, view)
        self.lines = [line for line in _lines(steps, moved, self.reference) if line.moves]
        circles = _circles(steps, moved, self.reference)
        self.circles = [circle for circle in circles if circle.moves]

    def fitting(self, value: Array, allowed: Array) -> Iterator[Mistake]:
        """Those on which an answer lies."""
        value, allowed = value.ravel(), allowed.ravel()
        if len(self.lines) + len(self.circles) < LEAST_NUMBERS or value.size < LEAST_ENTRIES:
            return
        if (np.abs(value - self.reference) <= FAR * allowed).all():
            return
        for line in self.lines:
            if _is_on_line(line, value - self.reference, allowed):
                yield line.mistake
        for circle in self.circles:
            if _is_on_circle(circle, value, self.reference, allowed):
                yield circle.mistake


@dataclass(frozen=True, eq=False)
class Moved:
    """The answers (H, entries) for other numbers.

    Attributes:
        longer: With every length by 1 m longer.
        further: With every slide by 1 m further.
        turned: With every angle at all `TURNS`, one joint after the other.
    """

    longer: Array
    further: Array
    turned: Array


def _moved(steps: Steps, view: View) -> Moved:
    """All in one call, for many hypotheses take hardly longer than one."""
    lengths, slides = len(steps.lengths), _joints(steps, "P")
    turns = [(joint, angle) for joint in _joints(steps, "R") for angle in TURNS]
    ends = np.cumsum([lengths, len(slides), len(turns)])

    def move(switches: Switches) -> None:
        for row, direction in enumerate(steps.lengths.values()):
            switches.constants[row] += direction
        for row, joint in enumerate(slides, ends[0]):
            switches.q[row, joint] += 1.0
        for row, (joint, angle) in enumerate(turns, ends[1]):
            switches.q[row, joint] = angle

    answers = view.of(changed(steps, view.setting, ends[2], move))
    return Moved(*np.split(answers.reshape(ends[2], -1), ends[:2]))


def _joints(steps: Steps, kind: str) -> list[int]:
    return [joint for joint, own in enumerate(steps.kinds) if own == kind]


def _lines(steps: Steps, moved: Moved, reference: Array) -> Iterator[Line]:
    for name, value in zip(steps.lengths, moved.longer, strict=True):
        yield Line(OTHER_LENGTH.of(name=name), value - reference)
    for joint, value in zip(_joints(steps, "P"), moved.further, strict=True):
        yield Line(OTHER_STROKE.of(i=joint + 1), value - reference)


def _circles(steps: Steps, moved: Moved, reference: Array) -> Iterator[Circle]:
    turning = _joints(steps, "R")
    turned = moved.turned.reshape(len(turning), len(TURNS), reference.size)
    for joint, values in zip(turning, turned, strict=True):
        right, up, left = values
        middle = (right + left) / 2
        circle = Circle(OTHER_ANGLE.of(i=joint + 1), middle, right - middle, up - middle)
        own = steps.q[joint]
        on_it = middle + circle.cosine * np.cos(own) + circle.sine * np.sin(own)
        if np.allclose(on_it, reference, rtol=0, atol=SIZE):
            yield circle


def _is_on_line(line: Line, off: Array, allowed: Array) -> bool:
    square = float(line.direction @ line.direction)
    moved = line.direction * float(line.direction @ off) / square
    shows = np.abs(moved) > allowed
    return bool(shows.sum() >= LEAST_LENGTH and (np.abs(off - moved) <= allowed).all())


def _is_on_circle(circle: Circle, value: Array, reference: Array, allowed: Array) -> bool:
    basis = np.column_stack([circle.cosine, circle.sine])
    (c, s), _, rank, _ = np.linalg.lstsq(basis, value - circle.middle, rcond=SIZE)
    if rank < 2 or abs(np.hypot(c, s) - 1.0) > CIRCLE:
        return False
    fitted = circle.middle + basis @ (c, s)
    shows = np.abs(fitted - reference) > allowed
    return bool(shows.sum() >= LEAST_ANGLE and (np.abs(value - fitted) <= allowed).all())
