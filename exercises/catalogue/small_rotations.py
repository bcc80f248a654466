"""S0 4.9 to 4.11: the rotation vector between two close frames, and the rows of the Jacobian that give it to first order.

The senses of the axes are drawn. The rotations are printed to six decimals; the angles are such that the
second order, which S0's eq. 4.11 leaves out, is larger than the tolerance.
"""

from functools import lru_cache
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...solutions.robot import Robot
from ..answers import LETTERS
from ..drawing import Drawing, Triad
from ..draws import angles, length, until
from ..exercise import Choice, Exercise, Given, Mistake, Numbers, Outcome, Part, Step, Variant
from ..printed_table import printed_table, table_rows
from ..properties import turned

Array = NDArray[np.float64]
KINDS = "RRPR"
TURNS = np.array([kind == "R" for kind in KINDS])
SENSES = tuple(product(("pi/2", "-pi/2"), repeat=4))  # of alpha1, alpha2, theta3, alpha3
LENGTHS = ("d1", "a2", "a4")
DIVISORS = (2, 4, 10)
FACTORS = (2, 4, 8, 10, 16, 64, 100, 1000)  # the divisors, their squares and cubes
TOLERANCE = 5e-4  # rad; below it, first order and the rotation vector would be the same
APART = 1e-3


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 16 forms, a posture and a displacement whose second order shows."""
    form = int(rng.integers(len(SENSES)))
    v: dict[str, Any] = {"form": form, "k": DIVISORS[int(rng.integers(len(DIVISORS)))]}
    v |= {name: length(rng, 0.2, 0.6) for name in LENGTHS}
    return v | until(lambda: _motion(rng, form), lambda motion: _is_telling({**v, **motion}))


def _motion(rng: np.random.Generator, form: int) -> dict[str, Any]:
    """Posture, displacement, and the rotations before and after it, to six decimals."""
    q1, q2, q4 = angles(rng, 3)
    q = [q1, q2, length(rng, 0.3, 0.8), q4]
    dq = [round(float(x) / 1000, 3) for x in rng.integers(35, 71, 4) * rng.choice([-1, 1], 4)]
    first, second = (np.round(rotation_at(form, at), 6) + 0.0 for at in (q, np.add(q, dq)))
    return {"q": q, "dq": dq, "R1": first.tolist(), "R2": second.tolist()}


def _is_telling(v: Variant) -> bool:
    """Whether all components matter, what first order misses is nearly all second order, and mistakes show."""
    dw, first_order, k = between(v), to_first_order(v), v["k"]
    after = rotation_at(v["form"], np.add(v["q"], np.array(v["dq"]) / k))
    nearer = rotation_vector(after @ rotation_at(v["form"], v["q"]).T) - first_order / k
    ratio = np.linalg.norm(dw - first_order) / np.linalg.norm(nearer)
    others = (
        first_order,
        in_tool_axes(v),
        -in_tool_axes(v),
        one_entry_each(v),
        angles_of_product(v),
        differences_of_angles(v),
    )
    return bool(
        min(np.abs(dw).min(), np.abs(first_order).min()) >= 0.008
        and np.linalg.norm(dw) <= 0.14
        and abs(ratio / k**2 - 1) <= 0.12
        and min(np.abs(other - dw).max() for other in others) >= APART
    )


@lru_cache
def robot(form: int) -> Robot:
    """The arm of one form, with every length 1 m by default."""
    alpha1, alpha2, theta3, alpha3 = SENSES[form]
    return Robot(
        name="small_rotations",
        title="RRPR robot",
        parameters=dict.fromkeys(LENGTHS, 1.0),
        rows=(
            ("q1", "d1", "0", alpha1),
            ("q2", "0", "a2", alpha2),
            (theta3, "q3", "0", alpha3),
            ("q4", "0", "a4", "0"),
        ),
        limits=((-np.pi, np.pi), (-np.pi, np.pi), (0.0, 1.0), (-np.pi, np.pi)),
        source="drawn for each student",
    )


def lengths(v: Variant) -> dict[str, float]:
    return {name: v[name] for name in LENGTHS}


def rotation_at(form: int, q: ArrayLike) -> Array:
    """Rotation (3, 3) of the tool frame; lengths do not matter for it."""
    return robot(form).frames(None, q)[-1, :3, :3]


def rotation_vector(R: Array) -> Array:
    """Axis times angle of a rotation of less than a quarter turn, also where R is rounded."""
    w = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    sine = float(np.linalg.norm(w))
    return w * (np.arcsin(min(sine, 1.0)) / sine)


def between(v: Variant) -> Array:
    R1, R2 = np.array(v["R1"]), np.array(v["R2"])
    return rotation_vector(R2 @ R1.T)


def rotation_between(v: Variant, _: Given) -> Array:
    return between(v)


def angular_rows(v: Variant, _: Given) -> Array:
    return _axes(v) * TURNS


def _axes(v: Variant, first: int = 0) -> Array:
    """Axes z (3, 4) of four frames, from frame `first` on."""
    return robot(v["form"]).frames(None, v["q"])[first : first + 4, :3, 2].T


def to_first_order(v: Variant) -> Array:
    return angular_rows(v, {}) @ np.array(v["dq"])


def rotation_to_first_order(v: Variant, given: Given) -> Array:
    B: Array = given["small_rotations_B"]
    return B @ np.array(v["dq"])


def factor(v: Variant, _: Given) -> str:
    return LETTERS[FACTORS.index(v["k"] ** 2)]


def in_tool_axes(v: Variant) -> Array:
    R1, R2 = np.array(v["R1"]), np.array(v["R2"])
    return rotation_vector(R1.T @ R2)


def without_half(v: Variant) -> Array:
    """Differences of opposite entries, which are twice the axis times the sine of the angle."""
    R = np.array(v["R2"]) @ np.array(v["R1"]).T
    return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])


def one_entry_each(v: Variant) -> Array:
    """Components read off below the diagonal only, or above it."""
    R = np.array(v["R2"]) @ np.array(v["R1"]).T
    return np.array([R[2, 1], R[0, 2], R[1, 0]])


def roll_pitch_yaw(R: Array) -> Array:
    """Angles about fixed x, y, z."""
    return np.array(
        [np.arctan2(R[2, 1], R[2, 2]), np.arctan2(-R[2, 0], np.hypot(R[2, 1], R[2, 2])), np.arctan2(R[1, 0], R[0, 0])]
    )


def angles_of_product(v: Variant) -> Array:
    return roll_pitch_yaw(np.array(v["R2"]) @ np.array(v["R1"]).T)


def differences_of_angles(v: Variant) -> Array:
    return turned(roll_pitch_yaw(np.array(v["R2"])) - roll_pitch_yaw(np.array(v["R1"])))


def named_reading(v: Variant, _: Given, value: Array) -> Outcome:
    if np.abs(value + between(v)).max() <= TOLERANCE:
        return Outcome(reading="This is the rotation vector of R1 R2^T, which turns from frame 2 back to frame 1.")
    return Outcome()


def explain_between(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"$\mathbf R_2 = \mathbf R(d\mathbf w)\,\mathbf R_1$ gives $\mathbf R(d\mathbf w) = \mathbf R_2 \mathbf R_1^T$ with $d\mathbf w$ "
            r"in base axes; $\mathbf R_1^T \mathbf R_2$ would have it in tool axes.",
            r"\mathbf R_2 \mathbf R_1^T",
            numbers=np.array(v["R2"]) @ np.array(v["R1"]).T,
        ),
        Step(
            r"Half the differences of opposite entries, $\frac{1}{2}(R_{32} - R_{23},\; R_{13} - R_{31},\; R_{21} - R_{12})$, are the axis "
            r"times the sine of the angle; dividing by the sine and multiplying with the angle changes so little here that both pass:",
            r"d\mathbf w",
            numbers=given["small_rotations_dw"],
        ),
    ]


def explain_rows(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Column $i$ of $\mathbf B$ is $\xi_i \mathbf z_{i-1}$ in the standard convention: the axis of a revolute "
            r"joint, and zero for the prismatic one. In closed form:",
            r"\mathbf B",
            robot(v["form"]).symbolic().J[3:, :],
        ),
        Step("With your numbers:", r"\mathbf B", numbers=given["small_rotations_B"]),
    ]


def explain_first_order(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"One matrix times one vector; the metres of the slide meet a column of zeros:",
            r"\mathbf B\,d\mathbf q",
            numbers=given["small_rotations_Bdq"],
        )
    ]


def explain_factor(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Rotations do not add. To second order "
            r"$d\mathbf w = \mathbf B\,d\mathbf q + \frac{1}{2} \cdot$ the sum of $dq_i\,dq_j\,\mathbf z_{i-1} \times \mathbf z_{j-1}$ over all pairs of "
            r"revolute joints $i < j$. An equals sign between $d\mathbf w$ and $\mathbf B\,d\mathbf q$ holds to first order only."
        ),
        Step(
            rf"The difference has products of two $dq$: divided by $k = {v['k']}$ each, it shrinks by $k^2 = {v['k'] ** 2}$. Yours is now",
            r"d\mathbf w - \mathbf B\,d\mathbf q",
            numbers=between(v) - to_first_order(v),
        ),
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    arm = robot(v["form"])
    poses = arm.frames(lengths(v), v["q"])
    return (
        Drawing(
            arm.chain(lengths(v)),
            tuple(v["q"]),
            "Your arm at q, with frame 0 and the tool frame.",
            "Arm with two revolute joints, a slide and another revolute joint, drawn at your q.",
            (Triad(poses[0], "0"), Triad(poses[-1], "tool")),
        ),
    )


def statement(v: Variant) -> str:
    return rf"""An arm with revolute joints 1, 2 and 4 and a prismatic joint 3 (RRPR) has this table in the **standard** Denavit–Hartenberg
