"""S2: from a Denavit-Hartenberg table to the transforms of the links and of the frames.

S2 prints its columns as theta, alpha, r, d, other texts in other orders; here the order is drawn,
so that labels have to be read. Its chain T_0^0 T_1^0 T_2^0 ... is a known mistake: taken literally
it stops a link short, or has link 1 twice.
"""

import re
from functools import lru_cache
from typing import Any

import numpy as np

from ...solutions.chain import from_standard, modified_transform, standard_transform
from ...solutions.expression_array import ExpressionArray, expression_array
from ...solutions.robot import Robot
from ...solutions.table import COLUMNS
from ..answers import Formulas, Numbers, Variant
from ..arm import Array
from ..contract.introduction import joint_types
from ..drawing import Drawing, Triad
from ..draws import angles, length, until
from ..exercise import Outcome
from ..part import exercise, part

ORDERS = ("theta alpha a d", "alpha a d theta", "a alpha d theta", "theta d a alpha")
LABELS = (r"$\theta_i$", "$d_i$", "$a_i$", r"$\alpha_i$")
read = lru_cache(maxsize=512)(expression_array)
LENGTHS = ("a1", "a2", "a3", "d1", "d2", "d3")
NAMES = (*LENGTHS, "q1", "q2", "q3", "s2", "s3")
MOST_ZEROS = 0.2  # share of the entries that are zero only in a wrong pose
PLAIN = 0.08  # smallest entry of a rotation that is not zero, and how far the others stay from one
# Texts of the constant angles, right and wrong.
RADIANS = {-90: "-pi/2", 0: "0", 90: "pi/2", 180: "pi"}
DEGREES = {-90: "-90", 0: "0", 90: "90", 180: "180"}
PRINTED = {-90: "−90°", 0: "0°", 90: "90°", 180: "180°"}
LEFT_OUT = dict.fromkeys(RADIANS, "0")
Texts = dict[int, str]


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A table of three rows with one negative length, whose frames hide no mistake."""
    return until(lambda: drawn_table(rng), is_telling)


def drawn_table(rng: np.random.Generator) -> dict[str, Any]:
    kinds = ("RRP", "RPR")[int(rng.integers(2))]
    v: dict[str, Any] = {"kinds": kinds, "order": int(rng.integers(len(ORDERS)))}
    v["alpha"] = [int(rng.choice([-90, 90])), *(int(x) for x in rng.choice(list(RADIANS), 2))]
    v["offset"] = [int(rng.choice([-90, 90, 180])), *(int(x) for x in rng.choice(list(RADIANS), 2))]
    names = ["a1", "d1"]
    for i, kind in enumerate(kinds[1:], 2):
        choices = ([f"a{i}"], [f"d{i}"], [f"a{i}", f"d{i}"]) if kind == "R" else ([f"a{i}"],)
        names += choices[int(rng.integers(len(choices)))]
    v |= {name: length(rng, 0.2, 0.9) for name in names}
    v[names[int(rng.integers(len(names)))]] *= -1
    turns = angles(rng, 3)
    for i, kind in enumerate(kinds, 1):
        v |= {f"q{i}": turns[i - 1]} if kind == "R" else {f"s{i}": length(rng, 0.2, 0.9)}
    return v


def is_telling(v: Variant) -> bool:
    """No entry hides a sign, and poses from wrong links are as full as the right ones, so that they can be followed."""
    poses = frames(links(v))
    sizes = np.abs(poses[:, :3, :3])
    plain = (sizes < 1e-9) | (sizes > 1 - 1e-9) | ((sizes > PLAIN) & (sizes < 1 - PLAIN / 4))
    wrong = (modified_transform(numbers(v)), standard_transform(numbers(v, LEFT_OUT)))
    followed = np.array([frames(own) for own in wrong])
    full = (np.abs(followed) < 1e-3)[:, ~np.isclose(np.abs(poses) * (1 - np.abs(poses)), 0)].mean(
        axis=1
    ) < MOST_ZEROS
    return bool(plain.all() and full.all()) and abs(abs(v["a1"]) - abs(v["d1"])) > 0.05


def rows(
    v: Variant, theta: Texts = RADIANS, alpha: Texts = RADIANS
) -> list[tuple[str, str, str, str]]:
    """Formulas of theta, d, a, alpha in every row, with these texts for the constant angles."""
    table: list[tuple[str, str, str, str]] = []
    for i, joint in enumerate(joints(v), 1):
        offset, twist = theta[v["offset"][i - 1]], alpha[v["alpha"][i - 1]]
        a, d = (name if name in v else "0" for name in (f"a{i}", f"d{i}"))
        table.append(
            (f"{joint} + {offset}", d, a, twist) if joint[0] == "q" else (offset, joint, a, twist)
        )
    return table


def joints(v: Variant) -> tuple[str, ...]:
    """Names of the joint variables, s2 for the stroke of a prismatic joint 2."""
    return tuple(f"{'q' if kind == 'R' else 's'}{i}" for i, kind in enumerate(v["kinds"], 1))


def numbers(v: Variant, *texts: Texts) -> Array:
    """The table in numbers (3, 4) [rad, m]."""
    return np.array([read(row, NAMES).at(v) for row in rows(v, *texts)])


@lru_cache(maxsize=512)
def closed(theta: str, d: str, a: str, alpha: str, convention: Any = "standard") -> ExpressionArray:
    """The transform of row 1 in closed form."""
    lengths, limits = {"a1": 1.0, "d1": 1.0}, ((-np.pi, np.pi),)
    robot = Robot("row", "Row 1", lengths, ((theta, d, a, alpha),), limits, "S2", convention)
    return expression_array(robot.symbolic().T, robot.names)


def statement(v: Variant) -> str:
    order = [COLUMNS.index(name) for name in ORDERS[v["order"]].split()]
    table = [LABELS, *rows(v, PRINTED, PRINTED)]
    head, *lines = (" | ".join(row[column] for column in order) for row in table)
    body = "\n".join(f"| ${i}$ | {line} |" for i, line in enumerate(lines, 1))
    body = re.sub(r"([adqs])(\d)", r"$\1_\2$", body).replace("+ −", "− ").replace(" + 0°", "")
    return rf"""The table of an arm with three joints ({joint_types(v["kinds"])}) in the
