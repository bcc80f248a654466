"""The mistakes in the numbers that go in, for the rows and the lengths of one arm."""

from collections.abc import Iterator

import numpy as np

from . import known_numbers as known
from .mistake import Mistake
from .steps import SIZE, Array, Steps
from .switches import SUM_AS_PRODUCT, SUM_AS_SUM, Edit

DEGREES = 180 / np.pi
ROUNDED_PI = 3.14 / np.pi
TABLE_ROW = ("Rz", "Tz", "Tx", "Rx")  # motions of theta, d, a and alpha
CELLS = {"Rz": "theta", "Tz": "d", "Tx": "a", "Rx": "alpha"}


def in_numbers(steps: Steps) -> Iterator[Mistake]:
    """Those of one arm."""
    yield from _in_degrees(steps)
    yield from _in_fixed_angles(steps)
    yield from _in_joints(steps)
    yield from _in_lengths(steps)
    yield from _in_cells(steps)
    yield from _in_sums(steps)


def _scaled(places: list[int], factor: float) -> Edit:
    return Edit("constants", "scale", factor, tuple(places))


def _fixed_turns(steps: Steps, motions: tuple[str, ...]) -> list[int]:
    """Places of fixed turns in the rows of the joints."""
    found: list[int] = []
    for place, motion in enumerate(steps.motions):
        is_in_row = 1 <= steps.rows[place] <= steps.n
        if motion in motions and is_in_row and abs(steps.constants[place]) > SIZE:
            found.append(place)
    return found


def _in_degrees(steps: Steps) -> Iterator[Mistake]:
    turning = tuple(i for i, kind in enumerate(steps.kinds) if kind == "R")
    fixed = _fixed_turns(steps, ("Rx", "Ry", "Rz"))
    if turning:
        in_degrees = Edit("q", "scale", DEGREES, turning)
        yield known.AS_DEGREES.of(Edit("q", "scale", 1 / DEGREES, turning))
        yield known.IN_DEGREES.of(in_degrees)
        if fixed:
            yield known.ALL_IN_DEGREES.of(in_degrees, _scaled(fixed, DEGREES))
    if fixed:
        yield known.CONSTANTS_IN_DEGREES.of(_scaled(fixed, DEGREES))
        yield known.SHORT_PI.of(_scaled(fixed, ROUNDED_PI))


def _in_fixed_angles(steps: Steps) -> Iterator[Mistake]:
    offsets = _fixed_turns(steps, ("Rz",))
    if offsets:
        yield known.OFFSETS.of(_scaled(offsets, 0.0))
    twists = _fixed_turns(steps, ("Rx",))
    if len(twists) > 1:
        yield known.ALPHA_SIGNS.of(_scaled(twists, -1.0))
    if steps.convention == "frames":
        return  # such an arm has no rows with names
    for place in offsets:
        if len(offsets) > 1:
            yield known.OFFSET.of(_scaled([place], 0.0), i=steps.rows[place])
    for place in twists:
        yield known.ALPHA_SIGN.of(_scaled([place], -1.0), i=steps.rows[place])
        yield known.ALPHA_FORGOTTEN.of(_scaled([place], 0.0), i=steps.rows[place])


def _in_joints(steps: Steps) -> Iterator[Mistake]:
    for joint in range(steps.n):
        yield known.ANGLE_SIGN.of(Edit("q", "scale", -1.0, (joint,)), i=joint + 1)


def _in_lengths(steps: Steps) -> Iterator[Mistake]:
    for name, direction in steps.lengths.items():
        value = steps.values[name]
        if abs(value) < SIZE:
            continue
        places = tuple(map(int, np.flatnonzero(direction)))
        own = value * direction[[*places]]
        yield known.FORGOTTEN.of(Edit("constants", "add", -own, places), name=name)
        yield known.LENGTH_SIGN.of(Edit("constants", "add", -2 * own, places), name=name)
    slides = [k for k, motion in enumerate(steps.motions) if motion[0] == "T"]
    if len(steps.lengths) > 1:
        yield known.ALL_FORGOTTEN.of(_scaled(slides, 0.0))
    ends = ((known.BASE, 0), (known.TOOL, steps.n + 1))
    for one, row in ends:
        places = [int(place) for place in np.flatnonzero(steps.rows == row)]
        if np.abs(steps.constants[places]).max(initial=0.0) > SIZE:
            yield one.of(_scaled(places, 0.0))


