# pyright: basic, reportAttributeAccessIssue=false
# pyright: reportArgumentType=false, reportOptionalSubscript=false
"""Runs inside the student's process: one self-contained file, started by path with -I.

It imports nothing of ours. Standard input is the request; the file descriptor named on the command
line takes frames: eight bytes of length, then JSON with every asked variable as it stands, and
whether this was the last cell. A frame follows every cell and every call of an asked function, so
that a process that has to be killed later has still handed over the earlier answers.

A value is a dict as wire.py checks it: its kind "k" (num, text, calls, missing or error), what it
holds "v", and a "note" where its cell failed.
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
MAX_SAID = 400
MAX_TEXT = 20_000
MAX_CALLS = 200
# Of this file alone:
MAX_OUTPUT = 1 << 16
MAX_FRAME = 1_900_000
DUMPS = json.dumps  # bound here, so that a notebook that replaces it still hands over its answers
PENDING = {"k": "missing", "v": ""}
REAL_KINDS = ("b", "i", "u", "f")  # of numpy's types
LOGICAL = ("And", "Or")  # sympy's
IN_PLACE = "simplify() of a Matrix changes it in place and returns nothing"
NAMED_TYPES = {"dict": "a dict", "function": "a function", "NoneType": "None", "set": "a set"}

HARMLESS_MAGICS = {
    "matplotlib", "pylab", "precision", "load_ext", "autoreload", "config", "reset", "pip", "conda",
    "check",
}  # fmt: skip
TIMING_MAGICS = {"time", "timeit"}
IPYTHON_LINE = re.compile(r"^\s*[%!?]|\?\s*$|=\s*[%!]", re.MULTILINE)


class CellTimeout(BaseException):
    """Not an Exception, so that a student's `except Exception` does not swallow it."""


class TooLong(ValueError):
    """An answer with more text than is read."""


class Capped(io.TextIOBase):
    """Output that is accepted and forgotten, up to a limit."""

    def __init__(self):
        self.left = MAX_OUTPUT

    def writable(self):
        """Yes, whatever is printed."""
        return True

    def write(self, text):
        """Forgets the text."""
        self.left = max(0, self.left - len(text))
        return len(text)


class Shell:
    """What get_ipython() returns: harmless magics and shell lines do nothing."""

    def __init__(self, run):
        self.run = run

    def run_line_magic(self, name, line, *_args, **_kwargs):
        """Runs the code behind %time; NameError for magics that could set answers."""
        if name in HARMLESS_MAGICS:
            return None
        if name in TIMING_MAGICS:
            return self.run(line)
        raise NameError(f"the magic %{name} is not run when a sheet is marked")

    def run_cell_magic(self, name, _line, cell):
        """Runs the cell under %%time; NameError for magics that could set answers."""
        if name in ("time", "timeit", "capture"):
            return self.run(cell)
        raise NameError(f"the magic %%{name} is not run when a sheet is marked")

    def system(self, _command):
        """A shell line, such as an installation, is passed over; what depends on it says so."""

    getoutput = system


def code_cells(text):
    """Sources of the code cells; ValueError, TypeError or AttributeError where there are none."""
    sources = []
    for cell in cells_of(json.loads(text)):
        if isinstance(cell, dict) and cell.get("cell_type") == "code":
            source = cell.get("source", cell.get("input", ""))
            sources.append("".join(source) if isinstance(source, list) else str(source))
    return sources


def cells_of(notebook):
    """All cells of a notebook of any format."""
    if not isinstance(notebook, dict):
        raise ValueError("it has no cells")  # noqa: TRY004 - bad content, not a bad call
    cells = notebook.get("cells")
    if cells is None:  # nbformat 3
        cells = []
        for sheet in notebook.get("worksheets", []):
            cells += sheet.get("cells", [])
    if not isinstance(cells, list):
        raise ValueError("it has no cells")  # noqa: TRY004
    return cells


def not_json(text, error):
    """Why a file is no notebook, in words that say what it looks like instead."""
    start = text.lstrip()[:1]
    if not start:
        return "it is empty"
    if start == "<":
        return "it is a web page"
    return str(error)[:100]


