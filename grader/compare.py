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
from ..exercises.values import names_on_sheet, table_numbers
from ..solutions.expression_array import ExpressionArray, same_formulas
from ..solutions.table import Table
from .answer_key import AnswerKey, Mask, Wanted
from .conditions import judge_conditions
from .read import Results

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


def _configurations(_: AnswerKey, __: Part, ___: Wanted, value: NDArray[np.float64]) -> Comparison:
    return Comparison(np.zeros(value.shape, dtype=bool), 0.0)  # the part's own check decides


def _function(key: AnswerKey, part: Part, wanted: Wanted, value: Results) -> Comparison:
    """Call by call; a group counts when all of its calls are right."""
    answer = part.answer
    assert isinstance(answer, Function)  # noqa: S101 - chosen by this type
    inputs = answer.published if value.published and answer.published else answer.inputs
    results, right, findings = iter(value.values), list[list[bool]](), list[str]()
    for group, calls in inputs(key.v).items():
        pairs = [(np.asarray(wanted.value(*call), dtype=float), next(results, "no result")) for call in calls]
        said = [_result_remark(wanted_result, result, answer.tolerance) for wanted_result, result in pairs]
        right.append([not remark for remark in said])
        wrong = [remark for remark in said if remark]
        found = f"{len(said) - len(wrong)} of {len(said)} right"
        findings.append(f"{group}: {found}{f'; the first that is not {wrong[0]}' if wrong else ''}.")
    return Comparison(right, float(np.mean([all(group) for group in right])), tuple(findings))


def _result_remark(wanted: NDArray[np.float64], result: NDArray[np.float64] | str, tolerance: float) -> str:
    """What is wrong with one result; empty when nothing is."""
    if isinstance(result, str):
        return f"gave: {result}"
    if result.shape != wanted.shape:
        return f"has shape {result.shape}, {wanted.shape} is asked"
    off = np.abs(result - wanted) > tolerance * np.maximum(1.0, np.abs(wanted))
    return f"differs in {off.sum()} of {off.size} entries" if off.any() else ""


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