**standard** Denavit–Hartenberg convention:

| $i$ | {head} |
|:-:|:-:|:-:|:-:|:-:|
{body}

Mind the order of the columns: it is not the same in every table. From frame $i-1$, turn by
$\theta_i$ about its $\mathbf z$ and go $d_i$ along it, then go $a_i$ along the new $\mathbf x$ and
turn by $\alpha_i$ about it: that is frame $i$. Angles of the table are in degrees, the joint angles
$q_i$ below in radians; $s_i$ is the stroke of a prismatic joint. A length may be negative.
$\mathbf T_j^i$ is the 4 × 4 pose of frame $i$ in the coordinates of frame $j$."""


MODIFIED = "The steps of a row seem to be taken in the order of the modified convention; the table is in the standard convention."
EXCHANGED = "The columns a and d seem exchanged; read the labels of the columns."
AS_THEY_ARE = "The constant angles in the column of theta, printed in degrees, seem to be added to radians as they are."
ANGLES = {
    "The constant angles in the column of theta seem to be left out.": (LEFT_OUT, RADIANS),
    AS_THEY_ARE: (DEGREES, RADIANS),
    "The angles alpha, printed in degrees, seem to be used as radians.": (RADIANS, DEGREES),
    "The angles of the table, printed in degrees, seem to be used as radians.": (DEGREES, DEGREES),
}  # sentence to texts of the constant angles in theta and alpha
GENERAL = (
    r"\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i) = \begin{bmatrix} \cos\theta_i & "
    r"-\sin\theta_i \cos\alpha_i & \sin\theta_i \sin\alpha_i & a_i \cos\theta_i \\ \sin\theta_i & \cos\theta_i "
    r"\cos\alpha_i & -\cos\theta_i \sin\alpha_i & a_i \sin\theta_i \\ 0 & \sin\alpha_i & \cos\alpha_i & d_i \\ "
    r"0 & 0 & 0 & 1 \end{bmatrix}"
)
POSE = [["1", "1", "1", "m"]] * 3 + [["1"] * 4]


@part(
    3,
    Formulas((4, 4), ("q1", "a1", "d1")),
    shows={
        "general": lambda: GENERAL,
        "theta": lambda offset: f"{offset[0]:+d}°",
        "twist": lambda alpha: f"{alpha[0]}°",
        "sine": lambda alpha: f"{alpha[0] // 90}",
    },
    mistakes=(
        (MODIFIED, lambda v: closed(*rows(v)[0], "modified")),
        (EXCHANGED, lambda v: closed(*np.array(rows(v)[0])[[0, 2, 1, 3]].tolist())),
        (
            "The turn by alpha seems to go the other way.",
            lambda v: closed(*rows(v)[0][:3], f"-({rows(v)[0][3]})"),
        ),
        *(
            (said, lambda v, *, texts=texts: closed(*rows(v, *texts)[0]))
            for said, texts in ANGLES.items()
        ),
    ),
)
def first(v: Variant) -> ExpressionArray:
    r"""The transform $\mathbf T_0^1$ of row 1, as 4 × 4 formulas in `q1`, `a1`, `d1`, with a `*` in
    every product and angles in radians (`pi/2` for 90°), such as `2*d1*cos(q1)`; sines and cosines
    of the right angles may be evaluated

    - Which two motions of a row are about or along z, which about or along x?
    - What are sine and cosine of an angle that is shifted by a right angle?

    In the standard convention $<general>$. Row 1 has $\theta_1 = q_1 <theta>$ and
    $\alpha_1 = <twist>$, so $\cos\alpha_1 = 0$ and $\sin\alpha_1 = <sine>$:
    $$\mathbf T_0^1 = <first>$$
    """
    return closed(*rows(v)[0])


@part(
    3,
    Numbers((3, 4, 4), [POSE]),
    shows={"general": lambda: GENERAL},
    mistakes=(
        (MODIFIED, lambda v: modified_transform(numbers(v))),
        (EXCHANGED, lambda v: standard_transform(numbers(v)[:, [0, 2, 1, 3]])),
        *(
            (said, lambda v, *, texts=texts: standard_transform(numbers(v, *texts)))
            for said, texts in ANGLES.items()
        ),
    ),
)
def links(v: Variant) -> Array:
    r"""The transforms $\mathbf T_0^1, \mathbf T_1^2, \mathbf T_2^3$ of the three rows at your joint
    values, stacked to an array 3 × 4 × 4

    - Write one function of theta, d, a, alpha and call it for each row.
    - sin and cos take radians.

    Put each row into $<general>$. In a revolute row the joint variable is in $\theta_i$, in a
    prismatic row it is $d_i$. With your numbers:
    $$\mathbf T_0^1,\; \mathbf T_1^2,\; \mathbf T_2^3 = <links>$$
    """
    return standard_transform(numbers(v))


def literal_chain(links: Array) -> Array:
    """S2's T_0^0 T_1^0 T_2^0 as it stands: poses in frame 0 multiplied with each other."""
    return np.array([links[0], links[0] @ links[0] @ links[1]])


