"""Denavit-Hartenberg tables as a sheet prints them."""

import re
from collections.abc import Mapping, Sequence

from ..solutions.expression import latex_name
from ..solutions.robot import Robot


def printed_table(rows: Sequence[Sequence[str]]) -> str:
    """Markdown of a table of theta, d, a, alpha; names become symbols, numbers stay as they are."""
    lines = [r"| $i$ | $\theta_i$ | $d_i$ | $a_i$ | $\alpha_i$ |", "|:-:|:-:|:-:|:-:|:-:|"]
    for i, row in enumerate(rows, 1):
        cells = [str(i), *map(cell_latex, row)]
        lines.append("| " + " | ".join(f"${cell}$" for cell in cells) + " |")
    return "\n".join(lines)


def table_rows(robot: Robot, fixed: Mapping[str, float] | None = None) -> list[list[str]]:
    """Cells of a robot's table as text, with numbers for the lengths in `fixed`."""
    numbers = {name: f"{value:g}" for name, value in (fixed or {}).items()}
    return [[numbers.get(str(cell), str(cell)) for cell in row] for row in robot.rows]


def cell_latex(text: str) -> str:
    """LaTeX of a cell such as q2 + pi/2."""
    return re.sub(r"[A-Za-z]\w*", lambda name: latex_name(name[0]), text).replace("*", r"\,")
