"""Values of answers: brought to the declared kind, and pictured as plain numbers for records and comparisons."""

from collections.abc import Callable, Iterable, Sequence
from functools import wraps
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ..solutions.condition import AllOf, Condition, all_of, equations_of
from ..solutions.errors import KinegradeError
from ..solutions.expression import Expression
from ..solutions.expression_array import ExpressionArray, expression_array, sample
from ..solutions.table import JOINT, Table
from ..solutions.typed_equations import typed_equations
from .answers import (
    Answer,
    Choice,
    Conditions,
    Configurations,
    Formulas,
    Function,
    Manual,
    Numbers,
    TableOf,
    Variant,
)
from .arguments import arrived

PICTURES = 3  # points at which formulas are recorded


class ValueKindError(KinegradeError):
    """A value is not of the declared kind."""


def declared(answer: Answer, value: Any, v: Variant) -> Any:
    """The value as its kind: an array, `Table`, `ExpressionArray`, letter, tuple of conditions, function, text.

    Raises:
        ValueKindError: it is none; the sentence says what it takes.
        ExpressionError: a formula is in other names.
    """
    return _DECLARED[type(answer)](answer, value, v)


def names_on_sheet(names: Iterable[str], v: Variant) -> tuple[str, ...]:
    """Names that a student may use: joints, and parameters that this variant has."""
    return tuple(name for name in names if JOINT.fullmatch(name) or name in v)


def pictured(answer: Answer, value: Any, v: Variant) -> NDArray[np.float64] | None:
    """Numbers that a declared value comes to, None for what is marked by hand.

    Tables become their cells at the variant's q (at fixed joint values where none is drawn), formulas their values at
    three fixed points (3, ...), choices the place of the letter, functions their results for the first call of each
    group.
    """
    return _PICTURED[type(answer)](answer, value, v)


def table_numbers(table: Table, v: Variant, q: Any) -> NDArray[np.float64]:
    """Cells (..., n, 4) of a table with the variant's lengths at q (..., n)."""
    joints = np.asarray(q, dtype=float)
    lengths = {name: x for name, x in v.items() if isinstance(x, int | float)}
    return table.numbers({**lengths, **{name: joints[..., i] for i, name in enumerate(table.joints)}})


def posture(joints: Sequence[str], v: Variant) -> NDArray[np.float64]:
    """The variant's q (n,); where none is drawn, values that are the same for everybody."""
    if "q" in v:
        return np.asarray(v["q"], dtype=float)
    values = sample(joints, 1)
    return np.array([values[joint][0] for joint in joints])


def _numbers(answer: Numbers, value: Any, _: Variant) -> NDArray[np.float64]:
    return _finite(value, answer.shape)


def _finite(value: Any, shape: tuple[int, ...]) -> NDArray[np.float64]:
    array = np.asarray(value, dtype=float)
    if array.shape != shape or not np.isfinite(array).all():
        with_nan = " with NaN or infinity" if array.shape == shape else ""
        raise ValueKindError(f"takes finite numbers of shape {shape}, got shape {array.shape}{with_nan}")
    return array


def _table(_: TableOf, value: Any, __: Variant) -> Table:
    if not isinstance(value, Table):
        raise ValueKindError(f"takes a Table, got {type(value).__name__}")
    return value


def _formulas(answer: Formulas, value: Any, v: Variant) -> Any:
    array = expression_array(value, names_on_sheet(answer.names, v))
    if array.shape != answer.shape:
        raise ValueKindError(f"takes formulas of shape {answer.shape}, got shape {array.shape}")
    return array


def _choice(answer: Choice, value: Any, _: Variant) -> str:
    if value not in [*answer.letters]:
        raise ValueKindError(f"takes one of the letters {', '.join(answer.letters)}, got {value!r}")
    return value


def _conditions(answer: Conditions, value: Any, v: Variant) -> tuple[Condition, ...]:
    names = names_on_sheet(answer.names, v)
    return tuple(condition for entry in _listed(value) for condition in _alternatives(entry, names))


def _listed(value: Any) -> Sequence[Any]:
    """The entries of a list, and of what stands by itself the one that it is."""
    return [value] if isinstance(value, str | Expression | AllOf) else value


