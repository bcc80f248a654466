"""A notebook's file as cells, and what there is to say of one that holds no answers."""

import ast
import codecs
import json
import re

from .limits import MAX_CODE

PYTHON = ("python", "")  # languages of kernels; older notebooks name none
ASSIGNED = re.compile(r"^\s*(\w+)\s*=(?!=)", re.MULTILINE)

SCRIPT = (ast.Import, ast.ImportFrom, ast.Assign, ast.FunctionDef)  # statements of a .py file


class NotANotebookError(ValueError):
    """The file holds no cells that can be run, with a sentence that says why."""


class Notebook:
    """The sources of code cells in order, and of the cells that are not run."""

    def __init__(self, code, prose, language):
        self.code = code
        self.prose = prose
        self.language = language
        self.hints = {}

    def where(self, index, _error):
        """The cell of that index, counted as people do."""
        return f"cell {index + 1}"

    def hint(self, name):
        """Why a name may be missing that stands in the file all the same; empty where it is not.

        It is asked after every cell, and follows from the file alone.
        """
        if name not in self.hints:
            self.hints[name] = self._hint(name)
        return self.hints[name]

    def _hint(self, name):
        if self.language not in PYTHON:
            return f"the notebook has a kernel for {self.language[:40]}; a sheet takes Python"
        for kind, source in self.prose:
            # Few cells name it, and the long ones, with pictures, take long to search.
            if name in source and name in ASSIGNED.findall(source):
                return f"a {kind} cell assigns {name}; an answer takes a code cell, which is run"
        if not self.code:
            return "the notebook has no code cells"
        return ""


def read_notebook(data):
    """The cells of a notebook of any format, without outputs and attachments.

    Raises:
        NotANotebookError: there are none, or more code than anybody types.
    """
    # Not as utf-8-sig: to load that codec takes longer than to read the notebook.
    text = data.removeprefix(codecs.BOM_UTF8).decode("utf-8", errors="replace")
    try:
        return _read(json.loads(text))
    except NotANotebookError:
        raise
    except (ValueError, TypeError, AttributeError, RecursionError) as error:
        raise NotANotebookError(f"the file is not a notebook: {_not_json(text, error)}") from None


def _read(content):
    code, prose = [], []
    for cell in _cells_of(content):
        if not isinstance(cell, dict):
            continue
        source = cell.get("source", cell.get("input", ""))
        source = "".join(source) if isinstance(source, list) else str(source)
        kind = cell.get("cell_type")
        if kind == "code":
            code.append(source)
        elif kind in ("markdown", "raw"):
            prose.append((kind.capitalize(), source))

    size = sum(map(len, code))
    if size > MAX_CODE:
        most = f"a notebook may have {MAX_CODE >> 20} million"
        raise NotANotebookError(f"its code cells hold {size >> 20} million characters; {most}")
    return Notebook(code, prose, _language(content))


def _cells_of(content):
    if not isinstance(content, dict):
        raise NotANotebookError("the file is not a notebook: it has no cells")
    cells = content.get("cells")
    if cells is None:  # nbformat 3
        cells = []
        for sheet in content.get("worksheets", []):
            cells += sheet.get("cells", [])
    if not isinstance(cells, list):
        raise NotANotebookError("the file is not a notebook: it has no cells")
    return cells


def _language(content):
    """The language of the kernel, in lower case; empty where the file does not say."""
    metadata = content.get("metadata")
    if not isinstance(metadata, dict):
        return ""
    for table, key in (("language_info", "name"), ("kernelspec", "language")):
        about = metadata.get(table)
        if isinstance(about, dict) and isinstance(about.get(key), str):
            return about[key].lower().removesuffix("3").removeprefix("i")
    return ""


def _not_json(text, error):
    """Why a file is no notebook, in words that say what it looks like instead."""
    start = text.lstrip()[:1]
    if not start:
        return "it is empty"
    if start == "<":
        return "it is a web page"
    if start == "{" and _breaks_off(text, error):
        return "it breaks off before its end; save the notebook and hand it in again"
    if _is_python(text):
        return "it is Python code; hand it in with the ending .py, or save it as a notebook"
    return str(error)[:100]


def _breaks_off(text, error):
    """Whether nothing is wrong with a JSON text but that it has no end."""
    if not isinstance(error, json.JSONDecodeError):
        return False
    return error.msg.startswith("Unterminated string") or error.pos >= len(text.rstrip())


def _is_python(text):
    """Whether a text is a script, and not just words that could be one."""
    try:
        body = ast.parse(text[:MAX_CODE]).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return any(isinstance(statement, SCRIPT) for statement in body)