def transformer():
    """IPython's own reading of a cell; without IPython, cells are plain Python."""
    try:
        from IPython.core.inputtransformer2 import TransformerManager
    except ImportError:
        return lambda source: source
    return TransformerManager().transform_cell


def run_cell(source, scope, transform):
    """Runs a cell in the student's module; raises what it raises."""
    code = transform(source) if IPYTHON_LINE.search(source) else source
    exec(compile(ast.parse(code), "<cell>", "exec"), scope)


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


def failed(why):
    """The value of a variable that has none."""
    return {"k": "error", "v": why}


def encode(value):
    """A value as data: numbers, nested text, or the reason why it is neither."""
    if value is ...:
        return PENDING
    value = without_matrices(value)
    if is_array_of_objects(value):  # of formulas, or of strings
        value = value.tolist()
    if isinstance(value, (set, frozenset)) and holds_text(list(value)):
        value = sorted(entry(item) for item in value)

    if isinstance(value, str) or holds_text(value):
        return text_of(value)
    return numbers_of(value)


def without_matrices(value):
    """A sympy matrix, or a list of them, as nested lists."""
    if hasattr(value, "tolist") and hasattr(value, "free_symbols"):
        return value.tolist()
    if isinstance(value, (list, tuple)) and len(value) <= MAX_ROWS:
        return [without_matrices(item) for item in value]
    return value


def is_array_of_objects(value):
    """Whether it is a numpy array of what is no number to numpy."""
    if type(value).__module__ != "numpy":
        return False
    dtype = getattr(value, "dtype", None)
    return dtype is not None and dtype.kind in "OUS"


def numbers_of(value):
    """An array as data; an error where it is none."""
    import numpy as np

    if value is None:
        return failed(f"not a matrix of numbers: None; {IN_PLACE}")
    try:
        array = as_array(np, value)
    except BaseException as error:
        why = f"not a matrix of numbers: {describe(value)} ({type(error).__name__})"
        return failed(why)
    if array.size > MAX_ELEMENTS or array.ndim > 4:
        return failed(f"too large: an array of shape {array.shape}")
    if array.dtype.kind not in "iufc":
        return failed(f"not a matrix of numbers: {describe(value)}")

    flat = array.astype(complex).ravel()
    imaginary = flat.imag.tolist() if array.dtype.kind == "c" else []
    shape = [int(length) for length in array.shape]
    return {"k": "num", "v": {"shape": shape, "re": flat.real.tolist(), "im": imaginary}}


def as_array(np, value):
    """The array of a value: real where nothing is imaginary in sympy numbers and fractions."""
    array = np.asarray(value)
    if array.dtype.kind == "O":  # sympy numbers, fractions, lists of arrays
        array = np.array([complex(item) for item in array.ravel()]).reshape(array.shape)
        if not array.imag.any():
            array = array.real
    return array


def describe(value):
    """What a value is, in a few words."""
    kind = type(value).__name__
    return NAMED_TYPES.get(kind, f"a value of type {kind}")[:80]


def holds_text(value, depth=3):
    """Whether text or a formula is in a value; a sympy expression is read as its text."""
    if getattr(value, "free_symbols", None) or is_solution(value):
        return True
    if not isinstance(value, (list, tuple)) or depth == 0 or len(value) > MAX_ELEMENTS:
        return False
    return any(isinstance(item, str) or holds_text(item, depth - 1) for item in value)


def is_solution(value):
    """Whether it is what sympy's solve returns: a dict with a value for every unknown."""
    if not isinstance(value, dict) or not value:
        return False
    return all(getattr(name, "free_symbols", None) for name in value)


def text_of(value):
    """Nested text as data; an error where it is too long."""
    try:
        return {"k": "text", "v": plain_text(value)}
    except TooLong as error:
        return failed(str(error))


