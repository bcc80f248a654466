# pyright: reportAttributeAccessIssue=false, reportArgumentType=false
"""A value as data: numbers, nested text, or the reason why it is neither."""

import sys

from .absent import Absent, AbsentError
from .alarms import CellTimeout
from .failures import failed
from .limits import MAX_CALLS, MAX_ELEMENTS, MAX_ROWS
from .texts import entry, holds_text, text_of

PENDING = {"k": "missing", "v": ""}
IN_PLACE = (
    "a function without a return gives it, and simplify() of a Matrix, which changes it in place"
)
NAMED_TYPES = {"dict": "a dict", "function": "a function", "NoneType": "None", "set": "a set"}


def encode(value):
    """A value as data: numbers, nested text, or the reason why it is neither."""
    if value is ...:
        return PENDING
    if type(value) is Absent:
        return absent(value)
    value = without_matrices(value)
    if is_array_of_objects(value):  # of formulas, or of strings
        value = value.tolist()
    if isinstance(value, (set, frozenset)) and holds_text(list(value)):
        value = sorted(entry(item) for item in value)

    if isinstance(value, str) or holds_text(value):
        return text_of(value)
    return numbers_of(value)


def absent(value):
    """Why a placeholder is no value."""
    try:
        return value()
    except AbsentError as error:
        return failed(str(error), error.name)


def without_matrices(value):
    """A sympy matrix, or a list of them, as nested lists."""
    if hasattr(value, "tolist") and hasattr(value, "free_symbols"):
        return value.tolist()
    if isinstance(value, (list, tuple)) and len(value) <= MAX_ROWS:
        return [without_matrices(item) for item in value]
    return value


def is_array_of_objects(value):
    """Whether it is a numpy array of what is no number to numpy."""
    if type(value).__module__ != "numpy":
        return False
    dtype = getattr(value, "dtype", None)
    return dtype is not None and dtype.kind in "OUS"


def numbers_of(value):
    """An array as data; an error where it is none."""
    np = numpy_here()
    if value is None:
        return failed(f"not a matrix of numbers: None; {IN_PLACE}")
    try:
        array = as_array(np, value)
    except CellTimeout:
        raise  # the reader says so, and does not try again
    except BaseException as error:
        why = f"not a matrix of numbers: {describe(value)} ({type(error).__name__})"
        return failed(why)
    if array.size > MAX_ELEMENTS or array.ndim > 4:
        return failed(f"too large: an array of shape {array.shape}")
    if array.dtype.kind not in "iufc":
        return failed(f"not a matrix of numbers: {describe(value)}")

    flat = array.astype(complex).ravel()
    imaginary = flat.imag.tolist() if array.dtype.kind == "c" else []
    shape = [int(length) for length in array.shape]
    return {"k": "num", "v": {"shape": shape, "re": flat.real.tolist(), "im": imaginary}}


def numpy_here():
    """The numpy that is loaded: a notebook may have broken the import statement."""
    np = sys.modules.get("numpy")
    if np is None:
        import numpy as np
    return np


def as_array(np, value):
    """The array of a value: real where nothing is imaginary in sympy numbers and fractions."""
    array = np.asarray(value)
    if array.dtype.kind == "O":  # sympy numbers, fractions, lists of arrays
        array = np.array([complex(item) for item in array.ravel()]).reshape(array.shape)
        if not array.imag.any():
            array = array.real
    return array


def describe(value):
    """What a value is, in a few words."""
    kind = type(value).__name__
    return NAMED_TYPES.get(kind, f"a value of type {kind}")[:80]


def encode_asked(value, calls):
    """A value as data; results of calls may be listed, one of another shape than the next."""
    whole = encode(value)
    if whole["k"] != "error" or not calls:
        return whole
    if not isinstance(value, (list, tuple)) or len(value) > MAX_CALLS:
        return whole

    results = [encode(result) for result in value]
    if all(result["k"] == "error" for result in results):
        return whole
    return {"k": "calls", "v": results, "listed": True}


def encode_result(value):
    """A result of a call, where True and False are 1 and 0: a function may say yes or no."""
    np = numpy_here()
    try:
        yes_or_no = np.asarray(value).dtype.kind == "b"
    except Exception:
        yes_or_no = False
    if yes_or_no:
        value = np.asarray(value, dtype=float)
    return encode(value)
