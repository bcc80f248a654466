"""What cells and calls stopped with, in sentences, and which answers that cost."""

import ast
import re

from .absent import package_of
from .alarms import CellTimeout, limited
from .limits import MAX_SAID


class Failures:
    """What cells stopped with, by the asked names that they should set."""

    def __init__(self, names, seconds):
        self.names = names
        self.seconds = seconds
        self.first, self.package = "", ""  # of the cell that stopped before all others
        self.by_name = {}  # (sentence, absent package) of each

    def add(self, where, source, error):
        """Keeps the error of a cell; where a name is missing, the first error may be the reason."""
        said, package = failure(where, error, self.seconds), package_of(error)
        if isinstance(error, NameError) and self.first:
            said += f"; before that, {self.first}"
            package = self.package
        if not self.first:
            self.first, self.package = said, package

        touched = assigned_names(source)
        for name in self.names:
            if name in touched:
                self.by_name[name] = (said[:MAX_SAID], package)

    def forget(self, source):
        """Drops the errors of what a cell has now set."""
        if not self.by_name:
            return
        for name in assigned_names(source):
            self.by_name.pop(name, None)


def failed(why, package=""):
    """The value of a variable that has none; `package` is one that is not installed here."""
    value = {"k": "error", "v": why}
    if package:
        value["absent"] = package
    return value


def failure(where, error, seconds):
    """What a cell stopped with, in a sentence that begins with where it is."""
    if not isinstance(error, SyntaxError):
        return f"{where} {stopped(error, seconds)}"
    if where.startswith("cell"):
        return f"{where} is not Python: {error.msg} (line {error.lineno})"
    return f"{where} is not Python: {error.msg}"


def line_of(error):
    """The line of a cell in which it stopped, counted from 1."""
    if isinstance(error, SyntaxError):
        return error.lineno or 1
    trace = error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == "<cell>":
            return trace.tb_lineno
        trace = trace.tb_next
    return 1


def stopped(error, seconds):
    """What a cell or a call stopped with, as the end of a sentence."""
    if isinstance(error, CellTimeout):
        return f"ran longer than {seconds:.2g} s and was stopped"
    if isinstance(error, MemoryError):
        return "needed more memory than there is for a notebook"
    text, _ = limited(0.2, _message_of, error)  # a student's own error may do anything here
    said = f"stopped with {kind_of(error)}"
    return f"{said}: {text}" if text else said


def _message_of(error):
    return str(error)[:200]


def kind_of(error):
    """The name of an error's class; a class that was given a name of other signs has none."""
    name = type(error).__name__[:80]
    return name if name.isidentifier() else "an error"


def assigned_names(source):
    """Names that a cell would set; where it is not Python, every name before an equals sign."""
    try:
        nodes = list(ast.walk(ast.parse(source)))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        assigned = re.findall(r"(\w+)[^=\w\n]*=(?!=)", source)
        defined = re.findall(r"def\s+(\w+)", source)
        return {*assigned, *defined}

    names = set()
    for node in nodes:
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
    return names
