# pyright: basic, reportAttributeAccessIssue=false, reportArgumentType=false, reportOptionalSubscript=false
"""Runs inside the student's process: one self-contained file, started by path with -I, importing nothing of ours.

Standard input is the request; the file descriptor named on the command line takes frames: eight bytes of length, then
JSON with every asked variable as it stands, and whether this was the last cell. A frame follows every cell, so that a
process that has to be killed in a later cell has still handed over the earlier answers.
"""

import ast
import builtins
import ctypes
import io
import json
import os
import re
import signal
import sys
import types
import warnings

MAX_ELEMENTS, MAX_TEXT, MAX_OUTPUT = 4096, 400, 1 << 16
HARMLESS_MAGICS = {"matplotlib", "load_ext", "autoreload", "config", "precision", "pylab", "pip", "conda", "reset"}
TIMING_MAGICS = {"time", "timeit"}


class CellTimeout(BaseException):
    """Not an Exception, so that a student's `except Exception` does not swallow it."""


class Capped(io.TextIOBase):
    """Output that is accepted and forgotten, up to a limit."""

    def __init__(self):
        self.left = MAX_OUTPUT

    def writable(self):
        return True

    def write(self, text):
        self.left = max(0, self.left - len(text))
        return len(text)


class Shell:
    """What get_ipython() returns: harmless magics and shell lines do nothing, other magics are refused."""

    def __init__(self, run):
        self.run = run

    def run_line_magic(self, name, line, *_args, **_kwargs):
        if name in HARMLESS_MAGICS:
            return None
        if name in TIMING_MAGICS:
            return self.run(line)
        raise NameError(f"the magic %{name} is not run when a sheet is marked")

    def run_cell_magic(self, name, _line, cell):
        if name in ("time", "timeit", "capture"):
            return self.run(cell)
        raise NameError(f"the magic %%{name} is not run when a sheet is marked")

    def system(self, _command):
        """A shell line, such as an installation, is passed over; what depends on it says so by itself."""

    getoutput = system


def code_cells(text):
    notebook = json.loads(text)
    cells = notebook.get("cells") if isinstance(notebook, dict) else None
    if cells is None and isinstance(notebook, dict):  # nbformat 3
        cells = [cell for sheet in notebook.get("worksheets", []) for cell in sheet.get("cells", [])]
    if not isinstance(cells, list):
        raise ValueError("it has no cells")  # noqa: TRY004 - bad content, not a bad call
    sources = (
        cell.get("source", cell.get("input", ""))
        for cell in cells
        if isinstance(cell, dict) and cell.get("cell_type") == "code"
    )
    return ["".join(source) if isinstance(source, list) else str(source) for source in sources]


def transformer():
    """IPython's own reading of a cell; without IPython, cells are plain Python."""
    try:
        from IPython.core.inputtransformer2 import TransformerManager
    except ImportError:
        return lambda source: source
    return TransformerManager().transform_cell


def needs_transforming(source):
    return re.search(r"^\s*[%!?]|\?\s*$|=\s*[%!]", source, re.MULTILINE) is not None


def encode(value):
    """A value as data: numbers, nested text, or the reason why it is neither."""
    import numpy as np

    if value is ...:
        return {"k": "missing", "v": ""}
    if hasattr(value, "tolist") and hasattr(value, "free_symbols"):  # a sympy matrix
        value = value.tolist()
    if type(value).__module__ == "numpy" and getattr(value, "dtype", None) is not None and value.dtype.kind in "OUS":
        value = value.tolist()  # an array of formulas
    if isinstance(value, str) or holds_text(value):
        return {"k": "text", "v": plain_text(value)}
    try:
        array = as_array(np, value)
    except BaseException as error:
        return {"k": "error", "v": f"not a matrix of numbers: {describe(value)} ({type(error).__name__})"}
    if array.size > MAX_ELEMENTS or array.ndim > 4:
        return {"k": "error", "v": f"too large: an array of shape {array.shape}"}
    if array.dtype.kind not in "iufc":
        return {"k": "error", "v": f"not a matrix of numbers: {describe(value)}"}
    flat = array.astype(complex).ravel()
    imaginary = [float(x) for x in flat.imag] if array.dtype.kind == "c" else []
    real = [float(x) for x in flat.real]
    return {"k": "num", "v": {"shape": [int(n) for n in array.shape], "re": real, "im": imaginary}}


def as_array(np, value):
    array = np.asarray(value)
    if array.dtype.kind == "O":  # sympy numbers, fractions, lists of arrays
        array = np.array([complex(x) for x in array.ravel()]).reshape(array.shape)
        if not array.imag.any():
            array = array.real
    return array


def describe(value):
    kind = type(value).__name__
    return {"dict": "a dict", "function": "a function", "NoneType": "None", "set": "a set"}.get(
        kind, f"a value of type {kind}"
    )[:80]


def holds_text(value, depth=3):
    if getattr(value, "free_symbols", None):  # a sympy expression is read as its text
        return True
    if not isinstance(value, (list, tuple)) or depth == 0 or len(value) > MAX_ELEMENTS:
        return False
    return any(isinstance(x, str) or holds_text(x, depth - 1) for x in value)


