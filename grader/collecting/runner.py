# pyright: basic, reportAttributeAccessIssue=false, reportArgumentType=false, reportOptionalSubscript=false
"""Runs inside the student's process: one self-contained file, started by path with -I, importing nothing of ours.

Standard input is the request; the file descriptor named on the command line takes frames: eight bytes of length, then
JSON with every asked variable as it stands, and whether this was the last cell. A frame follows every cell and every
call of an asked function, so that a process that has to be killed later has still handed over the earlier answers.
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

# As in wire.py and ask.py:
MAX_ELEMENTS = 4096
MAX_ROWS = 64
MAX_TEXT = 400
MAX_ANSWER = 20_000
MAX_CALLS = 200
# Of this file alone:
MAX_OUTPUT, MAX_FRAME = 1 << 16, 1_900_000
DUMPS = json.dumps  # bound here, so that a notebook that replaces it still hands over its answers
PENDING = {"k": "missing", "v": ""}
HARMLESS_MAGICS = {
    "matplotlib",
    "load_ext",
    "autoreload",
    "config",
    "precision",
    "pylab",
    "pip",
    "conda",
    "reset",
}
TIMING_MAGICS = {"time", "timeit"}


class CellTimeout(BaseException):
    """Not an Exception, so that a student's `except Exception` does not swallow it."""


class TooLong(ValueError):
    """An answer with more text than is read."""


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
        cells = [
            cell for sheet in notebook.get("worksheets", []) for cell in sheet.get("cells", [])
        ]
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
    if value is ...:
        return PENDING
    if hasattr(value, "tolist") and hasattr(value, "free_symbols"):  # a sympy matrix
        value = value.tolist()
    if (
        type(value).__module__ == "numpy"
        and getattr(value, "dtype", None) is not None
        and value.dtype.kind in "OUS"
    ):
        value = value.tolist()  # an array of formulas
    if isinstance(value, (set, frozenset)) and holds_text(list(value)):
        value = sorted(entry(x) for x in value)
    return text_of(value) if isinstance(value, str) or holds_text(value) else numbers_of(value)


def text_of(value):
    try:
        return {"k": "text", "v": plain_text(value, MAX_ANSWER)}
    except TooLong as error:
        return {"k": "error", "v": str(error)}


def numbers_of(value):
    import numpy as np

    try:
        array = as_array(np, value)
    except BaseException as error:
        return {
            "k": "error",
            "v": f"not a matrix of numbers: {describe(value)} ({type(error).__name__})",
        }
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


def plain_text(value, most, depth=2):
    """Nested lists of strings. Nothing is cut off: what is left of a formula could be another formula."""
    if isinstance(value, (list, tuple)) and depth:
        if len(value) > MAX_ROWS:
            raise TooLong(
                f"too long: a list of {len(value)} entries; an answer may have {MAX_ROWS}"
            )
        return [plain_text(x, MAX_TEXT, depth - 1) for x in value]
    text = entry(value)
    if len(text) > most:
        raise TooLong(f"too long: a text of {len(text)} characters; {most} can be read here")
    return text


def without_dust(value):
    """A sympy expression where np.pi / 2 left 6e-17 in the place of a zero."""
    dust = [
        number
        for number in value.atoms()
        if getattr(number, "is_Float", False) and abs(number) < 1e-12
    ]
    return value.xreplace(dict.fromkeys(dust, 0)) if dust else value


def entry(value):
    """Strings as they are, numbers as their shortest exact text, sympy's equations as a = b, all else as str()."""
    if isinstance(value, str):
        return str(value)
    if isinstance(value, (int, float)) or getattr(
        getattr(value, "dtype", None), "kind", None
    ) in tuple("biuf"):
        return repr(float(value))
    if getattr(value, "rel_op", "") == "==":
        return f"{value.lhs} = {value.rhs}"
    if type(value).__name__ in ("And", "Or") and hasattr(value, "args"):
        return listing(value)
    return str(without_dust(value) if hasattr(value, "xreplace") else value)


def listing(value):
    """sympy's And and Or of equations, in brackets where they stand in one another."""
    word = f" {type(value).__name__.lower()} "
    nested = [type(part).__name__ in ("And", "Or") for part in value.args]
    texts = [entry(part) for part in value.args]
    return word.join(
        f"({text})" if inside else text for text, inside in zip(texts, nested, strict=True)
    )


