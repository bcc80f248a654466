"""Quantities with units: 350 mm, 20 deg/s, sqrt(2)/2 m."""

import math
from collections.abc import Mapping
from fractions import Fraction
from itertools import pairwise
from types import MappingProxyType
from typing import NamedTuple

from .tokens import ExpressionError, Token, refusing, tokens_of
from .typed import TYPED, WORDS, typed_tokens


class Unit(NamedTuple):
    factor: float  # to SI
    si: str


_DEGREE = math.pi / 180
UNITS: Mapping[str, Unit] = MappingProxyType({
    "1": Unit(1.0, ""),
    "m": Unit(1.0, "m"), "km": Unit(1e3, "m"), "cm": Unit(1e-2, "m"), "mm": Unit(1e-3, "m"),
    "s": Unit(1.0, "s"), "ms": Unit(1e-3, "s"),
    "rad": Unit(1.0, "rad"), "deg": Unit(_DEGREE, "rad"), "°": Unit(_DEGREE, "rad"),
    "m/s": Unit(1.0, "m/s"), "cm/s": Unit(1e-2, "m/s"), "mm/s": Unit(1e-3, "m/s"),
    "rad/s": Unit(1.0, "rad/s"), "deg/s": Unit(_DEGREE, "rad/s"), "°/s": Unit(_DEGREE, "rad/s"),
    "rpm": Unit(math.tau / 60, "rad/s"),
    "m/rad": Unit(1.0, "m/rad"), "cm/rad": Unit(1e-2, "m/rad"), "mm/rad": Unit(1e-3, "m/rad"),
})  # fmt: skip


def typed_quantity(text: str) -> tuple[float, str]:
    """Value and unit of a typed quantity in SI: "350mm" is (0.35, "m"), "0.3" is (0.3, "").

    The number is a formula without names. Raises ExpressionError, with the place in the text, where it is none or the
    unit is unknown.
    """
    with refusing(text, "a quantity"):
        tokens = tokens_of(text, TYPED | {"°"})
        many = next((many for many in (3, 1) if _is_unit(tokens[-1 - many : -1])), 0)
        formula, unit = tokens[: -1 - many], tokens[-1 - many : -1]
        for before, word in pairwise(formula):
            if (before.kind == "number" or before.text == ")") and word.kind == "name" and word.text not in WORDS:
                raise ExpressionError(f"unknown unit '{text[word.offset :]}'; known: {', '.join(UNITS)}", word.offset)
        factor, si = UNITS["".join(token.text for token in unit) or "1"]
        value = typed_tokens([*formula, Token("end", "", (unit or tokens[-1:])[0].offset)], ()).at({})
        return float(Fraction(float(value)) * Fraction(repr(factor))), si  # 350 mm are 0.35 m, not 0.35000000000000003


def _is_unit(tokens: list[Token]) -> bool:
    return "".join(token.text for token in tokens) in UNITS and tokens[0].kind != "number"
