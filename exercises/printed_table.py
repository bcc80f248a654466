"""Denavit-Hartenberg tables as a sheet prints them."""

from collections.abc import Sequence

from ..solutions.expression import latex_name
from ..solutions.robot import Robot


def printed_table(rows: Sequence[Sequence[str]]) -> str:
    """Markdown of a table of theta, d, a, alpha; names become symbols, numbers stay as they are."""
    angle = {"pi/2": r"\pi/2", "-pi/2": r"-\pi/2"}
    lines = [
        [str(i), *(latex_name(cell) if cell.isidentifier() else angle.get(cell, cell) for cell in row)]
        for i, row in enumerate(rows, 1)
    ]
    head = [r"| $i$ | $\theta_i$ | $d_i$ | $a_i$ | $\alpha_i$ |", "|:-:|:-:|:-:|:-:|:-:|"]
    return "\n".join([*head, *("| " + " | ".join(f"${cell}$" for cell in line) + " |" for line in lines)])


def table_rows(arm: Robot) -> list[list[str]]:
    """Cells of a robot's table as text."""
    return [[str(cell) for cell in row] for row in arm.rows]
