"""Tables of the same arm: frames may be placed in many ways, and one wrong cell has a name."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import pi

import numpy as np

from ...exercises.answers import TableOf, Variant
from ...exercises.kinds.table import table_rows
from ...solutions.chain import Array, Chain, ChainError, from_modified, from_standard
from ...solutions.equivalence import Equivalence, equivalence
from ...solutions.table import Table

THETA, D, A, ALPHA = range(4)
QUARTER = pi / 2
OTHER = {"standard": "modified", "modified": "standard"}


@dataclass(frozen=True)
class Repair:
    """An edit of a table's rows (n, 4), and the sentence that says what it repairs."""

    sentence: str
    rows: Array
    convention: str


def describes_same_arm(answer: TableOf, v: Variant, reference: Table, own: Table) -> bool:
    """Whether a table describes the arm of the reference, as far as the sheet gives its frames."""
    if own.kinds != answer.kinds:
        return False
    wanted = _chain(table_rows(reference, v), answer)
    return _agrees(answer, wanted, table_rows(own, v), own.convention)


def repairs(answer: TableOf, v: Variant, reference: Table, own: Table) -> list[str]:
    """Sentences of the single edits that make the arm's table of it.

    Where there is more than one, they cannot be told apart.
    """
    if own.kinds != answer.kinds:
        return list(_misplaced(answer.kinds, own.kinds))
    wanted = _chain(table_rows(reference, v), answer)
    found = dict[str, Repair]()
    for repair in _edits(table_rows(own, v), answer):
        if repair.sentence in found or any(_alike(repair, other) for other in found.values()):
            continue
        if _agrees(answer, wanted, repair.rows, repair.convention):
            found[repair.sentence] = repair
    return list(found)


def _misplaced(wanted: str, own: str) -> Iterator[str]:
    """Joint variables that stand in the other column."""
    for i, (kind, other) in enumerate(zip(wanted, own, strict=True), 1):
        if kind == other:
            continue
        way = "turns: q{} belongs in theta" if kind == "R" else "slides: q{} belongs in d"
        yield f"Row {i}: joint {i} {way.format(i)}."


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
    own = answer.convention
    yield Repair(
        f"This is the {OTHER[own]} table of the arm; the {own} one is asked.", rows, OTHER[own]
    )
    in_radians = rows.copy()
    in_radians[:, ALPHA] = np.radians(rows[:, ALPHA])
    yield Repair("The angles alpha are in degrees; radians are asked.", in_radians, own)
    if np.count_nonzero(rows[:, ALPHA]) > 1:
        reversed_twists = _edited(rows, slice(None), ALPHA, np.negative)
        yield Repair("All angles alpha have the wrong sign.", reversed_twists, own)
    for i in range(len(rows)):
        for sentence, column, change in EDITS:
            edited = _edited(rows, i, column, change)
            if not np.array_equal(edited, rows):
                yield Repair(f"Row {i + 1}: {sentence}.", edited, own)
        exchanged = rows.copy()
        exchanged[i, [D, A]] = rows[i, [A, D]]
        if rows[i, A] != rows[i, D]:
            yield Repair(f"Row {i + 1}: a and d are exchanged.", exchanged, own)
    for i in range(len(rows) - 1):
        exchanged = rows.copy()
        exchanged[[i, i + 1]] = rows[[i + 1, i]]
        yield Repair(f"Rows {i + 1} and {i + 2} are exchanged.", exchanged, own)


def _edited(rows: Array, row: int | slice, column: int, change: Callable[[Array], Array]) -> Array:
    edited = rows.copy()
    edited[row, column] = change(rows[row, column])
    return edited


EDITS: tuple[tuple[str, int, Callable[[Array], Array]], ...] = (
    ("alpha has the wrong sign", ALPHA, np.negative),
    ("alpha is a quarter turn off", ALPHA, lambda x: x + QUARTER),
    ("alpha is a quarter turn off", ALPHA, lambda x: x - QUARTER),
    ("alpha is half a turn off", ALPHA, lambda x: x + pi),
    ("alpha is in degrees; radians are asked", ALPHA, np.radians),
    ("theta is a quarter turn off", THETA, lambda x: x + QUARTER),
    ("theta is a quarter turn off", THETA, lambda x: x - QUARTER),
    ("theta is half a turn off", THETA, lambda x: x + pi),
    ("a has the wrong sign", A, np.negative),
    ("d has the wrong sign", D, np.negative),
)
"""What may be wrong in one row, and what mends it."""
