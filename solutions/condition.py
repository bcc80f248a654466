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
    return expressions[0] if len(expressions) == 1 else AllOf(tuple(expressions))


def equations_of(condition: Condition) -> tuple[Expression, ...]:
    """The expressions that are zero where a condition holds."""
    return condition.equations if isinstance(condition, AllOf) else (condition,)


def read_conditions(text: object, names: Iterable[str]) -> list[Condition]:
    """The conditions of a text as `condition_text` writes them: "sin(q2) = 0 and q3 = 0", several with "or" between.

    The sides of an equation may be any formulas in `names`; without "=" it is the formula that is to be zero. What
    students may type is more, and is read by the grader. Raises ExpressionError.
    """
    known = tuple(names)
    with refusing(text, "a condition") as typed:
        cases = re.split(r"\bor\b", typed)
        return [
            all_of([_equation(part, known) for part in re.split(r"\band\b", case)])
            for case in cases
        ]


def _equation(text: str, names: tuple[str, ...]) -> Expression:
    """Left side minus right side."""
    left, _, right = text.partition("=")
    if right.strip() in ("", "0"):
        return parse(left, names)
    return parse(f"({left}) - ({right})", names)


def condition_text(condition: Condition) -> str:
    """The condition as a student may type it: "sin(q2) = 0", or equations with "and" between them."""
    return str(condition) if isinstance(condition, AllOf) else f"{condition} = 0"


def condition_sympy(condition: Condition) -> Any:
    """The condition as sympy prints it: an Eq with zero, or And of several."""
    sympy: Any = import_module("sympy")
    equations = [
        sympy.Eq(expression.sympy(), 0, evaluate=False) for expression in equations_of(condition)
    ]
    return equations[0] if len(equations) == 1 else sympy.And(*equations, evaluate=False)