def plain_text(value, depth=2):
    """Nested lists of strings; numbers as their shortest exact text, everything else as str() clipped."""
    if isinstance(value, (list, tuple)) and depth:
        return [plain_text(x, depth - 1) for x in value[:64]]
    if isinstance(value, (int, float)) or hasattr(value, "dtype"):
        return repr(float(value))
    return str(value)[:MAX_TEXT]


def assigned_names(source):
    """Names that a cell would set; where it is not Python, every name before an equals sign."""
    try:
        nodes = list(ast.walk(ast.parse(source)))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set(re.findall(r"(\w+)[^=\w\n]*=(?!=)", source)) | set(re.findall(r"def\s+(\w+)", source))
    stored = {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    return stored | {node.name for node in nodes if isinstance(node, (ast.FunctionDef, ast.ClassDef))}


def snapshot(names, scope, failures, seconds):
    """Every asked variable as data; a missing or untouched one carries the error of the cell that should set it."""
    values = {}
    for name in names:
        value, error = limited(lambda name=name: encode(scope.get(name, ...)), seconds)
        if error or value is None:
            value = {"k": "error", "v": f"could not be read ({type(error).__name__})"}
        if name in failures:
            lost = value["k"] in ("missing", "error")
            value = {"k": "error", "v": failures[name]} if lost else dict(value, note=failures[name])
        values[name] = value
    return values


def limited(action, seconds):
    """What an action returns and what it raised, under an alarm that rings again against a bare except."""
    try:
        signal.setitimer(signal.ITIMER_PROF, seconds, 0.2)  # processor time: a busy machine is no loop
        signal.setitimer(signal.ITIMER_REAL, 3 * seconds, 0.2)  # for a cell that waits
        try:
            return action(), None
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.setitimer(signal.ITIMER_REAL, 0)
    except BaseException as error:
        return None, error


def run_cell(source, scope, transform):
    code = transform(source) if needs_transforming(source) else source
    exec(compile(ast.parse(code), "<cell>", "exec"), scope)


def failure(number, error, seconds):
    if isinstance(error, CellTimeout):
        return f"cell {number} ran longer than {seconds:g} s and was stopped"
    if isinstance(error, SyntaxError):
        return f"cell {number} is not Python: {error.msg} (line {error.lineno})"
    if isinstance(error, MemoryError):
        return f"cell {number} needed more memory than there is for a notebook"
    return f"cell {number} stopped with {type(error).__name__}: {str(error)[:200]}"


def not_json(text, error):
    start = text.lstrip()[:1]
    return "it is empty" if not start else "it is a web page" if start == "<" else str(error)[:100]


def run(request, write):
    names, seconds = request["asks"], request["cell_seconds"]
    try:
        cells = code_cells(request["notebook"])
    except (ValueError, TypeError, AttributeError, RecursionError) as error:
        reason = f"the file is not a notebook: {not_json(request['notebook'], error)}"
        return write({"done": True, "values": {name: {"k": "error", "v": reason} for name in names}})
    module = types.ModuleType("__main__")
    sys.modules["__main__"] = module
    sys.modules["kinegrade"] = None  # the reference engine is no way to answer the sheet
    scope, transform, failures = module.__dict__, transformer(), {}
    scope.update(__builtins__=builtins, display=print)
    first = ""
    scope["np"] = sys.modules["numpy"]  # a sheet's first cell imports it; one failing line beside it costs no answers
    write({"done": not cells, "values": {name: {"k": "missing", "v": ""} for name in names}})
    shell = Shell(lambda source: run_cell(source, scope, transform))
    scope["get_ipython"] = lambda: shell
    for number, source in enumerate(cells, 1):
        _, error = limited(lambda source=source: run_cell(source, scope, transform), seconds)
        if error:
            said = failure(number, error, seconds)
            if isinstance(error, NameError) and first:
                said += f"; before that, {first}"
            first = first or said
            touched = assigned_names(source)
            failures |= {name: said[:MAX_TEXT] for name in names if name in touched}
        else:
            for name in assigned_names(source) & failures.keys():
                del failures[name]
        write({"done": number == len(cells), "values": snapshot(names, scope, failures, seconds)})
    return None


def alarm(*_):
    raise CellTimeout


def main():
    fd = int(sys.argv[1])
    request = json.load(sys.stdin)
    import numpy  # noqa: F401, ICN001 - before any alarm: the first import of a busy machine is no loop of a student

    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: no notebook outlives the grader
    for bell in (signal.SIGALRM, signal.SIGPROF):
        signal.signal(bell, alarm)
    warnings.simplefilter("ignore")
    sys.stdin = io.StringIO()
    sys.stdout = sys.stderr = Capped()
    # Bound here, so that a notebook that replaces os.write or json.dumps still hands over its answers.
    write_bytes, dumps = os.write, json.dumps

    def write(frame):
        text = dumps(frame).encode()
        data = len(text).to_bytes(8, "little") + text
        while data:
            data = data[write_bytes(fd, data) :]

    run(request, write)


main()