def plain_text(value, depth=3):
    """Nested lists of strings; what is left of a formula that was cut off could be another one."""
    if isinstance(value, (list, tuple)) and depth:
        if len(value) > MAX_ROWS:
            entries = f"a list of {len(value)} entries"
            raise TooLong(f"too long: {entries}; an answer may have {MAX_ROWS}")
        return [plain_text(item, depth - 1) for item in value]

    text = entry(value)
    if len(text) > MAX_TEXT:
        raise TooLong(f"too long: a text of {len(text)} characters; {MAX_TEXT} can be read here")
    return text


def entry(value):
    """Text of one entry: numbers as their shortest exact text, sympy's equations as a = b."""
    if isinstance(value, str):
        return str(value)
    if is_real(value):
        return repr(float(value))
    if getattr(value, "rel_op", "") == "==":
        return f"{value.lhs} = {value.rhs}"
    if type(value).__name__ in LOGICAL and hasattr(value, "args"):
        return listing(value)
    if is_solution(value):
        return " and ".join([f"{name} = {entry(value[name])}" for name in value])
    if hasattr(value, "xreplace"):
        value = without_dust(value)
    return str(value)


def is_real(value):
    """Whether it is a real number of Python or numpy."""
    if isinstance(value, (int, float)):
        return True
    dtype = getattr(value, "dtype", None)
    return getattr(dtype, "kind", None) in REAL_KINDS


def listing(value):
    """sympy's And and Or of equations, in brackets where they stand in one another."""
    texts = []
    for part in value.args:
        text = entry(part)
        if type(part).__name__ in LOGICAL:
            text = f"({text})"
        texts.append(text)
    word = type(value).__name__.lower()
    return f" {word} ".join(texts)


def without_dust(value):
    """A sympy expression where np.pi / 2 left 6e-17 in the place of a zero."""
    dust = [number for number in value.atoms() if is_dust(number)]
    return value.xreplace(dict.fromkeys(dust, 0)) if dust else value


def is_dust(number):
    """Whether it is what rounding leaves of a zero."""
    return getattr(number, "is_Float", False) and abs(number) < 1e-12


def encode_asked(value, calls):
    """A value as data; results of calls may be listed, one of another shape than the next."""
    whole = encode(value)
    if whole["k"] != "error" or not calls:
        return whole
    if not isinstance(value, (list, tuple)) or len(value) > MAX_CALLS:
        return whole

    results = [encode(result) for result in value]
    if all(result["k"] == "error" for result in results):
        return whole
    return {"k": "calls", "v": results, "listed": True}


def encode_result(value):
    """A result of a call, where True and False are 1 and 0: a function may say yes or no."""
    import numpy as np

    try:
        yes_or_no = np.asarray(value).dtype.kind == "b"
    except Exception:
        yes_or_no = False
    if yes_or_no:
        value = np.asarray(value, dtype=float)
    return encode(value)


class Functions:
    """Asked functions and the results of their calls, by name.

    A result is kept until another function has the name.
    """

    def __init__(self, calls, scope, seconds):
        self.calls = calls
        self.scope = scope
        self.seconds = seconds
        self.called = {}  # the function that was called under each name
        self.results = {}
        self.slow = set()

    def due(self, *, last):
        """Names that hold a function that was not called yet; after the last cell, all with one."""
        names = []
        for name in self.calls:
            function = self.scope.get(name)
            if callable(function) and (last or self.called.get(name) is not function):
                names.append(name)
        return names

    def value(self, name):
        """The results as data, those that are still to come included."""
        pending = [PENDING] * len(self.calls[name])
        return {"k": "calls", "v": self.results.get(name) or pending}

    def call(self, name):
        """Calls a function on everything that is asked, pausing after each result.

        A result of an earlier round stays where a call now fails.
        """
        function = self.scope[name]
        calls = self.calls[name]
        if self.called.get(name) is not function:
            self.called[name] = function
            self.results[name] = [PENDING] * len(calls)
            self.slow.discard(name)

        results = self.results[name]
        for i, arguments in enumerate(calls):
            result = self.result(name, i + 1, arguments)
            if result["k"] != "error" or results[i]["k"] in ("missing", "error"):
                results[i] = result
            yield

    def result(self, name, number, arguments):
        """Result of one call as data.

        After the first call that runs out of time, all others share as much again: forty loops cost
        no more than two.
        """
        seconds = self.seconds
        if name in self.slow:
            seconds /= len(self.calls[name])
        result, error = limited(max(seconds, 0.01), result_of, self.called[name], arguments)

        if isinstance(error, CellTimeout):
            self.slow.add(name)
        if error:
            return failed(f"call {number} {stopped(error, seconds)}"[:MAX_SAID])
        if result["k"] == "error":
            return failed(f"call {number}: {result['v']}"[:MAX_SAID])
        if result["k"] == "missing":
            return failed(f"call {number} returned ...")
        return result


