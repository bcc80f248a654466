"""What stands in an answer cell: the blank a student fills in, and an answer in full, as a student could write it."""

import ast
import builtins
import inspect
import re
import symtable
import textwrap
from collections.abc import Callable, Sequence
from importlib.resources import files
from typing import Any

import numpy as np

from ..exercises.answers import (
    Choice,
    Conditions,
    Configurations,
    Formulas,
    Function,
    Manual,
    Numbers,
    TableOf,
)
from ..exercises.exercise import Part
from ..solutions.condition import condition_text


def blank(part: Part) -> str:
    """Python of an answer cell as it is handed out."""
    if isinstance(part.answer, Function):
        return f"def {part.variable}{part.answer.signature}:\n    ..."
    return f"{part.variable} = ...  # {form(part)}"


def form(part: Part) -> str:
    """The form of an answer in a few words."""
    return _FORMS[type(part.answer)](part.answer)


def _size(shape: tuple[int, ...], what: str) -> str:
    return f"{' x '.join(map(str, shape))} {what}s" if shape else f"one {what}"


_FORMS: dict[type, Callable[[Any], str]] = {
    Numbers: lambda answer: _size(answer.shape, "number"),
    TableOf: lambda answer: f"{len(answer.kinds)} rows [theta, d, a, alpha]",
    Formulas: lambda answer: f"{_size(answer.shape, 'formula')}, as text or sympy",
    Choice: lambda answer: f"one of {', '.join(repr(letter) for letter in answer.letters)}",
    Conditions: lambda _: "a list of conditions, such as ['sin(q1) = 0']",
    Configurations: lambda answer: (
        f"a list of {'numbers' if answer.joints == 1 else f'rows of {answer.joints} numbers'}"
    ),
    Function: lambda answer: f"def NAME{answer.signature}",
    Manual: lambda answer: "on paper" if answer.on_paper else "your text in quotes; it is marked by hand",
}


def answer_code(part: Part, answer: Any) -> str:
    """Python that assigns a reference answer in full."""
    if isinstance(part.answer, Function):
        return function_code(part, answer)
    return f"{part.variable} = {_CODES[type(part.answer)](part, answer)}"


def _array(part: Part, answer: Any) -> str:
    rounded = np.round(np.asarray(answer), 9) + 0.0
    if not rounded.shape:
        return repr(float(rounded))
    indent = " " * (len(part.variable) + len(" = np.array("))
    text = np.array2string(rounded, precision=9, separator=", ", threshold=10_000)
    return f"np.array({text.replace(chr(10), chr(10) + indent)})"


def _rows(rows: Sequence[Any]) -> str:
    listed = "".join(f"    {row!r},\n" for row in rows)
    return f"[\n{listed}]"


def _texts(_: Part, answer: Any) -> str:
    text: Any = answer.text()
    return _rows(text) if isinstance(text, list) else repr(text)  # pyright: ignore[reportUnknownArgumentType]


_CODES: dict[type, Callable[[Part, Any], str]] = {
    Numbers: _array,
    Configurations: _array,
    TableOf: lambda _, answer: _rows([[str(cell) for cell in row] for row in answer.rows]),
    Formulas: _texts,
    Choice: lambda _, answer: repr(answer),
    Conditions: lambda _, answer: _rows([condition_text(condition) for condition in answer]),
    Manual: lambda _, answer: repr(answer),
}


def function_code(part: Part, function: Callable[..., Any]) -> str:
    """The source of a reference function under the name of its part; it takes numpy as np and nothing else.

    What has no source of its own, such as a lambda, is a comment: `unprintable` says what would be right.
    """
    definition = _definition(function)
    if definition is None:
        return f"# {part.variable}: the reference function is not written with def, so it cannot be printed."
    source, name = definition
    return re.sub(rf"\Adef\s+{name}\b", f"def {part.variable}", source)


def _definition(function: Callable[..., Any]) -> tuple[str, str] | None:
    """Source of a function from its `def` on, without indentation, and its name there."""
    try:
        source = textwrap.dedent(inspect.getsource(function)).rstrip()
        tree = ast.parse(source)
    except (OSError, TypeError, SyntaxError):
        return None
    first = tree.body[0] if tree.body else None
    if not isinstance(first, ast.FunctionDef):
        return None
    lines = source.splitlines()[first.lineno - 1 :]  # decorators are left out
    return "\n".join(lines), first.name


def unprintable(part: Part, function: Callable[..., Any]) -> str:
    """Why the worked solution of a function would not run on a sheet; empty when it would."""
    definition = _definition(function)
    if definition is None:
        return "the reference function cannot be printed as the worked solution: it takes a def of its own, no lambda"
    missing = _missing_names(function_code(part, function), part.variable)
    if not missing:
        return ""
    said = f"{', '.join(missing[:-1])} and {missing[-1]}" if len(missing) > 1 else missing[0]
    return (
        f"the reference function {definition[1]} uses {said}, which its worked solution does not have: printed on a "
        "sheet it knows numpy as np and nothing else, so define helpers inside it and hand over numbers as arguments"
    )


def _missing_names(code: str, variable: str) -> list[str]:
    """Names that some code reads and neither sets nor has as a builtin, in the order of the alphabet."""
    table = symtable.symtable(code, "<worked solution>", "exec")
    known = {*dir(builtins), "np", variable}
    return sorted(_read_globals(table) - known)


def _read_globals(table: symtable.SymbolTable) -> set[str]:
    """Names that a scope, or a scope inside it, reads from the module."""
    at_top = table.get_type() == "module"
    found = {
        symbol.get_name()
        for symbol in table.get_symbols()
        if symbol.is_referenced() and (symbol.is_global() or (at_top and not symbol.is_assigned()))
    }
    return found.union(*map(_read_globals, table.get_children()))


def self_check(parts: Sequence[Part]) -> str:
    """A cell that needs nothing installed: which answers are there, of the right shape and finite."""
    listed = "".join(f"    {part.variable!r}: {_kind(part)!r},\n" for part in parts if not _is_on_paper(part))
    template = files("kinegrade.course").joinpath("templates/self_check.txt").read_text(encoding="utf-8")
    return template.replace("@ANSWERS@", listed.rstrip("\n")).rstrip("\n")


def _is_on_paper(part: Part) -> bool:
    return isinstance(part.answer, Manual) and part.answer.on_paper


def _kind(part: Part) -> tuple[str, Any]:
    answer = part.answer
    if isinstance(answer, Numbers):
        return "numbers", answer.shape
    if isinstance(answer, TableOf):
        return "table", len(answer.kinds)
    if isinstance(answer, Formulas):
        return "formulas", answer.shape
    if isinstance(answer, Choice):
        return "choice", answer.letters
    if isinstance(answer, Configurations):
        return "list", answer.joints
    return {Conditions: "conditions", Function: "function", Manual: "text"}[type(answer)], None
