"""Quantities as they are typed: 350 mm, 20 deg/s, sqrt(2)/2 m."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from ...exercises.units import SPELLINGS, UNITS
from ...solutions.tokens import ExpressionError, Token, refusing, tokens_of
from .typed import TYPED, WORDS, typed_tokens

MOST_TOKENS = 7  # of a typed unit: N * m * s / rad


def typed_quantity(text: str) -> tuple[float, str]:
    """Value and unit of a typed quantity in SI: "350mm" is (0.35, "m"), "2 kN*m" is (2000, "N m"), "0.3" is (0.3, "").

    The number is a formula without names. Raises ExpressionError, with the place in the text, where it is none or the
    unit is unknown.
    """
    with refusing(text, "a quantity"):
        tokens = tokens_of(text, TYPED | {"°"})
        longest = range(min(MOST_TOKENS, len(tokens) - 1), 0, -1)
        many = next((many for many in longest if _is_unit(tokens[-1 - many : -1])), 0)
        formula, unit = tokens[: -1 - many], tokens[-1 - many : -1]
        for before, word in pairwise(formula):
            if (
                (before.kind == "number" or before.text == ")")
                and word.kind == "name"
                and word.text not in WORDS
            ):
                raise ExpressionError(
                    f"unknown unit '{text[word.offset :][:40]}'; known: {_listed()}", word.offset
                )
        factor, si = UNITS[SPELLINGS[_joined(unit) or "1"]]
        value = typed_tokens([*formula, Token("end", "", (unit or tokens[-1:])[0].offset)], ()).at(
            {}
        )
        return float(
            Fraction(float(value)) * Fraction(repr(factor))
        ), si  # 350 mm are 0.35 m, not 0.35000000000000003


def _is_unit(tokens: Sequence[Token]) -> bool:
    joined = _joined(tokens)
    return joined in SPELLINGS and joined != "1"


def _joined(tokens: Sequence[Token]) -> str:
    """Tokens as one text, with a space between two names."""
    text = ""
    for before, token in pairwise([Token("sign", "", 0), *tokens]):
        beside = before.kind in ("name", "number") and token.kind == "name"
        text += f"{' ' * beside}{token.text}"
    return text


def _listed() -> str:
    """Units for a sentence: those with one name, and what may be made of them."""
    plain = [name for name in UNITS if name.isalpha() or name == "°"]
    return f"{', '.join(plain)}, and such as m/s, m/rad, N m"