def result_of(function, arguments):
    """Result of a function as data; its arguments are its own, for it may change them."""
    import numpy as np

    fresh = [arrived(np, argument) for argument in arguments]
    return encode_result(function(*fresh))


def arrived(np, argument):
    """As in exercises/kinds/arguments.py: lists of numbers in equal rows are arrays."""
    if isinstance(argument, dict):
        return {name: arrived(np, value) for name, value in argument.items()}
    if not isinstance(argument, list):
        return argument
    if shape_of(argument) is not None:
        return np.array(argument, dtype=float)
    return [arrived(np, item) for item in argument]


def shape_of(value):
    """Shape of nested numbers; None where they are no array."""
    if isinstance(value, (int, float)):
        return ()
    if not isinstance(value, list):
        return None

    shapes = {shape_of(item) for item in value}
    if not shapes:
        return (0,)
    first = shapes.pop()
    if shapes or first is None:
        return None
    return (len(value), *first)


class Reader:
    """Reads the asked variables, and does not try again what could not be read in its time."""

    def __init__(self, names, functions, seconds):
        self.names = names
        self.functions = functions
        self.seconds = seconds
        self.slow = {}

    def snapshot(self, failures):
        """Every asked variable as data; a missing one carries the error of the cell to set it."""
        return {name: noted(self.read(name), failures.get(name)) for name in self.names}

    def read(self, name):
        """One variable as data."""
        value = self.functions.scope.get(name, ...)
        calls = self.functions.calls.get(name)
        if calls and callable(value):
            return self.functions.value(name)
        if name in self.slow and self.slow[name] is value:
            return self.too_slow()

        found, error = limited(self.seconds, encode_asked, value, calls)
        if isinstance(error, CellTimeout):
            self.slow[name] = value
            return self.too_slow()
        if error or found is None:
            return failed(f"could not be read ({kind_of(error)})")
        return found

    def too_slow(self):
        """The value of a variable that took too long to read, such as a formula without end."""
        return failed(f"could not be read (it took longer than {self.seconds:g} s)")


def noted(value, failure):
    """A value with what its cell stopped with, which is all there is to say where it is missing."""
    if failure is None:
        return value
    if value["k"] in ("missing", "error"):
        return failed(failure)
    return dict(value, note=failure)


class Failures:
    """What cells stopped with, by the asked names that they should set."""

    def __init__(self, names, seconds):
        self.names = names
        self.seconds = seconds
        self.first = ""
        self.by_name = {}

    def add(self, number, source, error):
        """Keeps the error of a cell; where a name is missing, the first error may be the reason."""
        said = failure(number, error, self.seconds)
        if isinstance(error, NameError) and self.first:
            said += f"; before that, {self.first}"
        self.first = self.first or said

        touched = assigned_names(source)
        for name in self.names:
            if name in touched:
                self.by_name[name] = said[:MAX_SAID]

    def forget(self, source):
        """Drops the errors of what a cell has now set."""
        for name in assigned_names(source):
            self.by_name.pop(name, None)


def hand_over(write, reader, failures, *, last):
    """A frame with every value as it stands, and one more after every call that is due."""
    functions = reader.functions
    values = reader.snapshot(failures)
    due = functions.due(last=last)
    write({"done": last and not due, "values": fitting(values)})

    for name in due:
        for _ in functions.call(name):
            values[name] = noted(functions.value(name), failures.get(name))
            write({"done": False, "values": fitting(values)})
    if last and due:
        write({"done": True, "values": fitting(values)})


