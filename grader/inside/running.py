# pyright: reportAttributeAccessIssue=false
"""Cells run as Jupyter runs them, in one module of the student's own."""

import __future__

import ast
import builtins
import inspect
import io
import os
import re
import sys
import types

from .absent import stand_ins
from .shell import HARMLESS, Shell

FLAGS = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
FUTURES = [getattr(__future__, name).compiler_flag for name in ("annotations", "barry_as_FLUFL")]
PROMPT = re.compile(r"^\s*In \[\d+\]:", re.MULTILINE)
NOBODY = "input() has nobody to ask when a sheet is marked; write the value into the cell"
AUTOMAGIC = HARMLESS - {"dirs", "edit", "macro", "magic", "page", "recall", "save", "store", "tb"}


class Capped(io.TextIOBase):
    """Output that is accepted and forgotten."""

    def writable(self):
        """Yes, whatever is printed."""
        return True

    def write(self, text):
        """Forgets the text."""
        return len(text)


class Session:
    """The module in which cells run, and what a cell sees around it."""

    def __init__(self, *, with_ipython=False):
        module = types.ModuleType("__main__")
        sys.modules["__main__"] = module  # in the place of ours
        self.scope = module.__dict__
        self.shell = Shell(self.run, self.scope)
        self.future = 0  # what `from __future__ import` has switched on
        self.loop = None
        self.transform = None

        sys.stdin = io.StringIO()
        sys.stdout = sys.stderr = Capped()
        builtins.input = _nobody
        self.scope.update(
            __builtins__=builtins, display=_shown, get_ipython=lambda: self.shell, Out={}, In=[""]
        )
        # A sheet's first cell imports it; one failing line beside it costs no answers.
        self.scope["np"] = sys.modules["numpy"]
        if with_ipython or "IPython" in sys.modules:
            self._introduce()

    def run(self, source):
        """Runs a cell; raises what it raises."""
        tree = self._parsed(source)
        last = None
        if tree.body and isinstance(tree.body[-1], ast.Expr):
            last = tree.body.pop()
        for piece in _pieces(tree.body):
            self._execute(piece)
        if last is not None:
            self._keep(self._evaluated(last))

    def stand_in(self, name):
        """Has a script find its own name, as `python NAME` would; the file itself is not there."""
        self.scope["__file__"] = os.path.join(os.getcwd(), name)
        sys.argv = [name]

    def close_figures(self):
        """As Jupyter does after a cell: the next plot is a new figure."""
        pyplot = sys.modules.get("matplotlib.pyplot")
        if pyplot is not None:
            pyplot.close("all")

    def _parsed(self, source):
        """A cell that is Python as it stands means the same to IPython, whose import takes long.

        But for a pasted prompt, which is an annotation to Python.
        """
        try:
            tree = ast.parse(source)
        except SyntaxError:
            return ast.parse(self._transformed(source))
        if PROMPT.search(source):
            return ast.parse(self._transformed(source))
        return tree

    def _transformed(self, source):
        if self.transform is None:
            self.transform = _transformer()
            self._introduce()
        read = self.transform(source)
        name, _, line = source.strip().partition(" ")
        is_set = line.lstrip().startswith("=")
        if "\n" not in source.strip() and name in AUTOMAGIC and not is_set:  # pip install scipy
            return f"get_ipython().run_line_magic({name!r}, {line!r})\n"
        return read

    def _introduce(self):
        """Makes IPython's own get_ipython return our shell."""
        try:
            import IPython
            from IPython.core import getipython
        except ImportError:
            return
        IPython.get_ipython = getipython.get_ipython = self.scope["get_ipython"]

    def _execute(self, piece):
        code = compile(piece, "<cell>", "exec", FLAGS | self.future, dont_inherit=True)
        self.future |= code.co_flags & sum(FUTURES)
        try:
            self._awaited(code)
        except ModuleNotFoundError as error:
            statement = piece.body[0]
            if not isinstance(statement, (ast.Import, ast.ImportFrom)):
                raise
            self.scope.update(stand_ins(statement, error))

    def _evaluated(self, expression):
        """The value of a cell's last line."""
        code = compile(
            ast.Expression(expression.value),
            "<cell>",
            "eval",
            FLAGS | self.future,
            dont_inherit=True,
        )
        return self._awaited(code)

    def _awaited(self, code):
        """What code gives back, on an event loop where it awaits something."""
        value = eval(code, self.scope)
        if not code.co_flags & inspect.CO_COROUTINE:
            return value
        if self.loop is None:
            import asyncio

            self.loop = asyncio.new_event_loop()
        return self.loop.run_until_complete(value)

    def _keep(self, value):
        """The last value is `_` in the next cell."""
        if value is not None:
            self.scope["_"] = value


def _pieces(statements):
    """Statements as modules to run one after the other, every import by itself.

    One that is in vain does not take others along.
    """
    together = []
    for statement in statements:
        if not isinstance(statement, (ast.Import, ast.ImportFrom)):
            together.append(statement)
            continue
        if together:
            yield ast.Module(together, [])
        together = []
        yield from _alone(statement)
    if together:
        yield ast.Module(together, [])


def _alone(statement):
    if isinstance(statement, ast.ImportFrom):
        yield ast.Module([statement], [])
        return
    for alias in statement.names:
        one = ast.copy_location(ast.Import([alias]), statement)
        yield ast.Module([one], [])


def _transformer():
    """IPython's own reading of a cell; without IPython, cells are plain Python."""
    try:
        from IPython.core.inputtransformer2 import TransformerManager
    except ImportError:
        return lambda source: source
    return TransformerManager().transform_cell


def _nobody(*_args):
    raise RuntimeError(NOBODY)


def _shown(*_values, **_options):
    """What display() does where nobody looks."""