def _in_cells(steps: Steps) -> Iterator[Mistake]:
    """Mistakes in the rows of a table."""
    if steps.convention == "frames":
        return
    rows = [[steps.at(row, motion)[0] for motion in TABLE_ROW] for row in range(1, steps.n + 1)]
    for row, (theta, d, a, _) in enumerate(rows, 1):
        if steps.kinds[row - 1] == "P":
            yield known.STROKE_TURNS.of(Edit("gains", "exchange", at=(theta, d)), i=row)
            continue
        yield known.THETA_AND_D.of(*_exchanged(theta, d), i=row)
        if steps.constants[a] != steps.constants[d]:
            yield known.A_AND_D.of(Edit("constants", "exchange", at=(a, d)), i=row)
    yield from _without_names(steps)
    yield from _exchanged_columns(steps, rows)


def _without_names(steps: Steps) -> Iterator[Mistake]:
    """Cells that are numbers, forgotten."""
    named = np.abs([*steps.lengths.values(), np.zeros(len(steps.motions))]).max(axis=0)
    is_number = (np.abs(steps.constants) > SIZE) & (named < SIZE)
    for place in map(int, np.flatnonzero(is_number)):
        row, motion = int(steps.rows[place]), steps.motions[place]
        if motion in ("Tz", "Tx") and 1 <= row <= steps.n:
            yield known.CELL_FORGOTTEN.of(_scaled([place], 0.0), i=row, cell=CELLS[motion])


def _exchanged(one: int, other: int) -> tuple[Edit, Edit]:
    places = (one, other)
    return Edit("constants", "exchange", at=places), Edit("gains", "exchange", at=places)


def _exchanged_columns(steps: Steps, rows: list[list[int]]) -> Iterator[Mistake]:
    """Two columns of a table exchanged in all rows of revolute joints."""
    turning = [row for row, kind in zip(rows, steps.kinds, strict=True) if kind == "R"]
    lengths: list[Edit] = []
    moves: list[Edit] = []
    for theta, d, a, _ in turning:
        lengths.append(Edit("constants", "exchange", at=(a, d)))
        moves.extend(_exchanged(theta, d))
    if len(turning) > 1:
        yield known.ALL_A_AND_D.of(*lengths)
        yield known.ALL_THETA_AND_D.of(*moves)


def _in_sums(steps: Steps) -> Iterator[Mistake]:
    """Mistakes in the angles of neighbouring joints with parallel axes."""
    for joint in range(1, steps.n):
        if not _is_parallel_to_last(steps, joint):
            continue
        i, j = joint, joint + 1
        yield known.PRODUCT.of(Edit("sums", "set", SUM_AS_PRODUCT, (joint,)), i=i, j=j)
        yield known.SUM.of(Edit("sums", "set", SUM_AS_SUM, (joint,)), i=i, j=j)
        before = _angle(steps, joint - 1)
        yield known.ABSOLUTE.of(Edit("q", "add", -before, (joint,)), i=i, j=j)


def _is_parallel_to_last(steps: Steps, joint: int) -> bool:
    """Whether only translations lie between two revolute joints."""
    if steps.kinds[joint - 1 : joint + 1] != "RR":
        return False
    between = range(steps.own[joint - 1] + 1, steps.own[joint])
    turns = [steps.constants[k] for k in between if steps.motions[k][0] == "R"]
    return bool(np.abs(np.array(turns)).max(initial=0.0) < SIZE)


def _angle(steps: Steps, joint: int) -> float:
    """The angle of a joint's own turn, with its offset."""
    amounts: Array = steps.constants[steps.own] + steps.q
    return float(amounts[joint])