convention, $\mathbf T_{{i-1}}^i = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$; its tool frame is frame 4:

{printed_table(table_rows(robot(v["form"])))}

At $\mathbf q$ the rotation of the tool frame in base axes (those of frame 0) is $\mathbf R_1$, at $\mathbf q + d\mathbf q$ it is
$\mathbf R_2$. Both are printed rounded to six decimals. The rotation vector $d\mathbf w$ between
them is the axis of the rotation in base axes times its angle, so that $\mathbf R_2 = \mathbf R(d\mathbf w)\,\mathbf R_1$. The angular rows of
the Jacobian in base axes are $\mathbf B$, and $\mathbf B\,d\mathbf q$ is nearly $d\mathbf w$."""


TWICE = "It is twice too long: each difference of opposite entries counts half."

EXERCISE = Exercise(
    slug="small_rotations",
    title="Small rotations and the angular rows of the Jacobian",
    source="S0 4.3, eq. 4.9 to 4.11",
    draw=draw,
    statement=statement,
    units={
        **dict.fromkeys(LENGTHS, "m"),
        "q": ["rad", "rad", "m", "rad"],
        "dq": ["rad", "rad", "m", "rad"],
        "R1": [["1"] * 3] * 3,
        "R2": [["1"] * 3] * 3,
        "k": "1",
    },
    symbols={"dq": r"d\mathbf{q}"},
    scale=lambda v: sum(lengths(v).values()),
    objectives=(
        "Read the rotation vector off two rotation matrices.",
        "Compare it with the angular rows of the Jacobian times the joint displacements.",
    ),
    minutes=35,
    drawings=drawings,
    parts=(
        Part(
            "small_rotations_dw",
            r"The rotation vector $d\mathbf w$ in base axes with $\mathbf R_2 = \mathbf R(d\mathbf w)\,\mathbf R_1$, from the printed rotations",
            3,
            Numbers((3,), "rad"),
            rotation_between,
            check=named_reading,
            credit="all",
            tolerance=TOLERANCE,
            mistakes=(
                Mistake(
                    "This is the rotation vector in axes of the tool frame; on which side of R1 does R(dw) stand?",
                    lambda v, _: in_tool_axes(v),
                ),
                Mistake(
                    "This is the rotation vector of R2^T R1, the way back and in axes of the tool frame; which product is R(dw)?",
                    lambda v, _: -in_tool_axes(v),
                ),
                Mistake(TWICE, lambda v, _: without_half(v)),
                Mistake(TWICE, lambda v, _: 2 * between(v)),
                Mistake(
                    "These are differences of roll, pitch and yaw angles; in space no three angles have dw as their changes.",
                    lambda v, _: differences_of_angles(v),
                ),
                Mistake(
                    "These are roll, pitch and yaw of R2 R1^T: that is the rotation vector to first order only.",
                    lambda v, _: angles_of_product(v),
                ),
                Mistake(
                    "Each component seems to be read off one entry of R2 R1^T; the opposite entry counts as well.",
                    lambda v, _: one_entry_each(v),
                ),
                Mistake(
                    "This is B dq, the rotation to first order; dw between the printed rotations is asked.",
                    lambda v, _: to_first_order(v),
                ),
            ),
            hints=(
                "Which product of the two matrices is R(dw)?",
                "A rotation minus its transpose holds the axis times the sine of the angle, twice.",
            ),
            explain=explain_between,
        ),
        Part(
            "small_rotations_B",
            r"The 3 × 4 block $\mathbf B$ of the angular rows of the Jacobian at your $\mathbf q$, in base axes",
            2,
            Numbers((3, 4), "1", decimals=3),
            angular_rows,
            mistakes=(
                Mistake(
                    "The prismatic joint has its axis as an angular column; does a slide turn the tool?",
                    lambda v, _: _axes(v),
                ),
                Mistake(
                    "Column i seems to be taken from frame i; in the standard convention the axis of joint i is z of "
                    "frame i - 1.",
                    lambda v, _: _axes(v, 1) * TURNS,
                ),
                Mistake(
                    "This is the block in axes of the tool frame; base axes are asked.",
                    lambda v, _: rotation_at(v["form"], v["q"]).T @ angular_rows(v, {}),
                ),
            ),
            hints=("Only directions matter, no lengths.", "What does a slide contribute to the rotation?"),
            explain=explain_rows,
        ),
        Part(
            "small_rotations_Bdq",
            r"The rotation $\mathbf B\,d\mathbf q$ in base axes, which is $d\mathbf w$ to first order",
            1,
            Numbers((3,), "rad"),
            rotation_to_first_order,
            needs=("small_rotations_B",),
            credit="all",
            tolerance=TOLERANCE,
            mistakes=(
                Mistake(
                    "This is dw between the printed rotations; the first order B dq is asked.",
                    lambda v, _: between(v),
                ),
            ),
            hints=("One matrix times one vector, signs included.",),
            explain=explain_first_order,
        ),
        Part(
            "small_rotations_factor",
            r"By which factor, about, does the length of $d\mathbf w - \mathbf B\,d\mathbf q$ shrink when every entry of $d\mathbf q$ is divided by "
            r"your $k$ and $\mathbf R_2$ is computed anew?",
            1,
            Choice(tuple(map(str, FACTORS))),
            factor,
            hints=("Is the difference of first, second or third order in the joint displacements?", "Try it."),
            explain=explain_factor,
        ),
    ),
)
