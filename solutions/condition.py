"""Conditions: one equation, or several that hold at once, such as sin(q2) = 0 and sin(q3) = 0."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from .expression import Expression, parse
from .tokens import ExpressionError, refusing


@dataclass(frozen=True)
class AllOf:
    """Two or more equations that hold at once: each of the expressions is zero."""

    equations: tuple[Expression, ...]

    def __post_init__(self) -> None:
        if len(self.equations) < 2:
            raise ExpressionError(
                f"equations takes two or more that hold at once, got {len(self.equations)}"
            )

    def __str__(self) -> str:
        """Text that is read back, such as "sin(q2) = 0 and sin(q3) = 0"."""
        return " and ".join(f"{expression} = 0" for expression in self.equations)


Condition = Expression | AllOf
"""What is zero where the condition holds, or several such."""


def all_of(expressions: Sequence[Expression]) -> Condition:
    """The condition that all these expressions are zero; of one it is the expression itself."""
    if len(expressions) == 1:
        return expressions[0]
    return AllOf(tuple(expressions))


def equations_of(condition: Condition) -> tuple[Expression, ...]:
    """The expressions that are zero where a condition holds."""
    if isinstance(condition, AllOf):
        return condition.equations
    return (condition,)


def read_conditions(text: object, names: Iterable[str]) -> list[Condition]:
    """The conditions of a text as `condition_text` writes them, several with "or" between them.

    The text is such as "sin(q2) = 0 and q3 = 0". The sides of an equation may be any formulas in
    `names`; without "=" it is the formula that is to be zero. What students may type is more, and
    is read by the grader. Raises ExpressionError.
    """
    known = tuple(names)
    conditions = list[Condition]()
    with refusing(text, "a condition") as typed:
        for case in re.split(r"\bor\b", typed):
            parts = re.split(r"\band\b", case)
            conditions.append(all_of([_equation(part, known) for part in parts]))
    return conditions


def _equation(text: str, names: tuple[str, ...]) -> Expression:
    """Left side minus right side."""
    left, _, right = text.partition("=")
    if right.strip() in ("", "0"):
        return parse(left, names)
    return parse(f"({left}) - ({right})", names)


def condition_text(condition: Condition) -> str:
    """The condition as a student may type it: "sin(q2) = 0", several with "and" between them."""
    if isinstance(condition, AllOf):
        return str(condition)
    return f"{condition} = 0"


def condition_sympy(condition: Condition) -> Any:
    """The condition as sympy prints it: an Eq with zero, or And of several."""
    sympy: Any = import_module("sympy")
    zeros = [expression.sympy() for expression in equations_of(condition)]
    equations = [sympy.Eq(zero, 0, evaluate=False) for zero in zeros]
    if len(equations) == 1:
        return equations[0]
    return sympy.And(*equations, evaluate=False)
