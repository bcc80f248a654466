"""How dense the code is, measured with radon: `make density`, or `python benchmarks/density.py`.

Everything is counted per 100 statements, so neither docstrings nor line breaks change a figure:
decisions (radon's cyclomatic complexity of every function, less the one that each begins with),
comprehensions, conditional expressions. Beside them: lines over 100 columns in per cent, and
the public functions and classes that have a docstring. Folders or files may be given.
"""

import ast
import sys
from dataclasses import dataclass, fields
from pathlib import Path

from radon.complexity import cc_visit

ROOT = Path(__file__).parents[1]
PACKAGES = ("solutions", "exercises", "grader", "course")
COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
WIDEST = 100  # columns
MOST_COMPLEX = 10
HEADING = (
    "place                                 statements  decisions  compreh.  cond.expr."
    "  over 10  wide %  docs %"
)


@dataclass
class Density:
    """Counts of one file, or of several together."""

    statements: int = 0
    decisions: int = 0
    comprehensions: int = 0
    conditional: int = 0
    complex: int = 0
    lines: int = 0
    wide: int = 0
    public: int = 0
    documented: int = 0

    def add(self, other: "Density") -> None:
        """Takes the counts of another place in."""
        for field in fields(self):
            setattr(self, field.name, getattr(self, field.name) + getattr(other, field.name))

    def row(self, place: str) -> str:
        """The figures of a place in a line."""
        hundred = max(self.statements, 1) / 100
        return (
            f"{place:38}{self.statements:10}{self.decisions / hundred:11.1f}"
            f"{self.comprehensions / hundred:10.1f}{self.conditional / hundred:12.1f}"
            f"{self.complex:9}{100 * self.wide / max(self.lines, 1):8.1f}"
            f"{100 * self.documented / max(self.public, 1):8.0f}"
        )


def density_of(path: Path) -> Density:
    """The counts of one file."""
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text)
    found = Density(lines=len(text.splitlines()))
    found.wide = sum(len(line) > WIDEST for line in text.splitlines())
    for block in cc_visit(text):
        if block.letter == "C":
            continue
        found.decisions += block.complexity - 1
        found.complex += block.complexity > MOST_COMPLEX
    for node in ast.walk(tree):
        found.statements += isinstance(node, ast.stmt) and not is_docstring(node)
        found.comprehensions += isinstance(node, COMPREHENSIONS)
        found.conditional += isinstance(node, ast.IfExp)
    for node in public(tree):
        found.public += 1
        found.documented += ast.get_docstring(node) is not None
    return found


def is_docstring(node: ast.stmt) -> bool:
    """Whether a statement is a text that stands by itself."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def public(tree: ast.Module) -> list[ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef]:
    """Functions, classes and methods without an underscore before their name or their class's."""
    found: list[ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef] = []
    waiting = [node for node in tree.body if isinstance(node, DEFINITIONS)]
    while waiting:
        node = waiting.pop()
        if node.name.startswith("_"):
            continue
        found.append(node)
        if isinstance(node, ast.ClassDef):
            waiting += [inner for inner in node.body if isinstance(inner, DEFINITIONS)]
    return found


def main(places: list[str]) -> None:
    """Prints a row for every file of the places, or for every room and package of the project."""
    print(HEADING)
    if places:
        for place in map(Path, places):
            total = Density()
            for path in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
                found = density_of(path)
                total.add(found)
                print(found.row(str(path)))
            print(total.row(f"{place}, together"))
        return
    for package in PACKAGES:
        rooms: dict[str, Density] = {}
        whole = Density()
        for path in sorted((ROOT / package).rglob("*.py")):
            found = density_of(path)
            rooms.setdefault(str(path.parent.relative_to(ROOT)), Density()).add(found)
            whole.add(found)
        print(whole.row(package.upper()))
        for room, found in sorted(rooms.items()):
            print(found.row(f"  {room}"))


if __name__ == "__main__":
    main(sys.argv[1:])
