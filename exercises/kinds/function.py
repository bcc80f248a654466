"""A function of the student's, called on inputs that the student has not seen."""

import ast
import builtins
import inspect
import re
import symtable
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arguments import Calls, arrived
from .kind import Kind, ValueKindError, Variant
from .paper import Paper


@dataclass(frozen=True)
class Function(Kind):
    """A Python function, called on inputs that the student has not seen.

    `signature` is its head without the name of the variable, such as "(q)". `inputs(v)` are the
    arguments by group: a tuple for every call, of numbers, text, and lists and dicts of them.
    Numbers in equal rows arrive as float arrays, inside dicts and lists too; other lists stay
    lists. The reference, which is a function too, gets the same.

    An answer agrees within `tolerance` of the reference; a part's own `check` gets `Results` and
    judges instead. A group of calls is one item of the feedback and earns its share when all of it
    is right. Where all its results are alike, such as zeros, it does so only beside a right result
    of another kind: a constant function earns nothing. `published(v)` are the calls whose results a
    student without Python hands in.
    """

    signature: str
    inputs: Callable[[Variant], Calls]
    tolerance: float = 1e-6
    published: Callable[[Variant], Calls] | None = None

    @property
    def form(self) -> str:
        """Its head."""
        return f"def NAME{self.signature}"

    @property
    def self_check(self) -> tuple[str, Any]:
        """A function, whatever it does."""
        return "function", None

    @property
    def paper(self) -> Paper:
        """Lines for the code."""
        return Paper(lines=16)

    def calls(self, v: Variant) -> list[tuple[Any, ...]]:
        """The arguments of all calls, group after group."""
        return [*chain.from_iterable(self.inputs(v).values())]

    def published_calls(self, v: Variant) -> list[tuple[Any, ...]]:
        """The arguments of the calls whose results may be handed in without a function."""
        if self.published is None:
            return []
        return [*chain.from_iterable(self.published(v).values())]

    def declared(self, value: Any, v: Variant) -> Callable[..., Any]:
        """The function, which gets its arguments as a student's function gets them."""
        if not callable(value):
            raise ValueKindError(f"takes a function, got {type(value).__name__}")

        @wraps(value)
        def called(*call: Any) -> Any:
            return value(*map(arrived, call))

        return called

    def pictured(self, value: Callable[..., Any], v: Variant) -> NDArray[np.float64]:
        """Results for the first call of every group, one after the other."""
        results: list[NDArray[np.float64]] = []
        for group in self.inputs(v).values():
            result = value(*group[0])
            results.append(np.asarray(result, dtype=float).ravel())
        return np.concatenate(results)

    def blank(self, variable: str) -> str:
        """A head without a body."""
        return f"def {variable}{self.signature}:\n    ..."

    def code(self, variable: str, value: Callable[..., Any]) -> str:
        """Its source under the variable's name; it takes numpy as np and nothing else.

        What has no source of its own, such as a lambda, is a comment: `unprintable` says what would
        be right.
        """
        definition = _definition(value)
        if definition is None:
            return (
                f"# {variable}: the reference function is not written with def, "
                "so it cannot be printed."
            )
        source, name = definition
        return re.sub(rf"\Adef\s+{name}\b", f"def {variable}", source)

    def matlab(self, stacked: str) -> tuple[str, str]:
        """Nothing but a hint: a function is handed in as Python."""
        signature = " ".join(self.signature.split())
        return "{}", f"a Python function NAME{signature}: hand in the notebook"

    def unprintable(self, variable: str, value: Callable[..., Any]) -> str:
        """Why the worked solution would not run on a sheet; empty when it would."""
        definition = _definition(value)
        if definition is None:
            return (
                "the reference function cannot be printed as the worked solution: "
                "it takes a def of its own, no lambda"
            )
        missing = _missing_names(self.code(variable, value), variable)
        if not missing:
            return ""

        *first, last = missing
        said = last
        if first:
            said = f"{', '.join(first)} and {last}"
        return (
            f"the reference function {definition[1]} uses {said}, which its worked solution does "
            "not have: printed on a sheet it knows numpy as np and nothing else, so define helpers "
            "inside it and hand over numbers as arguments"
        )


def _definition(function: Callable[..., Any]) -> tuple[str, str] | None:
    """Source of a function from its `def` on, without indentation, and its name there."""
    try:
        source = textwrap.dedent(inspect.getsource(function)).rstrip()
        tree = ast.parse(source)
    except (OSError, TypeError, SyntaxError):
        return None
    if not tree.body or not isinstance(tree.body[0], ast.FunctionDef):
        return None

    first = tree.body[0]
    lines = source.splitlines()[first.lineno - 1 :]  # decorators are left out
    return "\n".join(lines), first.name


def _missing_names(code: str, variable: str) -> list[str]:
    """Names that some code reads and neither sets nor has as a builtin, sorted."""
    table = symtable.symtable(code, "<worked solution>", "exec")
    known = {*dir(builtins), "np", variable}
    return sorted(_read_globals(table) - known)


def _read_globals(table: symtable.SymbolTable) -> set[str]:
    """Names that a scope, or a scope inside it, reads from the module."""
    at_top = table.get_type() == "module"
    found = set[str]()
    for symbol in table.get_symbols():
        outside = symbol.is_global() or (at_top and not symbol.is_assigned())
        if symbol.is_referenced() and outside:
            found.add(symbol.get_name())
    return found.union(*map(_read_globals, table.get_children()))
