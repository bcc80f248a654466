"""The articulated arm of S1, Example 2.25, mounted in many ways, and the position of its hand.

The position is printed and differentiated as in S1. The shoulder stands beside axis 1, and a
structure that has one of S1's rows is left out.
"""

import re
from collections.abc import Callable, Iterator
from functools import lru_cache
from importlib import import_module
from itertools import pairwise, product
from typing import Any

import numpy as np

from ...solutions.expression_array import ExpressionArray, expression_array
from ...solutions.robot import Robot
from ...solutions.robots import ROBOTS
from ..arm import Arm, arm_of
from ..calculations.columns import right
from ..drawing import Drawing
from ..draws import angles, length, until

LENGTHS = ("d1", "a1", "a2", "a3", "a4")
NAMES = (*LENGTHS, "q1", "q2", "q3", "q4", "q5", "q6")
Way = Callable[[Any, int], list[Any]]
"""Row i of the linear block of a closed form, right or wrong: six formulas in sympy."""
S1 = ROBOTS["articulated_6r"]
MOUNTINGS = {
    "floor": ("stands on the floor, with axis 1 along base z", ()),
    "ceiling": ("hangs from the ceiling, with axis 1 against base z", (("Rx", "pi"),)),
    "wall x": ("is fixed to a wall, with axis 1 along base x", (("Ry", "pi/2"), ("Rz", "pi/2"))),
    "wall y": ("is fixed to a wall, with axis 1 along base y", (("Rz", "-pi/2"), ("Ry", "-pi/2"))),
}
OFFSETS = ("0", "pi/2", "-pi/2", "pi")
# Offsets of joint 1 with which an arm that is stretched out at q2 = 0 has one of S1's rows.
AS_PRINTED = {
    ("floor", 1): OFFSETS,
    ("floor", -1): ("0",),
    ("ceiling", 1): ("0", "pi"),
    ("ceiling", -1): OFFSETS,
    ("wall x", 1): ("-pi/2",),
    ("wall x", -1): ("-pi/2",),
    ("wall y", 1): ("pi/2",),
    ("wall y", -1): ("pi/2",),
}
TWIST_1 = {1: "pi/2", -1: "-pi/2"}  # alpha of row 1, by the sense of joints 2 to 4


def structures() -> Iterator[tuple[str, str, str, int]]:
    """Arms without a row of S1's: mounting, offsets of joints 1 and 2, sense of joints 2 to 4."""
    for mounting, first, second, sense in product(MOUNTINGS, OFFSETS, OFFSETS[:3], (1, -1)):
        if second != "0" or first not in AS_PRINTED[mounting, sense]:
            yield mounting, first, second, sense


STRUCTURES = tuple(structures())


@lru_cache(maxsize=128)
def robot(structure: int) -> Robot:
    """The arm of one structure, with every length 1 m by default."""
    mounting, first, second, sense = STRUCTURES[structure]
    rows: Any = (
        (f"q1 + {first}", "d1", "a1", TWIST_1[sense]),
        (f"q2 + {second}", "0", "a2", "0"),
        *S1.rows[2:],
    )
    return Robot(
        name="arm",
        title="Articulated arm",
        parameters=dict.fromkeys(LENGTHS, 1.0),
        rows=rows,
        limits=S1.limits,
        source=S1.source,
        base=MOUNTINGS[mounting][1],
    )


def posture(rng: np.random.Generator, structure: int) -> dict[str, Any]:
    """Lengths and q with which every one of the first four joints moves the hand."""

    def drawn() -> dict[str, Any]:
        return {
            "d1": length(rng),
            "a1": length(rng, 0.2, 0.5),
            "a2": length(rng),
            "a3": length(rng),
            "a4": length(rng, 0.2, 0.6),
            "q": angles(rng, 6, [(1, 2), (1, 2, 3)]),
        }

    def every_joint_moves_it(v: dict[str, Any]) -> bool:
        J = right(arm_of(robot(structure), v).frames, "RRRRRR")
        return bool((np.linalg.norm(J[:3, :4], axis=0) > 0.2).all())

    return until(drawn, every_joint_moves_it)


def mounted(structure: int) -> str:
    """How the arm is fixed, in words."""
    return MOUNTINGS[STRUCTURES[structure][0]][0]


