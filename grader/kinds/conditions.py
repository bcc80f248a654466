"""Conditions on the joints."""

from collections.abc import Sequence
from typing import Any, cast

import numpy as np

from ...exercises.answers import Conditions, Variant
from ...exercises.kinds.formulas import names_on_sheet
from ...solutions.condition import Condition, all_of, condition_text, equations_of
from ...solutions.expression import Expression, ExpressionError
from ..collecting.wire import Raw
from ..reading.arrays import flat_texts
from ..reading.rounded import with_exact_angles
from ..reading.typed_equations import typed_equations
from ..reading.unreadable import Unreadable, misread
from .domain import Domain, is_turn
from .marker import Comparison, Marker, Wanted, not_at_all
from .work import TooMuchWork, budget
from .zero_sets import judge_conditions

WHOLE = 1e-9  # degrees
MOST_CONDITIONS = 32
MOST_EQUATIONS = 64  # in all conditions
MOST_NODES = 6000  # numbers, names and signs in all conditions
MOST_WORK = 4e8  # numbers computed while conditions are judged, within two seconds or so
TOO_LONG = (
    "cannot be read in reasonable time: write few short conditions, each as a factor that is zero"
)


def read_conditions(answer: Conditions, raw: Raw, v: Variant) -> tuple[Condition, ...]:
    """Expressions that are zero where a condition holds, or several that are zero at once.

    Raises:
        Unreadable: they are no text, cannot be read, or are too many.
    """
    names = names_on_sheet(answer.names, v)
    if raw.kind != "text":
        empty = raw.kind == "num" and not raw.value.size
        got = "nothing" if empty else "numbers"
        raise Unreadable(
            f"takes a list of conditions in {', '.join(names)}, such as ['sin(q1) = 0'], got {got}"
        )
    texts, _ = flat_texts(raw.value)  # a file has them in a row or a column
    angles, given = _angles(answer.domain(v)), _given(v)
    found: list[Condition] = []
    for text in texts:
        for condition in _typed(text, names):
            equations = equations_of(condition)
            exact = [with_exact_angles(equation, angles, given) for equation in equations]
            found.append(all_of(exact))
        if len(found) > MOST_CONDITIONS:
            raise Unreadable(
                f"takes 1 to {MOST_CONDITIONS} conditions, got more than {MOST_CONDITIONS}"
            )

    if not found:
        raise Unreadable(f"takes 1 to {MOST_CONDITIONS} conditions, got 0")
    _refuse_too_many(found)
    return tuple(found)


def _refuse_too_many(conditions: Sequence[Condition]) -> None:
    equations: list[Expression] = []
    for condition in conditions:
        equations += equations_of(condition)
    if len(equations) > MOST_EQUATIONS:
        raise Unreadable(
            f"takes up to {MOST_EQUATIONS} equations in all conditions, got {len(equations)}"
        )
    nodes = sum(len(equation.nodes) for equation in equations)
    if nodes > MOST_NODES:
        raise Unreadable(
            f"takes up to {MOST_NODES} numbers, names and signs in all conditions, got {nodes}"
        )


def _angles(domain: Domain) -> set[str]:
    """Joints that turn, as far as their ranges tell: full turns, or whole numbers of degrees."""
    found = set[str]()
    for joint, limits in domain.items():
        degrees = np.degrees(limits)
        if is_turn(limits) or np.abs(degrees - np.round(degrees)).max() < WHOLE:
            found.add(joint)
    return found


def _given(v: Variant) -> list[float]:
    """The numbers on the sheet, which are meant as they stand."""
    found: list[float] = []
    waiting: list[Any] = [*v.values()]
    while waiting:
        value = waiting.pop()
        if isinstance(value, int | float):
            found.append(abs(float(value)))
        elif isinstance(value, list | tuple):
            waiting += cast("list[Any]", value)
    return found


def _typed(text: str, names: Sequence[str]) -> list[Condition]:
    try:
        return typed_equations(text, names)
    except ExpressionError as error:
        raise misread(error) from error


def _compared(answer: Conditions, v: Variant, wanted: Wanted, value: Any) -> Comparison:
    """What holds, as far as it can be found out. Raises Unreadable where that takes too long."""
    try:
        with budget(MOST_WORK):
            judged = judge_conditions(wanted.value, value, answer.domain(v), v)
    except TooMuchWork as error:
        raise Unreadable(TOO_LONG) from error
    return Comparison(np.array(judged.holds), judged.share, judged.findings)


def _shown(value: Sequence[Condition]) -> list[str]:
    return [condition_text(condition) for condition in value]


def _handed_in(_: Conditions, value: Sequence[Condition], __: Variant) -> Raw:
    return Raw("text", _shown(value))


MARKER = Marker(read_conditions, _compared, _handed_in, shown=_shown, alone=not_at_all)
