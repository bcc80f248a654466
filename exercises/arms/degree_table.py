"""An arm of three joints by a Denavit-Hartenberg table of right angles, printed in degrees."""

import re
from functools import lru_cache
from typing import Any

import numpy as np

from ...solutions.chain import from_standard
from ...solutions.expression_array import ExpressionArray, expression_array
from ...solutions.robot import Robot
from ...solutions.table import COLUMNS
from ..answers import Variant
from ..arm import Array
from ..contract.introduction import joint_types
from ..drawing import Drawing, Triad
from ..draws import angles, length

ORDERS = ("theta alpha a d", "alpha a d theta", "a alpha d theta", "theta d a alpha")
LABELS = (r"$\theta_i$", "$d_i$", "$a_i$", r"$\alpha_i$")
LENGTHS = ("a1", "a2", "a3", "d1", "d2", "d3")
NAMES = (*LENGTHS, "q1", "q2", "q3", "s2", "s3")
Row = tuple[str, str, str, str]
"""Formulas of theta, d, a, alpha."""
Texts = dict[int, str]
"""How the constant angles are written, right or wrong."""
RADIANS: Texts = {-90: "-pi/2", 0: "0", 90: "pi/2", 180: "pi"}
DEGREES: Texts = {-90: "-90", 0: "0", 90: "90", 180: "180"}
PRINTED: Texts = {-90: "−90°", 0: "0°", 90: "90°", 180: "180°"}
LEFT_OUT: Texts = dict.fromkeys(RADIANS, "0")


def drawn_table(rng: np.random.Generator) -> dict[str, Any]:
    """A table of three rows with one negative length, and joint values.

    A prismatic row has no d of its own, and every row has a length.
    """
    kinds = ("RRP", "RPR")[int(rng.integers(2))]
    v: dict[str, Any] = {"kinds": kinds, "order": int(rng.integers(len(ORDERS)))}
    v["alpha"] = [int(rng.choice([-90, 90])), *rng.choice([*RADIANS], 2).tolist()]
    v["offset"] = [int(rng.choice([-90, 90, 180])), *rng.choice([*RADIANS], 2).tolist()]

    names = ["a1", "d1"]
    for i, kind in enumerate(kinds[1:], 2):
        choices = [[f"a{i}"]]
        if kind == "R":
            choices += [[f"d{i}"], [f"a{i}", f"d{i}"]]
        names += choices[int(rng.integers(len(choices)))]
    for name in names:
        v[name] = length(rng, 0.2, 0.9)
    v[names[int(rng.integers(len(names)))]] *= -1

    turns = angles(rng, 3)
    for joint, turn in zip(joints(v), turns, strict=True):
        v[joint] = turn
        if joint[0] == "s":
            v[joint] = length(rng, 0.2, 0.9)
    return v


def joints(v: Variant) -> list[str]:
    """Names of the joint variables, s2 for the stroke of a prismatic joint 2."""
    letters = {"R": "q", "P": "s"}
    return [f"{letters[kind]}{i}" for i, kind in enumerate(v["kinds"], 1)]


def rows(v: Variant, theta: Texts = RADIANS, alpha: Texts = RADIANS) -> list[Row]:
    """The rows of the table with these texts for the constant angles."""
    table: list[Row] = []
    for i, joint in enumerate(joints(v), 1):
        offset = theta[v["offset"][i - 1]]
        twist = alpha[v["alpha"][i - 1]]
        a, d = length_or_zero(v, f"a{i}"), length_or_zero(v, f"d{i}")
        if joint[0] == "q":
            table.append((f"{joint} + {offset}", d, a, twist))
        else:
            table.append((offset, joint, a, twist))
    return table


def length_or_zero(v: Variant, name: str) -> str:
    """The name of a length that this arm has, or 0."""
    if name in v:
        return name
    return "0"


def numbers(v: Variant, theta: Texts = RADIANS, alpha: Texts = RADIANS) -> Array:
    """The table in numbers (3, 4) [rad, m]."""
    return np.array([read(row, NAMES).at(v) for row in rows(v, theta, alpha)])


read = lru_cache(maxsize=512)(expression_array)


@lru_cache(maxsize=512)
def closed(theta: str, d: str, a: str, alpha: str, convention: Any = "standard") -> ExpressionArray:
    """The transform of row 1 in closed form."""
    robot = Robot(
        name="row",
        title="Row 1",
        parameters={"a1": 1.0, "d1": 1.0},
        rows=((theta, d, a, alpha),),
        limits=((-np.pi, np.pi),),
        source="S2",
        convention=convention,
    )
    return expression_array(robot.symbolic().T, robot.names)


def printed(v: Variant) -> str:
    """The table in Markdown, with its columns in the drawn order."""
    order = [COLUMNS.index(name) for name in ORDERS[v["order"]].split()]
    head = " | ".join(LABELS[column] for column in order)
    lines = [f"| $i$ | {head} |", "|:-:|:-:|:-:|:-:|:-:|"]
    for i, row in enumerate(rows(v, PRINTED, PRINTED), 1):
        cells = " | ".join(in_print(row[column]) for column in order)
        lines.append(f"| ${i}$ | {cells} |")
    return "\n".join(lines)


def in_print(cell: str) -> str:
    """A cell with its names as formulas, and without a plus before a minus or a zero."""
    formulas = re.sub(r"([adqs])(\d)", r"$\1_\2$", cell)
    return formulas.replace("+ −", "− ").replace(" + 0°", "")


def drawn(v: Variant, tool: Array) -> Drawing:
    """The arm at the student's joint values with frame 0 and frame 3, `tool` (4, 4)."""
    number = str(v["kinds"]).index("P") + 1
    at_zero = {**v, **dict.fromkeys(joints(v), 0.0)}
    return Drawing(
        from_standard(numbers(at_zero), v["kinds"]),
        tuple(v[name] for name in joints(v)),
        "The arm of your table at your joint values, with frames 0 and 3; "
        f"the figure writes q{number} for the stroke s{number}.",
        f"Arm with three joints ({joint_types(v['kinds'])}), drawn at your joint values.",
        (Triad(np.eye(4), "0"), Triad(tool, "3")),
    )