def described(arm: Arm, structure: int) -> str:
    """What a sheet says of the arm and of the position of its hand, with the letters explained."""
    position: Any = arm.closed.T[:3, 3]
    coordinates = r" \\ ".join(map(in_letters, position))
    p = rf"\begin{{bmatrix}} {coordinates} \end{{bmatrix}}"
    return rf"""The arm has six revolute joints and {mounted(structure)}. $\mathbf p$ is the point
in which axes 5 and 6 cross, the origin of frame 6. In base axes it is

$$\mathbf p = \begin{{bmatrix}} p_x \\ p_y \\ p_z \end{{bmatrix}} = {p}$$

with $C_1 = \cos q_1$, $S_2 = \sin q_2$, $C_{{23}} = \cos(q_2 + q_3)$,
$S_{{234}} = \sin(q_2 + q_3 + q_4)$ and so on."""


def in_letters(p: Any) -> str:
    """LaTeX of a coordinate as S1 has it: C_1 in front, C_{23} for cos(q2 + q3)."""
    text = str(factored(p))
    text = re.sub(r"\((.*)\)\*(\w+\(q1\))$", r"\2(\1)", text)
    text = re.sub(r"(.*) ([+-]) d1$", r"\2d1 + \1", text).removeprefix("+").replace("+ -", "- ")
    text = re.sub(r"(c|s)\w+\((q1|q2.*?)\)", lambda found: letter(*found.groups()), text)
    return re.sub(r"([ad])(\d)", r"\1_\2", text).replace("*", r"\,")


def factored(formula: Any) -> Any:
    """A sympy formula as a product."""
    return import_module("sympy").factor(formula)


def letter(name: str, angle: str) -> str:
    """C_{23} for c and q2 + q3; one digit alone takes no braces where it is 1."""
    index = re.sub(r"\D", "", angle)
    if index == "1":
        return f"{name.upper()}_1"
    return f"{name.upper()}_{{{index}}}"


def drawn(arm: Arm) -> Drawing:
    """The arm on its mounting at the student's q, with its lengths and the point p."""
    axis = arm.axes[:, 0]
    path = [np.zeros(3), arm.lengths["d1"] * axis, *arm.origins.T[1:4], arm.p]
    azimuth = -55.0
    if axis[1] > 0.5:  # a wall is seen from its front
        azimuth = 35.0
    return arm.drawing(
        "Your arm at your q, with frame 0 at its base and frame 6 in p, where axes 5 and 6 cross.",
        "Arm with six revolute joints at your q: axes 2, 3 and 4 are parallel, axes 5 and 6 cross "
        "in p, behind link a4.",
        tool="6",
        lengths=dict(zip(LENGTHS, pairwise(path), strict=True)),
        view=(azimuth, 22.0),
        stands=axis,
    )


def row_of(form: Any, i: int) -> list[Any]:
    """Row i of the linear block as it is."""
    return [*form.J[i, :]]


@lru_cache(maxsize=1024)
def derivatives(robot: Robot, i: int, way: Way = row_of) -> ExpressionArray:
    """Row i of the linear block, right or in a wrong way; made once."""
    return expression_array(way(robot.symbolic(), i), NAMES)


def own_link_only(form: Any, i: int) -> list[Any]:
    """Each of joints 2, 3, 4 moves its own link alone."""
    a3, a4 = form.parameters[3:]
    first, second, third, *rest = form.J[i, :]
    return [first, second.subs({a3: 0, a4: 0}), third.subs(a4, 0), *rest]


def two_links_only(form: Any, i: int) -> list[Any]:
    """Joint 2 does not move the last link."""
    first, second, *rest = form.J[i, :]
    return [first, second.subs(form.parameters[4], 0), *rest]


def signs_forgotten(form: Any, i: int) -> list[Any]:
    """No minus in the derivative of a cosine; without cosines, one in that of a sine."""
    cos: Any = import_module("sympy").cos
    p = form.T[i, 3]
    q1, q2, *_ = form.joints
    first, *links, fifth, sixth = form.J[i, :]

    if not p.has(cos):
        return [-entry for entry in form.J[i, :]]
    if p.has(cos(q1)):
        first = -first
    if p.has(cos(q2)):
        links = [-entry for entry in links]
    return [first, *links, fifth, sixth]


def wrist_counted(form: Any, i: int) -> list[Any]:
    """Columns 5 and 6 like column 4."""
    return [*form.J[i, :4], *[form.J[i, 3]] * 2]


SLIPS: tuple[tuple[str, Way], ...] = (
    (
        "Look again at the angles that are sums: which links move when q2 alone changes?",
        own_link_only,
    ),
    ("Column 2: an angle that is a sum of three joints depends on each of them.", two_links_only),
    (
        "Look again at the signs: one of sine and cosine takes a minus when it is differentiated.",
        signs_forgotten,
    ),
    ("Columns 5 and 6: which joints stand in p?", wrist_counted),
)
