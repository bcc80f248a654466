"""What every kind of answer brings: its words on a sheet; its values checked and written down."""

from collections.abc import Mapping
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from ...solutions.errors import KinegradeError
from .paper import Paper

Variant = Mapping[str, Any]
"""The drawn numbers of one student, as they come back from JSON."""


class ValueKindError(KinegradeError):
    """A value is not of the declared kind."""


class Kind:
    """A kind of answer: data that an exercise declares.

    Its methods are what a sheet, a record and a proof ask of it. A new kind is a file here and one
    in grader/kinds. What is the same for most kinds stands in this class.
    """

    @property
    def form(self) -> str:
        """The form of an answer in a few words, beside its blank on a sheet."""
        raise NotImplementedError

    @property
    def self_check(self) -> tuple[str, Any]:
        """What the cell looks for that checks a sheet without this package.

        It is a word and a shape or a count.
        """
        raise NotImplementedError

    @property
    def asked_beside(self) -> str:
        """A sentence that stands behind the question; empty where the kind has none."""
        return ""

    @property
    def declared_beside(self) -> Mapping[str, tuple[str, ...]]:
        """What a student says of the answer in variables of their own, by the end of their names.

        Each takes one of these words, the first where nothing is said: with {"convention":
        ("standard", "modified")}, `rrt_dh_convention` is asked for beside `rrt_dh`.
        """
        return {}

    @property
    def array_shape(self) -> tuple[int, ...]:
        """The shape in which an array of numbers would be handed in."""
        return ()

    @property
    def paper(self) -> Paper:
        """Where it is written by hand."""
        return Paper(lines=4)

    def declared(self, value: Any, v: Variant) -> Any:
        """The value as its kind.

        That is an array, `Table`, `ExpressionArray`, letter, tuple of conditions, function or text.

        Raises:
            ValueKindError: it is none; the sentence says what it takes.
            ExpressionError: a formula is in other names.
        """
        raise NotImplementedError

    def pictured(self, value: Any, v: Variant) -> NDArray[np.float64] | None:
        """Numbers that a declared value comes to, for records; None for what is marked by hand."""
        raise NotImplementedError

    def rounded(self, value: Any) -> Any:
        """The value to the decimals that are asked; what is not numbers stays as it is."""
        return value

    def with_decimals(self, decimals: int) -> Self:
        """The same with other decimals asked; itself where none are."""
        return self

    def blank(self, variable: str) -> str:
        """Python of the answer's cell as it is handed out."""
        return "\n".join([*self.declarations(variable), f"{variable} = ...  # {self.form}"])

    def declarations(self, variable: str) -> list[str]:
        """Python of what is declared beside the answer, a line each, as it is handed out."""
        lines: list[str] = []
        for name, (first, *others) in self.declared_beside.items():
            alternatives = ", ".join(f'"{word}"' for word in others)
            lines.append(f'{variable}_{name} = "{first}"  # or {alternatives}')
        return lines

    def code(self, variable: str, value: Any) -> str:
        """Python that assigns a declared value in full."""
        return f"{variable} = {value!r}"

    def matlab(self, stacked: str) -> tuple[str, str]:
        """An empty value in MATLAB and the comment behind it.

        `stacked` says which rows of a Jacobian come first.
        """
        raise NotImplementedError


class ArrayKind(Kind):
    """A kind whose value is an array of numbers, to some `decimals` where these are asked."""

    decimals: int

    def pictured(self, value: Any, v: Variant) -> NDArray[np.float64]:
        """The numbers themselves."""
        return value

    def rounded(self, value: Any) -> Any:
        """To the asked decimals."""
        return np.round(np.asarray(value), self.decimals)

    def code(self, variable: str, value: Any) -> str:
        """An array with nine decimals."""
        return array_code(variable, value)


def sized(shape: tuple[int, ...], what: str) -> str:
    """A shape in words: "3 x 2 numbers", "one number"."""
    if not shape:
        return f"one {what}"
    size = " x ".join(map(str, shape))
    return f"{size} {what}s"


def listed_rows(rows: list[Any]) -> str:
    """Python of a list with a line for every row."""
    lines = "".join(f"    {row!r},\n" for row in rows)
    return f"[\n{lines}]"


def finite(value: Any, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """The value as a finite real array of that shape. Raises ValueKindError."""
    array = np.asarray(value, dtype=float)
    if array.shape != shape:
        raise ValueKindError(f"takes finite numbers of shape {shape}, got shape {array.shape}")
    if not np.isfinite(array).all():
        raise ValueKindError(
            f"takes finite numbers of shape {shape}, got shape {shape} with NaN or infinity"
        )
    return array


def array_code(variable: str, value: Any) -> str:
    """Python that assigns an array with nine decimals, or a number."""
    rounded = np.round(np.asarray(value), 9) + 0.0  # no -0.0
    if not rounded.shape:
        return f"{variable} = {float(rounded)!r}"
    head = f"{variable} = np.array("
    text = np.array2string(rounded, precision=9, separator=", ", threshold=10_000)
    return head + text.replace("\n", "\n" + " " * len(head)) + ")"