def _alternatives(entry: Any, names: tuple[str, ...]) -> Sequence[Condition]:
    """The conditions of one entry: several where its text lists them, one where it lists what holds at once."""
    if isinstance(entry, Expression | AllOf):
        return [entry]
    if isinstance(entry, list | tuple):
        return [all_of([_equation(equation, names) for equation in cast("Sequence[Any]", entry)])]
    return typed_equations(entry, names)


def _equation(entry: Any, names: tuple[str, ...]) -> Expression:
    """One of the equations that hold at once."""
    found = [equation for condition in _alternatives(entry, names) for equation in equations_of(condition)]
    if len(found) != 1:
        raise ValueKindError(f"takes one equation in each place of a tuple that holds at once, got {str(entry)[:60]!r}")
    return found[0]


def _configurations(answer: Configurations, value: Any, _: Variant) -> NDArray[np.float64]:
    rows = np.asarray(value, dtype=float).reshape(-1, answer.joints)
    if not 1 <= len(rows) <= answer.most:
        raise ValueKindError(f"takes 1 to {answer.most} configurations, got {len(rows)}")
    return _finite(rows, rows.shape)


def _function(_: Function, value: Any, __: Variant) -> Callable[..., Any]:
    if not callable(value):
        raise ValueKindError(f"takes a function, got {type(value).__name__}")

    @wraps(value)
    def called(*call: Any) -> Any:
        return value(*map(arrived, call))  # as a student's function gets them

    return called


def _manual(_: Manual, value: Any, __: Variant) -> str:
    if not isinstance(value, str):
        raise ValueKindError(f"takes text, the marker's key, got {type(value).__name__}")
    return value


_DECLARED: dict[type, Callable[[Any, Any, Variant], Any]] = {
    Numbers: _numbers,
    TableOf: _table,
    Formulas: _formulas,
    Choice: _choice,
    Conditions: _conditions,
    Configurations: _configurations,
    Function: _function,
    Manual: _manual,
}


def _as_it_is(_: Answer, value: NDArray[np.float64], __: Variant) -> NDArray[np.float64]:
    return value


def _cells(_: TableOf, value: Table, v: Variant) -> NDArray[np.float64]:
    return table_numbers(value, v, posture(value.joints, v))


def _nothing(*_: Any) -> None:
    """Nothing can be computed from what is marked by hand."""


def _at_points(answer: Conditions, value: Iterable[Condition], v: Variant) -> NDArray[np.float64]:
    """A row for every equation; before those that hold at once, a row that says how many."""
    values: dict[str, Any] = {**v, **sample([name for name in answer.names if JOINT.fullmatch(name)], PICTURES)}
    rows = list[Any]()
    for condition in value:
        equations = equations_of(condition)
        rows += [float(len(equations))] if len(equations) > 1 else []
        rows += [expression.at(values) for expression in equations]
    return np.array([np.broadcast_to(row, PICTURES) for row in rows], dtype=float)


def _formula_numbers(answer: Formulas, value: ExpressionArray, v: Variant) -> NDArray[np.float64]:
    numbers = value.at(sample(names_on_sheet(answer.names, v), PICTURES))
    return np.broadcast_to(numbers, (PICTURES, *answer.shape))


def _letter_place(answer: Choice, value: str, _: Variant) -> NDArray[np.float64]:
    return np.array(float(answer.letters.index(value)))


def _results(answer: Function, value: Any, v: Variant) -> NDArray[np.float64]:
    """Results for the first call of every group, one after the other."""
    calls = [group[0] for group in answer.inputs(v).values()]
    return np.concatenate([np.asarray(value(*call), dtype=float).ravel() for call in calls])


_PICTURED: dict[type, Callable[[Any, Any, Variant], NDArray[np.float64] | None]] = {
    Numbers: _as_it_is,
    TableOf: _cells,
    Formulas: _formula_numbers,
    Choice: _letter_place,
    Conditions: _at_points,
    Configurations: _as_it_is,
    Function: _results,
    Manual: _nothing,
}
