"""What mends a wrong table: the whole read otherwise, two cells exchanged, one cell changed."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise, product
from math import pi
from typing import Any

import numpy as np

from ...exercises.answers import TableOf, Variant
from ...exercises.exercise import Fault
from ...exercises.kinds.table import table_rows
from ...exercises.properties import turned
from ...solutions.chain import Array
from ...solutions.equivalence import ALL_GIVEN
from ...solutions.table import COLUMNS, Table
from .marker import Named
from .one_cell import ALPHA, THETA, A, D, poses, single_cells
from .same_arm import Drawn, between_axes, drawn_arm

QUARTER = pi / 2
ANGLES = (THETA, ALPHA)
PROBES = 3  # configurations at which tables are compared before the search says the last word
OTHER = {"standard": "modified", "modified": "standard"}
Change = Callable[[Any], Any]


@dataclass(frozen=True)
class Repair:
    """An edit of a table's rows (n, 4), and what it says of the table that it mends.

    A `vague` one says that a cell is wrong, and not how it went wrong.
    """

    named: Named
    rows: Array
    convention: str
    vague: bool = False


def repairs(answer: TableOf, v: Variant, reference: Table, own: Table) -> list[Named]:
    """The single edits that make the arm's table of it; several cannot be told apart."""
    if own.kinds != answer.kinds:
        return list(_misplaced(answer.kinds, own.kinds))
    drawn = drawn_arm(answer, v, reference)
    rows = table_rows(own, v)
    found = _mending(drawn, _edits(drawn, rows, own.convention))
    telling = [repair.named for repair in found if not repair.vague]
    return telling or [repair.named for repair in found]


def _misplaced(wanted: str, own: str) -> Iterator[Named]:
    """Joint variables that stand in the other column."""
    for i, (kind, other) in enumerate(zip(wanted, own, strict=True), 1):
        if kind == other:
            continue
        way = "turns: q{} belongs in theta" if kind == "R" else "slides: q{} belongs in d"
        yield Named(f"Row {i}: joint {i} {way.format(i)}.", "concept")


def _mending(drawn: Drawn, edits: Iterable[Repair]) -> list[Repair]:
    """Those edits that come to the drawn arm, each table once."""
    found: list[Repair] = []
    may_mend = _probed(drawn)
    for repair in edits:
        if not may_mend(repair) or any(_alike(drawn, repair, other) for other in found):
            continue
        if drawn.is_described(repair.rows, repair.convention):
            found.append(repair)
    return found


def _alike(drawn: Drawn, one: Repair, other: Repair) -> bool:
    """Whether two edits come to the same table: a quarter turn reversed is half a turn."""
    off = np.abs(one.rows - other.rows)
    off[:, ANGLES] = np.abs(turned(off[:, ANGLES]))
    return one.convention == other.convention and bool((off <= drawn.angle).all())


def _probed(drawn: Drawn) -> Callable[[Repair], bool]:
    """A quick test that every right table passes: most edits need no search."""
    kinds = drawn.answer.kinds
    if drawn.answer.given == ALL_GIVEN:
        q, slack = _probes(drawn), _slack(drawn)
        wanted = poses(drawn.rows, kinds, drawn.convention, q)

        def poses_agree(repair: Repair) -> bool:
            own = poses(repair.rows, kinds, repair.convention, q)
            return bool(np.abs(own - wanted).max() <= slack)

        return poses_agree

    placed = np.array([a + b == "RR" for a, b in pairwise(kinds)])
    apart = between_axes(drawn.rows, drawn.convention)

    def axes_agree(repair: Repair) -> bool:
        off = np.abs(between_axes(repair.rows, repair.convention) - apart)
        twisted, moved = off[:, 0] > drawn.angle, off[:, 1] > drawn.length
        return not (twisted | (moved & placed)).any()

    return axes_agree


def _probes(drawn: Drawn) -> Array:
    return np.random.default_rng(0).uniform(-2, 2, (PROBES, drawn.chain.n))


def _slack(drawn: Drawn) -> float:
    """How far poses of rounded tables may be off, as the search has it."""
    reach = 1 + float(np.abs(drawn.chain.fixed[:, :3, 3]).sum())
    return drawn.length + 2 * drawn.chain.n * drawn.angle * reach


def _edits(drawn: Drawn, rows: Array, own: str) -> Iterator[Repair]:
    """Whole tables read otherwise, rows exchanged, then every cell with another number."""
    yield Repair(_other_convention(drawn.answer, own), rows, OTHER[own])
    for sentence, columns, change in WHOLE:
        if np.count_nonzero(rows[:, columns]) > 1:
            edited = rows.copy()
            edited[:, columns] = change(rows[:, columns])
            yield Repair(Named(sentence, "slip"), edited, own)
    yield from _exchanged(rows, own)
    for i, column, value in _cells(drawn, rows, own):
        said, fault = _went_wrong(column, float(rows[i, column]), value)
        edited = rows.copy()
        edited[i, column] = value
        sentence = f"Row {i + 1}: {COLUMNS[column]} {said or VAGUE[column]}."
        yield Repair(Named(sentence, fault), edited, own, vague=not said)


