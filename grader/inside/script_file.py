"""A .py file as cells: its `# %%` blocks, else one statement after another."""

import ast
import codecs
import io
import re
import tokenize

from .failures import line_of
from .limits import MAX_CODE
from .notebook_file import NotANotebookError

MARK = re.compile(r"# ?%%(?!%)(?P<kind>.*)")
PROSE = re.compile(r"\[(markdown|md|raw)\]")
START = re.compile(r"[^\s#)\]}]")  # of a line that may begin a statement
COMMENTED = re.compile(r"^[^\S\n]*#+[^\S\n]*(\w+)[^\S\n]*=(?!=)", re.MULTILINE)
GOES_ON = re.compile(r"(elif|else|except|finally)\b")
MAX_BROKEN = 20  # statements that are no Python, after which the rest is one of them


class Script:
    """The sources of a script's cells in order, and the line of the file in which each begins."""

    def __init__(self, code, lines, text):
        self.code = code
        self.lines = lines
        self.inside = _set_inside(code)
        self.commented = set(COMMENTED.findall(text))

    def where(self, index, error):
        """The line of the file in which a cell stopped."""
        return f"line {self.lines[index] + line_of(error) - 1}"

    def hint(self, name):
        """Why a name may be missing that stands in the file all the same; empty where it is not."""
        if name in self.inside:
            return (
                f"{name} is set inside of the function {self.inside[name]}, where it is not seen; "
                "an answer is a variable of the file itself"
            )
        if name in self.commented:
            return f"a comment assigns {name}; comments are not run"
        if not self.code:
            return "the file has no code"
        return ""


def read_script(data):
    """The cells of a .py file.

    With `# %%` lines, they are what stands between those, as in Jupytext, Spyder and Visual Studio
    Code. Without, every statement is a cell, so that one that fails costs only what it sets.

    Raises:
        NotANotebookError: it is no text, or has more code than anybody types.
    """
    try:
        text = data.removeprefix(codecs.BOM_UTF8).decode("utf-8")
    except UnicodeDecodeError:
        raise NotANotebookError("the file is not Python: it is not UTF-8 text") from None
    if "\0" in text:
        raise NotANotebookError("the file is not Python: it holds null characters")
    if len(text) > MAX_CODE:
        most = f"a file may have {MAX_CODE >> 20} million"
        raise NotANotebookError(f"it holds {len(text) >> 20} million characters; {most}")

    lines = io.StringIO(text, newline=None).read().split("\n")
    marks = _marks(lines)
    chunks = _blocks(lines, marks) if marks else _statements(lines)
    cells = [(first, "\n".join(lines[first:last])) for first, last in chunks]
    code = [source for _, source in cells]
    return Script(code, [first + 1 for first, _ in cells], text)


def _marks(lines):
    """Numbers of the lines that begin a block; those within a text in quotes do not."""
    wanted = [number for number, line in enumerate(lines) if MARK.match(line)]
    if not wanted:
        return []
    comments = set()
    try:
        for token in tokenize.generate_tokens(io.StringIO("\n".join(lines)).readline):
            if token.type == tokenize.COMMENT:
                comments.add(token.start[0] - 1)
    except (tokenize.TokenError, SyntaxError):
        return wanted
    return [number for number in wanted if number in comments]


def _blocks(lines, marks):
    """First line and the one behind the last of every block of code."""
    starts = [0, *marks]
    ends = [*marks, len(lines)]
    for first, last in zip(starts, ends, strict=True):
        mark = MARK.match(lines[first])
        if mark and PROSE.search(mark["kind"]):
            continue
        if any(START.match(line.lstrip()) for line in lines[first:last]):
            yield first, last


def _statements(lines):
    """First line and the one behind the last of every statement.

    One that is no Python is a cell as well, which says so; what comes behind it is read on.
    """
    start = 0
    for _ in range(MAX_BROKEN):
        try:
            body = _parsed(lines[start:])
        except SyntaxError as error:
            broken, behind = _around(lines, start, start + (error.lineno or 1) - 1)
            yield from _whole(lines, start, broken)
            yield broken, behind
            start = behind
        else:
            yield from _spans(body, start)
            return
    if start < len(lines):
        yield start, len(lines)


def _parsed(lines):
    """The statements of some lines; SyntaxError also where they are nested too deeply."""
    try:
        return ast.parse("\n".join(lines)).body
    except (ValueError, RecursionError, MemoryError) as error:
        raise SyntaxError(str(error)) from None


def _around(lines, start, place):
    """The lines from and to which a statement goes that is no Python at a place."""
    place = min(place, len(lines) - 1)
    behind = place + 1
    while behind < len(lines) and not _begins(lines[behind]):
        behind += 1
    first = place
    while first > start and not (_begins(lines[first]) and _is_python(lines[start:first])):
        first -= 1
    return first, behind


def _begins(line):
    return bool(START.match(line)) and not GOES_ON.match(line)


def _is_python(lines):
    try:
        _parsed(lines)
    except SyntaxError:
        return False
    return True


def _whole(lines, first, last):
    """The statements between two lines, which are Python."""
    if first < last and _is_python(lines[first:last]):
        yield from _spans(_parsed(lines[first:last]), first)


def _spans(body, start):
    """Lines of statements; those that share a line are one cell."""
    behind = 0
    first = None
    for statement in body:
        lines = [statement.lineno, *[one.lineno for one in _decorators(statement)]]
        if first is None or min(lines) > behind:
            if first is not None:
                yield start + first - 1, start + behind
            first = min(lines)
        behind = statement.end_lineno
    if first is not None:
        yield start + first - 1, start + behind


def _decorators(statement):
    return getattr(statement, "decorator_list", [])


def _set_inside(code):
    """Names that functions set, each with the function."""
    found = {}
    for source in code:
        try:
            nodes = list(ast.walk(ast.parse(source)))
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            continue
        for node in nodes:
            if isinstance(node, ast.FunctionDef):
                found |= dict.fromkeys(_names_set(node), node.name)
    return found


def _names_set(function):
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
