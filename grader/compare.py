"""Right or wrong, entry by entry, and what that earns."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..exercises.answers import (
    Choice,
    Conditions,
    Configurations,
    Formulas,
    Function,
    Numbers,
    TableOf,
    Variant,
)
from ..exercises.exercise import Credit, Part
from ..exercises.properties import turned
from ..exercises.results import Results
from ..exercises.values import names_on_sheet, table_numbers
from ..solutions.expression_array import ExpressionArray, same_formulas
from ..solutions.table import Table
from .answer_key import AnswerKey, Mask, Wanted
from .calls import agreeing, groups_of, said_of_groups
from .calls import share as share_of_groups
from .conditions import judge_conditions

ANGLES = (0, 3)  # columns theta and alpha of a table
BLOCK = 3  # rows of J: linear, angular


@dataclass(frozen=True)
class Comparison:
    """Which entries are right, of the shape in which the answer is shown, the share of the points, what was seen.

    `reading` is how the question was read, where the part's own check tells.
    """

    right: Any
    share: float
    findings: tuple[str, ...] = ()
    reading: str = ""

    @property
    def all_right(self) -> bool:
        """Whether nothing is wrong or missing."""
        return self.share == 1.0


def compare(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Comparison:
    """A readable answer beside what is wanted."""
    return _COMPARISONS[type(part.answer)](key, part, wanted, value)


def shared(key: AnswerKey, part: Part, right: Mask) -> float:
    """Share of the points that these right entries earn."""
    earning = np.broadcast_to(key.earning(part), right.shape)
    if isinstance(part.answer, TableOf):  # a wrong constant voids its joint's row
        return fraction(right.T, earning.T, part.credit)
    return fraction(right, earning, part.credit)


def _numbers(key: AnswerKey, part: Part, wanted: Wanted, value: NDArray[np.float64]) -> Comparison:
    right: Mask = np.less_equal(np.abs(value - wanted.value), wanted.allowed, dtype=bool)
    return Comparison(right, shared(key, part, right))


def _table(key: AnswerKey, part: Part, wanted: Wanted, value: Table) -> Comparison:
    assert isinstance(part.answer, TableOf)  # noqa: S101 - chosen by this type
    right = _right_cells(part.answer, key.v, wanted.value, value)
    return Comparison(right, shared(key, part, right))


def _right_cells(answer: TableOf, v: Variant, reference: Table, value: Table) -> Mask:
    """Cells that have the reference's value at three configurations; angles count modulo a full turn."""
    half = 0.5 * 10.0**-answer.decimals
    allowed = np.array([4 * half, 6 * half, 6 * half, 4 * half])
    q = np.random.default_rng(0).uniform(-1, 1, (3, len(answer.kinds)))
    difference = table_numbers(value, v, q) - table_numbers(reference, v, q)
    difference[..., ANGLES] = turned(difference[..., ANGLES])
    return np.less_equal(np.abs(difference).max(axis=0), allowed, dtype=bool)


def _formulas(key: AnswerKey, part: Part, wanted: Wanted, value: ExpressionArray) -> Comparison:
    assert isinstance(part.answer, Formulas)  # noqa: S101 - chosen by this type
    right = same_formulas(value, wanted.value, names_on_sheet(part.answer.names, key.v))
    return Comparison(right, shared(key, part, right))


def _choice(_: AnswerKey, __: Part, wanted: Wanted, value: str) -> Comparison:
    return Comparison(np.array(value == wanted.value), float(value == wanted.value))


def _conditions(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Comparison:
    assert isinstance(part.answer, Conditions)  # noqa: S101 - chosen by this type
    judged = judge_conditions(wanted.value, value, part.answer.domain(key.v), key.v)
    return Comparison(np.array(judged.holds), judged.share, judged.findings)


def _configurations(_: AnswerKey, part: Part, wanted: Wanted, value: NDArray[np.float64]) -> Comparison:
    """Row by row, which is what a known mistake is told by; the part's own check judges what is handed in."""
    assert isinstance(part.answer, Configurations)  # noqa: S101 - chosen by this type
    if value.shape != wanted.value.shape:
        return Comparison(np.zeros(value.shape, dtype=bool), 0.0)
    right: Mask = np.less_equal(np.abs(value - wanted.value), 1.001 * 10.0**-part.answer.decimals, dtype=bool)
    return Comparison(right, float(right.all()))


def _function(key: AnswerKey, part: Part, wanted: Wanted, value: Results) -> Comparison:
    """Call by call; a group counts when all of its calls are right."""
    assert isinstance(part.answer, Function)  # noqa: S101 - chosen by this type
    groups = groups_of(part.answer, key.v, wanted.value, value)
    right = agreeing(groups, part.answer.tolerance)
    findings = said_of_groups(groups, right, part.answer.tolerance)
    return Comparison(right, share_of_groups(groups, right), tuple(findings))


_COMPARISONS: dict[type, Callable[[AnswerKey, Part, Wanted, Any], Comparison]] = {
    Numbers: _numbers,
    TableOf: _table,
    Formulas: _formulas,
    Choice: _choice,
    Conditions: _conditions,
    Configurations: _configurations,
    Function: _function,
}


def fraction(right: Mask, earning: Mask, credit: Credit) -> float:
    """Share of the points in [0, 1]; a wrong entry that earns nothing voids its column.

    A column without any earning entry costs its share of the columns when it is wrong.
    """
    if right.all():
        return 1.0
    if credit == "all" or right.ndim == 0:
        return 0.0
    columns = right.reshape(-1, 1) if right.ndim == 1 else right
    weights = earning.reshape(columns.shape)
    sound = (columns | weights).all(axis=-2, keepdims=True)
    earned = int((columns & weights & sound & _whole(columns, credit)).sum())
    barren = ~weights.any(axis=-2, keepdims=True) & ~sound
    return max(0.0, earned / int(weights.sum()) - float(np.mean(barren)))


def _whole(columns: Mask, credit: Credit) -> Mask:
    """Where credit is for columns or blocks, entries whose whole column or block is right; else all."""
    if credit == "column":
        return np.broadcast_to(columns.all(axis=-2, keepdims=True), columns.shape)
    whole = np.ones_like(columns)
    if credit == "block":
        for start in range(0, columns.shape[-2], BLOCK):
            rows = (..., slice(start, start + BLOCK), slice(None))
            whole[rows] = columns[rows].all()
    return whole
