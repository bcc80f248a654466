"""Functions from the source that is written for a program."""

from collections.abc import Callable
from typing import Any

from .tracer import Operation, Signed, Value
from .walk import Program

SYMBOLS = {"multiply": "*", "add": "+", "subtract": "-"}


def function_of(signature: str, lines: list[str], names: dict[str, Any]) -> Callable[..., Any]:
    """The function with that signature, such as "single(q)", that body and those global names."""
    source = "\n".join([f"def {signature}:", *lines])
    exec(source, names)  # noqa: S102  only float literals and register names can occur in it
    return names[signature.partition("(")[0]]


def angle_text(program: Program, index: int) -> str:
    """An angle as its source is written, such as "+q0-q1 + 0.3"."""
    text = ""
    for sign, joint in program.angles[index]:
        symbol = "+" if sign > 0 else "-"
        text += f"{symbol}q{joint}"
    if program.shifts[index]:
        text += f" + {program.shifts[index]!r}"
    return text


def operation_text(step: Operation) -> str:
    """A step as its source is written, such as "r1 * c0"."""
    return f"{step.left} {SYMBOLS[step.operation]} {step.right}"


def written(value: Value) -> str:
    """A value as its source is written: no negative sign in front of a zero."""
    if not isinstance(value, Signed):
        return repr(value)
    if value.negative:
        return f"0.0 - {value.name}"  # -x would be -0.0 where x is 0.0
    return value.name
