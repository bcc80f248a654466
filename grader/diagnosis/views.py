"""What a part asks for, as a view of the pipeline: found by its reference value, not declared.

A view is recognised where the part's reference equals it. So an exercise says nothing of it, and a
part that rounds, measures or combines otherwise is left alone.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np

from .pipeline import Solved
from .steps import Array
from .switches import ORIGIN, TOOL_AXES

EQUAL = 1e-9  # of the size of an answer
Setting = tuple[int, int]
"""The axes and the point that a Jacobian is asked for, as codes of `Switches`."""
SETTINGS: tuple[Setting, ...] = ((0, 0), (TOOL_AXES, 0), (0, ORIGIN), (TOOL_AXES, ORIGIN))
Quantity = Callable[[Solved], Array]
"""A quantity (H, ...) of H hypotheses."""
ANGULAR_FIRST = (3, 4, 5, 0, 1, 2)
SINGULAR = 1e-9  # relative to the largest singular value


@dataclass(frozen=True, eq=False)
class View:
    """A part's answer, of every hypothesis.

    Attributes:
        setting: What is asked for.
        of: The answer (H, *shape) of hypotheses.
        is_affine: Whether it is affine in every length, and in cosine and sine of every angle.
    """

    setting: Setting
    of: Quantity
    is_affine: bool = True


def find_view(
    truth: Callable[[Setting], Sequence[Solved]],
    references: Sequence[Array],
    numbers: Mapping[str, Array],
) -> View | None:
    """The first view that the references are; None where there is none.

    `truth(setting)` are the right hypothesis alone, at as many places as there are references;
    `numbers` are printed vectors, such as joint rates, that a J may be multiplied with.
    """
    allowed = [EQUAL * max(1.0, np.abs(reference).max()) for reference in references]
    for view in _views(references[0].shape, truth((0, 0))[0].steps.n, numbers):
        if _agrees(view, truth(view.setting), references, allowed):
            return view
    return None


def _agrees(
    view: View, truth: Sequence[Solved], references: Sequence[Array], allowed: Sequence[float]
) -> bool:
    for solved, reference, most in zip(truth, references, allowed, strict=True):
        try:
            value = view.of(solved)[0]
        except (ValueError, IndexError, np.linalg.LinAlgError):
            return False
        if value.shape != reference.shape:
            return False
        if not (np.abs(value - reference) <= most).all():
            return False
    return True


def _views(shape: tuple[int, ...], n: int, numbers: Mapping[str, Array]) -> Iterator[View]:
    """All views of a shape, plain ones first."""
    for of in _of_frames(shape, n):
        yield View((0, 0), of)
    for setting in SETTINGS:
        for of in _of_jacobian(shape, n):
            yield View(setting, of)
        for of in _of_motion(shape, n, numbers):
            yield View(setting, of)
        for of in _of_inverse(shape, n, numbers):
            yield View(setting, of, is_affine=False)


def _of_frames(shape: tuple[int, ...], n: int) -> Iterator[Quantity]:
    """Frames, rotations, points and axes, one or several that follow each other."""
    if len(shape) == 3:
        for some in _runs(shape[0], n + 2):
            yield lambda solved, some=some: solved.frames[:, some]
            yield lambda solved, some=some: solved.frames[:, some, :3, :3]
    if shape in ((4, 4), (3, 3), (3,)):
        yield from _of_one_frame(shape, n)
    if len(shape) == 2:
        for some in _runs(shape[1], n + 2):
            yield lambda solved, some=some: solved.axes[:, some].swapaxes(1, 2)
            yield lambda solved, some=some: solved.points[:, some].swapaxes(1, 2)


def _of_one_frame(shape: tuple[int, ...], n: int) -> Iterator[Quantity]:
    """The frame, its rotation or its point; the tool's first."""
    parts: dict[tuple[int, ...], tuple[slice, slice | int]] = {
        (4, 4): (slice(None), slice(None)),
        (3, 3): (slice(3), slice(3)),
        (3,): (slice(3), 3),
    }
    rows, columns = parts[shape]
    for place in (-1, *range(n + 2)):
        yield lambda solved, place=place: solved.frames[:, place, rows, columns]
    if shape == (3,):
        for joint in range(n):
            yield lambda solved, joint=joint: solved.axes[:, joint]


def _runs(count: int, size: int) -> Iterator[slice]:
    """All runs of so many of `size`, the later first: sources leave out frame 0."""
    for start in reversed(range(size - count + 1)):
        yield slice(start, start + count)


def _rows(count: int) -> Iterator[list[int]]:
    """Choices of so many rows of a Jacobian, those with the linear rows first."""
    for rows in combinations(range(6), count):
        yield [*rows]
    if count == 6:
        yield [*ANGULAR_FIRST]


def _of_jacobian(shape: tuple[int, ...], n: int) -> Iterator[Quantity]:
    """Rows and columns of a Jacobian."""
    if len(shape) == 2 and shape[0] <= 6:
        for rows, some in product(_rows(shape[0]), _runs(shape[1], n)):
            yield lambda solved, rows=rows, some=some: solved.J[:, rows, some]
    if len(shape) == 1 and 1 < shape[0] <= 6:
        for rows, column in product(_rows(shape[0]), range(n)):
            yield lambda solved, rows=rows, column=column: solved.J[:, rows, column]
    if shape == (n,):
        for row in range(6):
            yield lambda solved, row=row: solved.J[:, row]


def _of_motion(shape: tuple[int, ...], n: int, numbers: Mapping[str, Array]) -> Iterator[Quantity]:
    """Velocities of printed joint rates, and joint torques of printed forces."""
    if len(shape) != 1:
        return
    for number in numbers.values():
        if number.shape == (n,) and shape[0] <= 6:
            for rows in _rows(shape[0]):
                yield lambda solved, rows=rows, number=number: solved.J[:, rows] @ number
        if shape == (n,) and len(number) in (3, 6):
            for rows in _blocks(len(number)):
                yield lambda solved, rows=rows, number=number: number @ solved.J[:, rows]


def _blocks(count: int) -> Iterator[list[int]]:
    """Whole blocks of rows."""
    if count == 6:
        yield [*range(6)]
        yield [*ANGULAR_FIRST]
    else:
        yield [0, 1, 2]
        yield [3, 4, 5]


def _of_inverse(shape: tuple[int, ...], n: int, numbers: Mapping[str, Array]) -> Iterator[Quantity]:
    """Determinants, pseudoinverses, and joint rates."""
    if not shape and n <= 6:
        for rows in _rows(n):
            yield lambda solved, rows=rows: np.linalg.det(solved.J[:, rows])
    if len(shape) == 2 and shape[0] == n and shape[1] <= 6:
        for rows in _rows(shape[1]):
            yield lambda solved, rows=rows: _pinv(solved.J[:, rows])
    if shape == (n,):
        yield from _of_rates(numbers)


def _of_rates(numbers: Mapping[str, Array]) -> Iterator[Quantity]:
    """Joint rates for printed velocities, unique or of least norm."""
    for number in numbers.values():
        if number.ndim == 1 and len(number) <= 6:
            for rows in _rows(len(number)):
                yield lambda solved, rows=rows, number=number: _pinv(solved.J[:, rows]) @ number


def _pinv(J: Array) -> Array:
    """Pseudoinverses of those that are finite."""
    is_finite = np.logical_and.reduce(np.isfinite(J), axis=(1, 2))
    inverse = np.linalg.pinv(np.where(is_finite[:, None, None], J, 0.0), rcond=SINGULAR)
    inverse[~is_finite] = np.nan
    return inverse
