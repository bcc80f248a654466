"""Code that is alike: statements that a few students share and nobody else of the class wrote."""

import ast
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import Any

FEW = 3  # students who share a statement; what more of them wrote, the course taught
TELLING = 4  # shared statements that tell something
HELD = ("body", "orelse", "handlers", "finalbody", "cases")  # where a statement has others
LONG = 20_000  # characters of a cell
SHORT = 12  # characters: `return J` is everybody's
MOST = 0.5  # of the fewer statements that two students wrote by themselves


@dataclass(frozen=True)
class Alike:
    """Two students and the statements that they share, as the first of them wrote these."""

    one: str
    other: str
    statements: tuple[str, ...]
    share: float


def statements(source: Iterable[str]) -> set[str]:
    """The statements of some cells, without comments and layout; of what is no Python, lines."""
    found: set[str] = set()
    for cell in source:
        try:
            found.update(_of_cell(cell))
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            found.update(" ".join(line.split()) for line in cell.splitlines())
    return {one for one in found if len(one) >= SHORT}


def _of_cell(cell: str) -> Iterator[str]:
    """Every simple statement, and the head of what holds others.

    Raises:
        ValueError: nobody wrote so long a cell by hand.
    """
    if len(cell) > LONG:
        raise ValueError(len(cell))
    for node in ast.walk(ast.parse(cell)):
        if isinstance(node, ast.stmt):
            head, *_ = ast.unparse(_without_body(node)).splitlines() or [""]
            yield head


def _without_body(statement: ast.stmt) -> ast.stmt:
    """The same without the statements that it holds, which would be written again for each head."""
    fields = dict(ast.iter_fields(statement))
    for name in HELD:
        if name in fields:
            fields[name] = []
    return ast.copy_location(type(statement)(**fields), statement)


def code_cells(notebook: bytes) -> list[str]:
    """The sources of a notebook's code cells; none of what is no notebook."""
    try:
        content: Any = json.loads(notebook)
        cells = [cell for cell in content["cells"] if cell["cell_type"] == "code"]
        return ["".join(cell["source"]) for cell in cells]
    except (ValueError, KeyError, TypeError, RecursionError):
        return []


def alike(written: Mapping[str, set[str]]) -> list[Alike]:
    """Pairs of students who share statements that hardly anybody else wrote, the most first.

    `written` holds what each wrote by themselves, without what was handed out.
    """
    authors: dict[str, list[str]] = {}
    for student, own in written.items():
        for statement in own:
            authors.setdefault(statement, []).append(student)
    shared: dict[tuple[str, str], list[str]] = {}
    for statement, students in authors.items():
        if 2 <= len(students) <= FEW:
            for pair in combinations(students, 2):
                shared.setdefault(pair, []).append(statement)

    found: list[Alike] = []
    for (one, other), same in shared.items():
        share = len(same) / min(len(written[one]), len(written[other]))
        if len(same) >= TELLING and share >= MOST:
            found.append(Alike(one, other, tuple(sorted(same)), share))
    return sorted(found, key=_least)


def _least(pair: Alike) -> tuple[float, str, str]:
    return -pair.share, pair.one, pair.other
