"""Quantities as they are typed: 350 mm, 20 deg/s, sqrt(2)/2 m."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from ...exercises.units import SPELLINGS, UNITS
from ...solutions.tokens import ExpressionError, Token, refusing, tokens_of
from .printed import without_assignment
from .shorthands import WORDS
from .typed import TYPED, typed_tokens

MOST_TOKENS = 7  # of a typed unit: N * m * s / rad


def typed_quantity(text: str) -> tuple[float, str]:
    """Value and unit of a typed quantity in SI: "350mm" is (0.35, "m"), "2 kN*m" is (2000, "N m").

    The number is a formula without names; without a unit, as in "0.3", the unit is "".

    Raises:
        ExpressionError: it is none or the unit is unknown, with the place in the text.
    """
    with refusing(text, "a quantity") as seen:
        tokens = without_assignment(tokens_of(seen, TYPED | {"°", "="}), ())
        place = len(tokens) - 1 - _unit_length(tokens)
        formula, unit = tokens[:place], tokens[place:-1]
        _refuse_unknown_unit(formula, seen)
        factor, si = UNITS[SPELLINGS[_joined(unit) or "1"]]

        end = Token("end", "", tokens[place].offset)
        value = float(typed_tokens([*formula, end], ()).at({}))
        # Exactly, for 350 mm are 0.35 m, not 0.35000000000000003.
        return float(Fraction(value) * Fraction(repr(factor))), si


def _unit_length(tokens: Sequence[Token]) -> int:
    """How many of the last tokens are a unit, the more the better; the very last is the end."""
    for length in range(min(MOST_TOKENS, len(tokens) - 1), 0, -1):
        joined = _joined(tokens[-1 - length : -1])
        if joined in SPELLINGS and joined != "1":
            return length
    return 0


def _refuse_unknown_unit(formula: Sequence[Token], text: str) -> None:
    for before, word in pairwise(formula):
        if word.kind != "name" or word.text in WORDS:
            continue
        if before.kind == "number" or before.text == ")":
            unknown = text[word.offset :][:40]
            raise ExpressionError(f"unknown unit '{unknown}'; known: {_listed()}", word.offset)


def _joined(tokens: Sequence[Token]) -> str:
    """Tokens as one text, with a space between two names."""
    text = ""
    beside = False
    for token in tokens:
        if beside and token.kind == "name":
            text += " "
        text += token.text
        beside = token.kind in ("name", "number")
    return text


def _listed() -> str:
    """Units for a sentence: those with one name, and what may be made of them."""
    plain = [name for name in UNITS if name.isalpha() or name == "°"]
    return f"{', '.join(plain)}, and such as m/s, m/rad, N m"
