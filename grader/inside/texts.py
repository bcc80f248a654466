"""Formulas and strings as nested text."""

from .failures import failed
from .limits import MAX_ELEMENTS, MAX_ROWS, MAX_TEXT

REAL_KINDS = ("b", "i", "u", "f")  # of numpy's types
LOGICAL = ("And", "Or")  # sympy's


class TooLong(ValueError):
    """An answer with more text than is read."""


def holds_text(value, depth=3):
    """Whether text or a formula is in a value; a sympy expression is read as its text."""
    if getattr(value, "free_symbols", None) or is_solution(value):
        return True
    if not isinstance(value, (list, tuple)) or depth == 0 or len(value) > MAX_ELEMENTS:
        return False
    return any(isinstance(item, str) or holds_text(item, depth - 1) for item in value)


def is_solution(value):
    """Whether it is what sympy's solve returns: a dict with a value for every unknown."""
    if not isinstance(value, dict) or not value:
        return False
    return all(getattr(name, "free_symbols", None) for name in value)


def text_of(value):
    """Nested text as data; an error where it is too long."""
    try:
        return {"k": "text", "v": plain_text(value)}
    except TooLong as error:
        return failed(str(error))


def plain_text(value, depth=3):
    """Nested lists of strings; what is left of a formula that was cut off could be another one."""
    if isinstance(value, (list, tuple)) and depth:
        if len(value) > MAX_ROWS:
            entries = f"a list of {len(value)} entries"
            raise TooLong(f"too long: {entries}; an answer may have {MAX_ROWS}")
        return [plain_text(item, depth - 1) for item in value]

    text = entry(value)
    if len(text) > MAX_TEXT:
        raise TooLong(f"too long: a text of {len(text)} characters; {MAX_TEXT} can be read here")
    return text


def entry(value):
    """Text of one entry: numbers as their shortest exact text, sympy's equations as a = b."""
    if isinstance(value, str):
        return str(value)
    if is_real(value):
        return repr(float(value))
    if getattr(value, "rel_op", "") == "==":
        return f"{value.lhs} = {value.rhs}"
    if type(value).__name__ in LOGICAL and hasattr(value, "args"):
        return listing(value)
    if is_solution(value):
        return " and ".join([f"{name} = {entry(value[name])}" for name in value])
    if hasattr(value, "xreplace"):
        value = without_dust(value)
    return str(value)


def is_real(value):
    """Whether it is a real number of Python or numpy."""
    if isinstance(value, (int, float)):
        return True
    dtype = getattr(value, "dtype", None)
    return getattr(dtype, "kind", None) in REAL_KINDS


def listing(value):
    """What sympy's And and Or of equations, say, in brackets where they stand in one another."""
    texts = []
    for part in value.args:
        text = entry(part)
        if type(part).__name__ in LOGICAL:
            text = f"({text})"
        texts.append(text)
    word = type(value).__name__.lower()
    return f" {word} ".join(texts)


def without_dust(value):
    """A sympy expression where np.pi / 2 left 6e-17 in the place of a zero."""
    dust = [number for number in value.atoms() if is_dust(number)]
    return value.xreplace(dict.fromkeys(dust, 0)) if dust else value


def is_dust(number):
    """Whether it is what rounding leaves of a zero."""
    return getattr(number, "is_Float", False) and abs(number) < 1e-12