@part(
    4,
    Numbers((2, 4, 4), [POSE]),
    # The literal chain meets some columns by chance.
    check=lambda value, links: Outcome(
        share=0.0 if np.abs(value - literal_chain(links)).max() <= 2e-3 else None
    ),
    mistakes=(
        (
            "The factors seem to be poses in frame 0, so that link 1 comes twice; each factor shall start where the one before it ends.",
            literal_chain,
        ),
        (
            "The transforms of the links seem to be multiplied in the wrong order.",
            lambda links: np.array([links[1] @ links[0], links[2] @ links[1] @ links[0]]),
        ),
        (
            "The matrices seem to be multiplied entry by entry (*); their product takes @.",
            lambda links: np.array([links[0] * links[1], links[0] * links[1] * links[2]]),
        ),
    ),
)
def frames(links: Array) -> Array:
    r"""The poses $\mathbf T_0^2$ and $\mathbf T_0^3$ of frames 2 and 3 in frame 0, stacked to an
    array 2 × 4 × 4

    - Neighbouring indices have to fit: where one factor ends, the next one starts.
    - Matrix products take @.

    Each factor starts where the one before it ends: $\mathbf T_0^2 = \mathbf T_0^1\,\mathbf T_1^2$
    and $\mathbf T_0^3 = \mathbf T_0^2\,\mathbf T_2^3$. With your numbers:
    $$\mathbf T_0^2,\; \mathbf T_0^3 = <frames>$$
    """
    return np.array([links[0] @ links[1], links[0] @ links[1] @ links[2]])


def drawings(v: Variant) -> Drawing:
    slides = str(v["kinds"]).index("P") + 1
    return Drawing(
        from_standard(numbers({**v, **dict.fromkeys(joints(v), 0.0)}), v["kinds"]),
        tuple(v[name] for name in joints(v)),
        f"The arm of your table at your joint values, with frames 0 and 3; the figure writes q{slides} for the stroke s{slides}.",
        f"Arm with three joints ({joint_types(v['kinds'])}), drawn at your joint values.",
        (Triad(np.eye(4), "0"), Triad(frames(links(v))[-1], "3")),
    )


EXERCISE = exercise(
    "dh_transforms",
    title="From a Denavit–Hartenberg table to transforms",
    source="S2",
    minutes=35,
    objectives=(
        "Turn each row of a Denavit–Hartenberg table into a transform.",
        "Chain the transforms of the links to the poses of all frames.",
    ),
    units={f"q{i}": "rad" for i in (1, 2, 3)}
    | {f"s{i}": "m" for i in (2, 3)}
    | dict.fromkeys(LENGTHS, "m"),
    structure=("kinds", "order", "alpha", "offset"),
    scale=lambda v: float(np.abs(numbers(v)[:, 1:3]).sum()),
    draw=draw,
    statement=statement,
    drawings=drawings,
    parts=(first, links, frames),
)
