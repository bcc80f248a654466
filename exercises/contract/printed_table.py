"""Denavit-Hartenberg tables as a sheet prints them."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from ...solutions.expression import latex_name
from ...solutions.robot import Robot


def printed_table(rows: Sequence[Sequence[str]]) -> str:
    """Markdown of a table of theta, d, a, alpha; names become symbols, numbers stay as they are."""
    lines = [r"| $i$ | $\theta_i$ | $d_i$ | $a_i$ | $\alpha_i$ |", "|:-:|:-:|:-:|:-:|:-:|"]
    for i, row in enumerate(rows, 1):
        cells = " | ".join(f"${cell_latex(cell)}$" for cell in row)
        lines.append(f"| ${i}$ | {cells} |")
    return "\n".join(lines)


def table_rows(robot: Robot, fixed: Mapping[str, float] | None = None) -> list[list[str]]:
    """Cells of a robot's table as text, with numbers for the lengths in `fixed`."""
    return [_cells(row, fixed or {}) for row in robot.rows]


def _cells(row: Sequence[Any], fixed: Mapping[str, float]) -> list[str]:
    return [with_numbers(str(cell), fixed) for cell in row]


def with_numbers(text: str, fixed: Mapping[str, float]) -> str:
    """A cell such as -a4 with numbers for the names in `fixed`.

    A negative one takes brackets behind a sign.
    """

    def number(name: re.Match[str]) -> str:
        if name[0] not in fixed:
            return name[0]
        value = fixed[name[0]]
        is_behind_sign = name.start() > 0  # as in -a4, which is no --0.3 but -(-0.3)
        return f"({value:g})" if value < 0 and is_behind_sign else f"{value:g}"

    return re.sub(r"[A-Za-z]\w*", number, text)


def cell_latex(text: str) -> str:
    """LaTeX of a cell such as q2 + pi/2."""
    symbols = re.sub(r"[A-Za-z]\w*", lambda name: latex_name(name[0]), text)
    return symbols.replace("*", r"\,")