def encode_asked(value, calls):
    """A value; where results of calls were asked, a list of them may have one of another shape beside the next."""
    found = encode(value)
    if (
        found["k"] != "error"
        or not calls
        or not isinstance(value, (list, tuple))
        or len(value) > MAX_CALLS
    ):
        return found
    results = [encode(result) for result in value]
    if all(result["k"] == "error" for result in results):
        return found
    return {"k": "calls", "v": results, "listed": True}


def encode_result(value):
    """A result of a call, where True and False are 1 and 0: a function may say yes or no."""
    import numpy as np

    try:
        yes_or_no = np.asarray(value).dtype.kind == "b"
    except Exception:
        yes_or_no = False
    return encode(np.asarray(value, dtype=float) if yes_or_no else value)


def assigned_names(source):
    """Names that a cell would set; where it is not Python, every name before an equals sign."""
    try:
        nodes = list(ast.walk(ast.parse(source)))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set(re.findall(r"(\w+)[^=\w\n]*=(?!=)", source)) | set(
            re.findall(r"def\s+(\w+)", source)
        )
    stored = {
        node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    return stored | {
        node.name for node in nodes if isinstance(node, (ast.FunctionDef, ast.ClassDef))
    }


class Functions:
    """Asked functions and the results of their calls. A result is kept until another function has the name."""

    def __init__(self, calls, scope, seconds):
        self.calls, self.scope, self.seconds = calls, scope, seconds
        self.called, self.results, self.slow = {}, {}, set()

    def due(self, *, last):
        """Names that hold a function that was not called yet; after the last cell, all that hold one."""
        functions = [name for name in self.calls if callable(self.scope.get(name))]
        return [name for name in functions if last or self.called.get(name) is not self.scope[name]]

    def value(self, name):
        return {"k": "calls", "v": self.results.get(name) or [PENDING] * len(self.calls[name])}

    def call(self, name):
        """Calls a function on everything that is asked, pausing after each result.

        After the first call that runs out of time, all others share as much again: forty loops cost no more than two.
        A result of an earlier round stays where a call now fails.
        """
        function, calls = self.scope[name], self.calls[name]
        if self.called.get(name) is not function:
            self.called[name], self.results[name] = function, [PENDING] * len(calls)
            self.slow.discard(name)
        results = self.results[name]
        for i, arguments in enumerate(calls):
            share = self.seconds / len(calls) if name in self.slow else self.seconds
            result, error = limited(
                lambda given=arguments: encode_result(function(*fresh(given))), max(share, 0.01)
            )
            if isinstance(error, CellTimeout):
                self.slow.add(name)
            if error or result["k"] == "error":
                why = (
                    f"call {i + 1} {stopped(error, share)}"
                    if error
                    else f"call {i + 1}: {result['v']}"
                )
                result = {"k": "error", "v": why[:MAX_TEXT]}
            elif result["k"] == "missing":
                result = {"k": "error", "v": f"call {i + 1} returned ..."}
            if result["k"] != "error" or results[i]["k"] in ("missing", "error"):
                results[i] = result
            yield


def fresh(arguments):
    """Arguments of one call, its own: a function may change what it is given."""
    import numpy as np

    return [arrived(np, argument) for argument in arguments]


def arrived(np, argument):
    """As in exercises/kinds/arguments.py: lists of numbers in equal rows are arrays, in dicts and lists too."""
    if isinstance(argument, dict):
        return {name: arrived(np, value) for name, value in argument.items()}
    if not isinstance(argument, list):
        return argument
    if shape_of(argument) is not None:
        return np.array(argument, dtype=float)
    return [arrived(np, item) for item in argument]


def shape_of(value):
    """Shape of nested numbers; None where they are no array."""
    if not isinstance(value, list):
        return () if isinstance(value, (int, float)) else None
    shapes = {shape_of(item) for item in value}
    if not shapes:
        return (0,)
    first = shapes.pop()
    return None if shapes or first is None else (len(value), *first)


class Reader:
    """Reads the asked variables, and does not try again what could not be read in its time."""

    def __init__(self, names, functions, seconds):
        self.names, self.functions, self.seconds, self.slow = names, functions, seconds, {}

    def snapshot(self, failures):
        """Every asked variable as data; a missing or untouched one carries the error of the cell that should set it."""
        return {name: self.noted(self.read(name), failures.get(name)) for name in self.names}

    def read(self, name):
        value, calls = self.functions.scope.get(name, ...), self.functions.calls.get(name)
        if calls and callable(value):
            return self.functions.value(name)
        if name in self.slow and self.slow[name] is value:
            return self.unread(f"it took longer than {self.seconds:g} s")
        found, error = limited(lambda: encode_asked(value, calls), self.seconds)
        if isinstance(error, CellTimeout):
            self.slow[name] = value
            return self.unread(f"it took longer than {self.seconds:g} s")
        return self.unread(kind_of(error)) if error or found is None else found

    @staticmethod
    def unread(why):
        return {"k": "error", "v": f"could not be read ({why})"}

    @staticmethod
    def noted(value, failure):
        if failure is None:
            return value
        return (
            {"k": "error", "v": failure}
            if value["k"] in ("missing", "error")
            else dict(value, note=failure)
        )


def limited(action, seconds):
    """What an action returned and what it raised, under an alarm that rings again against a bare except."""
    try:
        signal.setitimer(
            signal.ITIMER_PROF, seconds, 0.2
        )  # processor time: a busy machine is no loop
        signal.setitimer(signal.ITIMER_REAL, 3 * seconds, 0.2)  # for a cell that waits
        try:
            result = action(), None
        finally:
            silence()
    except BaseException as error:
        result = None, error
    silence()  # again, where an alarm rang while the first was at it
    return result


def silence():
    signal.setitimer(signal.ITIMER_PROF, 0)
    signal.setitimer(signal.ITIMER_REAL, 0)


def run_cell(source, scope, transform):
    code = transform(source) if needs_transforming(source) else source
    exec(compile(ast.parse(code), "<cell>", "exec"), scope)


def failure(number, error, seconds):
    if isinstance(error, SyntaxError):
        return f"cell {number} is not Python: {error.msg} (line {error.lineno})"
    return f"cell {number} {stopped(error, seconds)}"


def stopped(error, seconds):
    if isinstance(error, CellTimeout):
        return f"ran longer than {seconds:.2g} s and was stopped"
    if isinstance(error, MemoryError):
        return "needed more memory than there is for a notebook"
    text, _ = limited(lambda: str(error)[:200], 0.2)  # a student's own error may do anything here
    return f"stopped with {kind_of(error)}: {text or ''}"


def kind_of(error):
    return type(error).__name__[:80]


def not_json(text, error):
    start = text.lstrip()[:1]
    return "it is empty" if not start else "it is a web page" if start == "<" else str(error)[:100]


def run(request, write):
    names, seconds = request["asks"], request["cell_seconds"]
    try:
        cells = code_cells(request["notebook"])
    except (ValueError, TypeError, AttributeError, RecursionError) as error:
        reason = f"the file is not a notebook: {not_json(request['notebook'], error)}"
        return write(
            {"done": True, "values": {name: {"k": "error", "v": reason} for name in names}}
        )
    module = types.ModuleType("__main__")
    sys.modules["__main__"] = module
    sys.modules["kinegrade"] = None  # the reference engine is no way to answer the sheet
    scope, transform, failures = module.__dict__, transformer(), {}
    scope.update(__builtins__=builtins, display=print)
    first = ""
    scope["np"] = sys.modules[
        "numpy"
    ]  # a sheet's first cell imports it; one failing line beside it costs no answers
    functions = Functions(request["calls"], scope, seconds)
    reader = Reader(names, functions, seconds)
    write({"done": not cells, "values": dict.fromkeys(names, PENDING)})
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
        hand_over(write, reader, failures, last=number == len(cells))
    return None


def hand_over(write, reader, failures, *, last):
    """A frame with every value as it stands, and one more after every call that is due."""
    functions = reader.functions
    values, due = reader.snapshot(failures), functions.due(last=last)
    write({"done": last and not due, "values": fitting(values)})
    for name in due:
        for _ in functions.call(name):
            values[name] = reader.noted(functions.value(name), failures.get(name))
            write({"done": False, "values": fitting(values)})
    if last and due:
        write({"done": True, "values": fitting(values)})


def fitting(values):
    """As many values as one frame can hold, the largest left out first."""
    sizes = {name: len(DUMPS(value)) for name, value in values.items()}
    while sum(sizes.values()) > MAX_FRAME:
        name = max(sizes, key=lambda name: sizes[name])
        values[name] = {"k": "error", "v": "too large to be marked together with the other answers"}
        sizes[name] = len(DUMPS(values[name]))
    return values


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
    write_bytes = os.write  # bound here for the same reason as DUMPS

    def write(frame):
        text = DUMPS(frame).encode()
        data = len(text).to_bytes(8, "little") + text
        while data:
            data = data[write_bytes(fd, data) :]

    run(request, write)


main()
