"""Formulas in the names of the sheet."""

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

import numpy as np

from ...exercises.answers import Formulas, Variant
from ...exercises.kinds.formulas import names_on_sheet
from ...solutions.expression import Expression, ExpressionError, parse
from ...solutions.expression_array import ANGLE, SAME, ExpressionArray, same_formulas, sampled
from ..collecting.wire import Raw
from ..reading.arrays import flat_texts, real_numbers, reshaped
from ..reading.rounded import rounded_angles
from ..reading.typed import typed
from ..reading.typed_matrix import typed_matrix
from ..reading.unreadable import Unreadable, clip, entry_name, misread
from .allowed import Array, Mask, exactly
from .marker import Asked, Beside, Marker, Named, Wanted
from .signs import said_of_signs

NUMBERS_PUT_IN = 5e-3  # numbers of a sheet have two or three decimals
DUST = 1e-12
T = TypeVar("T")


def read_formulas(answer: Formulas, raw: Raw, v: Variant) -> ExpressionArray:
    """Formulas of the asked shape: nested text, one text with all of them, or constants.

    Raises:
        Unreadable: they are of another kind or shape, or one cannot be read.
    """
    names = names_on_sheet(answer.names, v)
    if raw.kind == "num":
        entries = _constants(raw.value, answer.shape)
    elif raw.kind != "text":
        raise Unreadable(f"takes formulas of shape {answer.shape}, got {clip(raw.kind)}")
    elif isinstance(raw.value, str) and answer.shape:
        entries = _typed_at_once(raw.value, answer.shape, names)
    else:
        entries = _typed_entries(raw.value, answer.shape, names)
    return ExpressionArray(tuple(entries), answer.shape)


def _constants(array: Array, shape: tuple[int, ...]) -> list[Expression]:
    _refuse_other_shape(array.shape, shape)
    array = real_numbers(array)
    if not np.isfinite(array).all():
        raise Unreadable("takes formulas, got numbers that are not finite")
    return [_constant(float(number)) for number in array.ravel()]


def _constant(number: float) -> Expression:
    text = "0" if abs(number) < DUST else repr(number)
    return _read(text, lambda text: parse(text, ()))


def _typed_at_once(text: str, shape: tuple[int, ...], names: Sequence[str]) -> list[Expression]:
    """The entries of a matrix in one text, row by row."""
    rows = _read(text, lambda text: typed_matrix(text, names, shape[-1]))
    _refuse_other_shape((len(rows), len(rows[0])), shape)
    return [entry for row in rows for entry in row]


def _typed_entries(texts: object, shape: tuple[int, ...], names: Sequence[str]) -> list[Expression]:
    """The entries of nested text, each read by itself."""
    flat, found = flat_texts(texts)
    _refuse_other_shape(found, shape)  # before an entry is read
    entries: list[Expression] = []
    for text, where in zip(flat, np.ndindex(found), strict=True):
        entries.append(_read(text, lambda text: typed(text, names), entry_name(where)))
    return entries


def _refuse_other_shape(found: tuple[int, ...], asked: tuple[int, ...]) -> None:
    reshaped(np.zeros(found), asked)


def _read(text: str, read: Callable[[str], T], where: str = "") -> T:
    """What `read` makes of a text. Raises Unreadable, with the place of the entry."""
    try:
        return read(text)
    except ExpressionError as error:
        raise misread(error, where) from error


def _compared(answer: Formulas, v: Variant, wanted: Wanted, value: ExpressionArray) -> Mask:
    return same_formulas(value, wanted.value, names_on_sheet(answer.names, v))


def _handed_in(_: Formulas, value: ExpressionArray, __: Variant) -> Raw:
    return Raw("text", value.text())


def _read_as(_: Formulas, __: Raw, value: ExpressionArray) -> str:
    """The first rounded angle: formulas are compared to more digits than it has."""
    for entry in value.entries:
        angles = {name for name in entry.names if ANGLE.fullmatch(name)}
        for number, exact in rounded_angles(entry, angles).items():
            return f"Read with {number} as it stands; formulas take {exact}, not its rounded value."
    return ""


def _trivial(_: Formulas, wanted: Wanted, __: Variant) -> Mask:
    """Entries without names."""
    constant = [not entry.names for entry in wanted.value.entries]
    return np.array(constant).reshape(wanted.value.shape)


def _arrays(asked: Asked, value: ExpressionArray) -> list[Beside]:
    """Numbers of both at a few points."""
    names = names_on_sheet(asked.answer.names, asked.v)
    theirs, ours = sampled(value, names), sampled(asked.wanted.value, names)
    found: list[Beside] = []
    for own, reference in zip(theirs, ours, strict=True):
        found.append((own, reference, exactly(SAME * np.maximum(1.0, np.abs(reference)))))
    return found


def _has_blocks(_: Formulas) -> bool:
    return True


def _found(asked: Asked, value: ExpressionArray, right: Mask) -> Iterator[Named]:
    reference: ExpressionArray = asked.wanted.value
    missing = ", ".join(sorted(reference.names - value.names))
    if missing and _numbers_put_in(value, reference, own_numbers(asked.v)):
        yield Named(
            f"With your numbers put in it is right, but formulas are asked: they take {missing}."
        )
        return
    negated = same_formulas(_negated(value), reference, names_on_sheet(asked.answer.names, asked.v))
    yield from said_of_signs(negated & ~right, ~right)


def _numbers_put_in(
    value: ExpressionArray, reference: ExpressionArray, own: dict[str, float]
) -> bool:
    """Whether both come to the same with the student's own numbers, where all names have one."""
    if not set(own) >= reference.names | value.names:
        return False
    difference = np.abs(value.at(own) - reference.at(own))
    return bool((difference <= NUMBERS_PUT_IN).all())


def own_numbers(v: Variant) -> dict[str, float]:
    """Values of all names of a sheet, joints included."""
    numbers: dict[str, float] = {}
    for name, value in v.items():
        if isinstance(value, int | float):
            numbers[name] = float(value)
    for i, q in enumerate(v.get("q", ()), 1):
        numbers[f"q{i}"] = float(q)
    return numbers


def _negated(value: ExpressionArray) -> ExpressionArray:
    negated: list[Expression] = []
    for entry in value.entries:
        last = len(entry.nodes) - 1
        negated.append(Expression((*entry.nodes, ("neg", last))))
    return ExpressionArray(tuple(negated), value.shape)


def _priced(_: Formulas, value: ExpressionArray) -> bool:
    return bool(value.names)


MARKER = Marker(
    read_formulas,
    _compared,
    _handed_in,
    shown=ExpressionArray.text,
    read_as=_read_as,
    trivial=_trivial,
    arrays=_arrays,
    has_blocks=_has_blocks,
    found=_found,
    priced=_priced,
)
