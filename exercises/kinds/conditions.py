"""Conditions on the joints, all of which are asked."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...solutions.condition import (
    AllOf,
    Condition,
    all_of,
    condition_text,
    equations_of,
    read_conditions,
)
from ...solutions.expression import Expression
from ...solutions.expression_array import sample
from ...solutions.table import JOINT
from .formulas import PICTURES, names_on_sheet
from .kind import Kind, ValueKindError, Variant, listed_rows
from .paper import Paper


@dataclass(frozen=True)
class Conditions(Kind):
    """Equations in `names`, such as sin(q2) = 0, all solutions of which are asked.

    `domain(v)` gives the range of every joint within which solutions count. Its value is a tuple of
    `Condition`s: an `Expression` that is zero where it holds, or `AllOf` several that hold at once.
    `solve` may return their texts, such as "sin(q2)" or "sin(q2) = 0 and sin(q3) = 0", and tuples
    of texts or Expressions that hold at once.
    """

    names: tuple[str, ...]
    domain: Callable[[Variant], Mapping[str, tuple[float, float]]]

    @property
    def form(self) -> str:
        """With an example."""
        return "a list of conditions, such as ['sin(q1) = 0']"

    @property
    def self_check(self) -> tuple[str, Any]:
        """Whatever their number."""
        return "conditions", None

    @property
    def asked_beside(self) -> str:
        """What a wrong one costs."""
        return "A wrong one costs a right one."

    @property
    def paper(self) -> Paper:
        """A line for every condition, and some to spare."""
        return Paper(lines=6)

    def declared(self, value: Any, v: Variant) -> tuple[Condition, ...]:
        """A tuple of conditions."""
        names = names_on_sheet(self.names, v)
        entries: Sequence[Any] = value
        if isinstance(value, str | Expression | AllOf):
            entries = [value]

        found: list[Condition] = []
        for entry in entries:
            found.extend(_conditions(entry, names))
        return tuple(found)

    def pictured(self, value: Sequence[Condition], v: Variant) -> NDArray[np.float64]:
        """A row (3,) for every equation; above those that hold at once, a row with their number."""
        joints = [name for name in self.names if JOINT.fullmatch(name)]
        values: dict[str, Any] = {**v, **sample(joints, PICTURES)}

        rows = list[Any]()
        for condition in value:
            equations = equations_of(condition)
            if len(equations) > 1:
                rows.append(np.full(PICTURES, len(equations)))
            for equation in equations:
                rows.append(np.broadcast_to(equation.at(values), PICTURES))
        return np.array(rows, dtype=float)

    def code(self, variable: str, value: Sequence[Condition]) -> str:
        """A list of text."""
        texts = [condition_text(condition) for condition in value]
        return f"{variable} = {listed_rows(texts)}"

    def matlab(self, stacked: str) -> tuple[str, str]:
        """A cell array of text."""
        return "{''}", "equations, such as {'sin(q1) = 0', 'q2 = q3'}"


def _conditions(entry: Any, names: tuple[str, ...]) -> Sequence[Condition]:
    """The conditions of one entry of what `solve` returns.

    It is a condition, the text of one or several, or a tuple of what holds at once.
    """
    if isinstance(entry, Expression | AllOf):
        return [entry]
    if isinstance(entry, list | tuple):
        at_once = cast("Sequence[Any]", entry)
        return [all_of([_equation(one, names) for one in at_once])]
    return read_conditions(entry, names)


def _equation(entry: Any, names: tuple[str, ...]) -> Expression:
    """One of the equations that hold at once."""
    found: list[Expression] = []
    for condition in _conditions(entry, names):
        found.extend(equations_of(condition))
    if len(found) != 1:
        raise ValueKindError(
            "takes one equation in each place of a tuple that holds at once, got "
            f"{str(entry)[:60]!r}"
        )
    return found[0]
