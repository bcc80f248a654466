"""A number as it is written everywhere: in a cell of a file, as text in a notebook or a table."""

import re

NUMBER = re.compile(
    r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[+-]?(?:nan|inf|infinity)",
    re.IGNORECASE,
)
MOST_DIGITS = 400  # of one number, written out


def plain_number(text: str) -> float | None:
    """The value of a number in the digits 0 to 9; None where it is none.

    Python's own reader takes 1_000 and the digits of every script, which no formula does. NaN and
    infinity are numbers here: that they are not finite is said where they are judged.
    """
    typed = text.strip()
    if len(typed) > MOST_DIGITS or not NUMBER.fullmatch(typed):
        return None
    return float(typed)