def _other_convention(answer: TableOf, own: str) -> Named:
    """A table read in the other convention; where either will do, it is declared wrongly."""
    this = f"This is the {OTHER[own]} table of the arm"
    if answer.convention == "either":
        return Named(f"{this}; beside it, you say that it is a {own} one.", "presentation")
    return Named(f"{this}; the {answer.convention} one is asked.", "concept")


def _exchanged(rows: Array, own: str) -> Iterator[Repair]:
    """Two cells of a row, or two rows, in each other's place."""
    for i, row in enumerate(rows):
        if row[A] != row[D]:
            edited = rows.copy()
            edited[i, [D, A]] = row[[A, D]]
            yield Repair(Named(f"Row {i + 1}: a and d are exchanged.", "slip"), edited, own)
    for i in range(len(rows) - 1):
        edited = rows.copy()
        edited[[i, i + 1]] = rows[[i + 1, i]]
        yield Repair(Named(f"Rows {i + 1} and {i + 2} are exchanged.", "slip"), edited, own)


def _cells(drawn: Drawn, rows: Array, own: str) -> Iterator[tuple[int, int, float]]:
    """Row, column and another number of cells that may be wrong."""
    if replace(drawn.answer.given, senses=True) != ALL_GIVEN:
        yield from _likely_cells(drawn, rows)
        return
    kinds, q = drawn.answer.kinds, _probes(drawn)
    senses = (1.0, 1.0 if drawn.answer.given.senses else -1.0)
    for signs in dict.fromkeys(product(senses, repeat=len(kinds))):
        wanted = poses(drawn.rows, kinds, drawn.convention, q * signs)
        yield from single_cells(rows, kinds, own, q, wanted, _slack(drawn))


def _likely_cells(drawn: Drawn, rows: Array) -> Iterator[tuple[int, int, float]]:
    """What may have been meant, where a table need not lead to the same poses.

    Those are the ways in which numbers go wrong, and the numbers of the reference's row.
    """
    for i, row in enumerate(rows):
        for column, value in enumerate(row):
            meant = [change(value) for change in WAYS[column]]
            reference = drawn.rows[i, column]
            meant += [reference, -reference]
            if column == ALPHA:
                meant += [pi + reference, pi - reference]
            for other in meant:
                if other != value:
                    yield i, column, float(other)


def _went_wrong(column: int, own: float, needed: float) -> tuple[str, Fault]:
    """How a cell went wrong, in a few words, and what kind of mistake that is."""
    if column not in ANGLES:
        for words, fault, change in LENGTH_WAYS:
            if abs(change(own) - needed) <= CLOSE:
                return words, fault
        return ("is missing", "concept") if own == 0 else ("", "slip")
    if column == THETA and own == 0:
        return "lacks an offset", "concept"
    for words, fault, change in ANGLE_WAYS:
        if abs(turned(change(own) - needed)) <= CLOSE:
            return words, fault
    return "", "concept"


CLOSE = 0.01  # [rad, m]; rounded cells around it spoil the number that a cell needs
VAGUE = ("is another angle", "is another length", "is another length", "is another angle")
WHOLE: tuple[tuple[str, list[int], Change], ...] = (
    ("The angles alpha are in degrees; radians are asked.", [ALPHA], np.radians),
    ("The angles are in degrees; radians are asked.", [THETA, ALPHA], np.radians),
    ("All angles alpha have the wrong sign.", [ALPHA], np.negative),
)
ANGLE_WAYS: tuple[tuple[str, Fault, Change], ...] = (
    ("has the wrong sign", "slip", np.negative),
    ("is a quarter turn off", "concept", lambda x: x + QUARTER),
    ("is a quarter turn off", "concept", lambda x: x - QUARTER),
    ("is half a turn off", "concept", lambda x: x + pi),
    ("is in degrees; radians are asked", "slip", np.radians),
)
LENGTH_WAYS: tuple[tuple[str, Fault, Change], ...] = (
    ("has the wrong sign", "slip", np.negative),
    ("is in millimetres; metres are asked", "slip", partial(np.multiply, 1e-3)),
)
WAYS: tuple[list[Change], ...] = tuple(
    [way for _, _, way in (ANGLE_WAYS if column in ANGLES else LENGTH_WAYS)]
    for column in range(len(COLUMNS))
)
"""What may be meant by the number in each column."""