def fitting(values):
    """As many values as one frame can hold, the largest left out first."""
    sizes = {name: len(DUMPS(value)) for name, value in values.items()}
    while sum(sizes.values()) > MAX_FRAME:
        largest = max(sizes, key=sizes.__getitem__)
        values[largest] = failed("too large to be marked together with the other answers")
        sizes[largest] = len(DUMPS(values[largest]))
    return values


def limited(seconds, action, *arguments):
    """What an action returned and what it raised, under an alarm that rings again.

    A bare except could swallow it once.
    """
    try:
        # Processor time, for a busy machine is no loop; on the clock, for a cell that waits.
        signal.setitimer(signal.ITIMER_PROF, seconds, 0.2)
        signal.setitimer(signal.ITIMER_REAL, 3 * seconds, 0.2)
        try:
            result = action(*arguments), None
        finally:
            silence()
    except BaseException as error:
        result = None, error
    silence()  # again, where an alarm rang while the first was at it
    return result


def silence():
    """Stops both alarms."""
    signal.setitimer(signal.ITIMER_PROF, 0)
    signal.setitimer(signal.ITIMER_REAL, 0)


def alarm(*_):
    """What both alarms do."""
    raise CellTimeout


def failure(number, error, seconds):
    """What a cell stopped with, in a sentence."""
    if isinstance(error, SyntaxError):
        return f"cell {number} is not Python: {error.msg} (line {error.lineno})"
    return f"cell {number} {stopped(error, seconds)}"


def stopped(error, seconds):
    """What a cell or a call stopped with, as the end of a sentence."""
    if isinstance(error, CellTimeout):
        return f"ran longer than {seconds:.2g} s and was stopped"
    if isinstance(error, MemoryError):
        return "needed more memory than there is for a notebook"
    text, _ = limited(0.2, message_of, error)  # a student's own error may do anything here
    return f"stopped with {kind_of(error)}: {text or ''}"


def message_of(error):
    """The start of an error's message."""
    return str(error)[:200]


def kind_of(error):
    """The name of an error's class."""
    return type(error).__name__[:80]


def run(request, write):
    """Runs all cells of a notebook, with a frame before the first and after each."""
    names = request["asks"]
    seconds = request["cell_seconds"]
    try:
        cells = code_cells(request["notebook"])
    except (ValueError, TypeError, AttributeError, RecursionError) as error:
        reason = f"the file is not a notebook: {not_json(request['notebook'], error)}"
        write({"done": True, "values": {name: failed(reason) for name in names}})
        return

    scope = student_scope()
    transform = transformer()
    functions = Functions(request["calls"], scope, seconds)
    reader = Reader(names, functions, seconds)
    failures = Failures(names, seconds)
    write({"done": not cells, "values": dict.fromkeys(names, PENDING)})

    shell = Shell(lambda source: run_cell(source, scope, transform))
    scope["get_ipython"] = lambda: shell
    for number, source in enumerate(cells, 1):
        _, error = limited(seconds, run_cell, source, scope, transform)
        if error:
            failures.add(number, source, error)
        else:
            failures.forget(source)
        hand_over(write, reader, failures.by_name, last=number == len(cells))


def student_scope():
    """Names of the module in which cells run; it stands in the place of this one."""
    module = types.ModuleType("__main__")
    sys.modules["__main__"] = module
    sys.modules["kinegrade"] = None  # the reference engine is no way to answer the sheet
    scope = module.__dict__
    scope.update(__builtins__=builtins, display=print)
    # A sheet's first cell imports it; one failing line beside it costs no answers.
    scope["np"] = sys.modules["numpy"]
    return scope


def main():
    """Reads the request, makes the process fit for a notebook, and runs it."""
    fd = int(sys.argv[1])
    request = json.load(sys.stdin)
    # Before any alarm: the first import of a busy machine is no loop of a student.
    import numpy  # noqa: F401, ICN001

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
