"""Tables of the same arm: frames may be placed in many ways, and one wrong cell has a name."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import pi

import numpy as np

from ...exercises.answers import TableOf, Variant
from ...exercises.exercise import Fault
from ...exercises.kinds.table import table_rows
from ...solutions.chain import Array, Chain, ChainError, from_modified, from_standard
from ...solutions.equivalence import Equivalence, equivalence
from ...solutions.table import Table
from .marker import Named

THETA, D, A, ALPHA = range(4)
QUARTER = pi / 2
Change = Callable[[Array], Array]
OTHER = {"standard": "modified", "modified": "standard"}


@dataclass(frozen=True)
class Repair:
    """An edit of a table's rows (n, 4), and what it says of the table that it mends."""

    named: Named
    rows: Array
    convention: str


def describes_same_arm(answer: TableOf, v: Variant, reference: Table, own: Table) -> bool:
    """Whether a table describes the arm of the reference, as far as the sheet gives its frames."""
    if own.kinds != answer.kinds:
        return False
    wanted = _chain(table_rows(reference, v), answer)
    return _agrees(answer, wanted, table_rows(own, v), own.convention)


def repairs(answer: TableOf, v: Variant, reference: Table, own: Table) -> list[Named]:
    """The single edits that make the arm's table of it; several cannot be told apart."""
    if own.kinds != answer.kinds:
        return list(_misplaced(answer.kinds, own.kinds))
    wanted = _chain(table_rows(reference, v), answer)
    found = dict[Named, Repair]()
    for repair in _edits(table_rows(own, v), answer):
        if repair.named in found or any(_alike(repair, other) for other in found.values()):
            continue
        if _agrees(answer, wanted, repair.rows, repair.convention):
            found[repair.named] = repair
    return list(found)


def _misplaced(wanted: str, own: str) -> Iterator[Named]:
    """Joint variables that stand in the other column."""
    for i, (kind, other) in enumerate(zip(wanted, own, strict=True), 1):
        if kind == other:
            continue
        way = "turns: q{} belongs in theta" if kind == "R" else "slides: q{} belongs in d"
        yield Named(f"Row {i}: joint {i} {way.format(i)}.", "concept")


def _alike(one: Repair, other: Repair) -> bool:
    """Whether two edits come to the same table: a quarter turn reversed is half a turn."""
    off = np.abs(one.rows - other.rows)
    off[:, [THETA, ALPHA]] = np.abs((off[:, [THETA, ALPHA]] + pi) % (2 * pi) - pi)
    return one.convention == other.convention and bool((off < 1e-9).all())


def _chain(rows: Array, answer: TableOf, convention: str = "") -> Chain:
    build = from_modified if (convention or answer.convention) == "modified" else from_standard
    return build(rows, answer.kinds)


def _agrees(answer: TableOf, wanted: Chain, rows: Array, convention: str) -> bool:
    """Whether rows describe the wanted arm, to what the asked decimals leave open."""
    unit = 10.0**-answer.decimals
    try:
        chain = _chain(rows, answer, convention)
    except ChainError:
        return False
    found = equivalence(wanted, chain, answer.given, angle=2 * unit, length=3 * unit)
    return isinstance(found, Equivalence)


def _edits(rows: Array, answer: TableOf) -> Iterator[Repair]:
    """Whole tables read otherwise, then every row with one thing in it mended."""
    own, other = answer.convention, OTHER[answer.convention]
    modified = Named(f"This is the {other} table of the arm; the {own} one is asked.", "concept")
    yield Repair(modified, rows, other)
    for sentence, change in WHOLE:
        if np.count_nonzero(rows[:, ALPHA]) > 1:
            yield Repair(Named(sentence, "slip"), _edited(rows, slice(None), ALPHA, change), own)
    for i in range(len(rows)):
        yield from _edits_of_row(rows, i, own)
    for i in range(len(rows) - 1):
        exchanged = rows.copy()
        exchanged[[i, i + 1]] = rows[[i + 1, i]]
        yield Repair(Named(f"Rows {i + 1} and {i + 2} are exchanged.", "slip"), exchanged, own)


def _edits_of_row(rows: Array, i: int, convention: str) -> Iterator[Repair]:
    for sentence, fault, column, change in EDITS:
        edited = _edited(rows, i, column, change)
        if not np.array_equal(edited, rows):
            yield Repair(Named(f"Row {i + 1}: {sentence}.", fault), edited, convention)
    exchanged = rows.copy()
    exchanged[i, [D, A]] = rows[i, [A, D]]
    if rows[i, A] != rows[i, D]:
        yield Repair(Named(f"Row {i + 1}: a and d are exchanged.", "slip"), exchanged, convention)


def _edited(rows: Array, row: int | slice, column: int, change: Change) -> Array:
    edited = rows.copy()
    edited[row, column] = change(rows[row, column])
    return edited


WHOLE: tuple[tuple[str, Change], ...] = (
    ("The angles alpha are in degrees; radians are asked.", np.radians),
    ("All angles alpha have the wrong sign.", np.negative),
)
EDITS: tuple[tuple[str, Fault, int, Change], ...] = (
    ("alpha has the wrong sign", "slip", ALPHA, np.negative),
    ("alpha is a quarter turn off", "concept", ALPHA, lambda x: x + QUARTER),
    ("alpha is a quarter turn off", "concept", ALPHA, lambda x: x - QUARTER),
    ("alpha is half a turn off", "concept", ALPHA, lambda x: x + pi),
    ("alpha is in degrees; radians are asked", "slip", ALPHA, np.radians),
    ("theta is a quarter turn off", "concept", THETA, lambda x: x + QUARTER),
    ("theta is a quarter turn off", "concept", THETA, lambda x: x - QUARTER),
    ("theta is half a turn off", "concept", THETA, lambda x: x + pi),
    ("a has the wrong sign", "slip", A, np.negative),
    ("d has the wrong sign", "slip", D, np.negative),
)
"""What may be wrong in one row, what kind of mistake it is, and what mends it."""
