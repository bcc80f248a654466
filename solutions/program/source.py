"""Functions from the source that is written for a program."""

from collections.abc import Callable
from typing import Any


def function_of(signature: str, lines: list[str], names: dict[str, Any]) -> Callable[..., Any]:
    """The function with that signature, such as "single(q)", that body and those global names."""
    source = "\n".join([f"def {signature}:", *lines])
    exec(source, names)  # noqa: S102  only float literals and register names can occur in it
    return names[signature.partition("(")[0]]
