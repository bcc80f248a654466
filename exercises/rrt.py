"""S3 5.4.1: an RRT robot from its drawing: Denavit-Hartenberg table, transforms, Jacobian.

Structure and numbers are drawn: the sense of the axes, and which of the offsets a1, d2 and l3 the arm has. The drawing
gives base frame, positive senses and home pose, and the sheet asks for joint variables without offsets, so that the
table is unique.
"""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..solutions.robots import ROBOTS, Robot
from ..solutions.table import Table
from .drawing import Dimension, Drawing, Triad, point
from .draws import angles, length
from .exercise import Exercise, Given, Mistake, Numbers, Part, Step, TableOf, Variant

Array = NDArray[np.float64]
LENGTHS = ("d1", "a1", "d2", "l3")
OFFSETS = ((), ("a1",), ("d2",), ("l3",), ("a1", "d2"), ("a1", "l3"), ("d2", "l3"))
FORMS = tuple((alpha1, offsets) for offsets in OFFSETS for alpha1 in (-90, 90))
KINDS = "RRP"


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 14 forms (which offsets, which sense of axis 2), away from its singular postures."""
    form = int(rng.integers(len(FORMS)))
    alpha1, offsets = FORMS[form]
    while True:
        v: dict[str, Any] = {"form": form, "d1": length(rng)}
        v |= {name: length(rng, 0.2, 0.5) for name in offsets}
        v["q"] = [*angles(rng, 2), length(rng)]
        stretch = v["q"][2] + v.get("l3", 0.0)
        reach = v.get("a1", 0.0) - np.sign(alpha1) * stretch * np.sin(v["q"][1])
        if abs(reach) > 0.2:
            return v


def lengths(v: Variant) -> dict[str, float]:
    return {name: v[name] for name in LENGTHS if name in v}


@lru_cache
def robot(form: int) -> Robot:
    """The arm of one form, with every length 1 m by default."""
    alpha1, offsets = FORMS[form]
    first, second = ("pi/2", "-pi/2") if alpha1 > 0 else ("-pi/2", "pi/2")
    return Robot(
        name="rrt",
        title="RRT robot",
        parameters=dict.fromkeys((name for name in LENGTHS if name in ("d1", *offsets)), 1.0),
        rows=(
            ("q1", "d1", "a1" if "a1" in offsets else "0", first),
            ("q2", "d2" if "d2" in offsets else "0", "0", second),
            ("0", "q3 + l3" if "l3" in offsets else "q3", "0", "0"),
        ),
        limits=ROBOTS["rrt_spherical"].limits,
        source="S3 5.4.1; figure 5.2 is missing, the form is drawn for each student",
    )


def robot_of(v: Variant) -> Robot:
    return robot(v["form"])


def table(v: Variant, _: Given) -> Table:
    return robot_of(v).table


def transforms(v: Variant, given: Given) -> Array:
    return given["rrt_dh"].frames(lengths(v), v["q"])[1:]


def jacobian_of(_: Variant, given: Given) -> Array:
    """Columns from the frames alone: z and o of frame i - 1 for joint i."""
    poses = np.concatenate([np.eye(4)[None], given["rrt_T"]])
    J = np.zeros((6, 3))
    for i, kind in enumerate(given["rrt_dh"].kinds):
        z, o = poses[i, :3, 2], poses[i, :3, 3]
        if kind == "R":
            J[:3, i], J[3:, i] = np.cross(z, poses[-1, :3, 3] - o), z
        else:
            J[:3, i] = z
    return J


def one_frame_late(_: Variant, given: Given) -> Array:
    """Columns from frame i in place of frame i - 1."""
    poses: Array = given["rrt_T"]
    revolute = np.array([kind == "R" for kind in given["rrt_dh"].kinds])
    z, o = poses[:, :3, 2], poses[:, :3, 3]
    turned = np.concatenate([np.cross(z, o[-1] - o).T, z.T])
    return np.where(revolute, turned, np.concatenate([z.T, np.zeros((3, 3))]))


def link_transforms(v: Variant, given: Given) -> Array:
    """From each frame to the next, in place of from the fixed frame."""
    poses: Array = given["rrt_dh"].frames(lengths(v), v["q"])
    return np.linalg.inv(poses[:-1]) @ poses[1:]


def explain_table(v: Variant, given: Given) -> list[Step]:
    import sympy  # pyright: ignore[reportMissingTypeStubs]

    cells = sympy.Matrix([[cell.sympy() for cell in row] for row in given["rrt_dh"].rows])
    sense = "left" if FORMS[v["form"]][0] < 0 else "right"
    return [
        Step(
            r"$\mathbf z_{i-1}$ lies along the axis of joint $i$, in its positive sense. $\mathbf x_i$ is perpendicular to "
            r"$\mathbf z_{i-1}$ and $\mathbf z_i$; without joint offsets it is parallel to $\mathbf x_{i-1}$ at the zero "
            r"of joint $i$. Then $d_i$ and $\theta_i$ are measured along and about $\mathbf z_{i-1}$, $a_i$ and "
            rf"$\alpha_i$ along and about $\mathbf x_i$. Seen along $\mathbf x_1$, axis 2 points to the {sense} of "
            r"$\mathbf z_0$, which gives the sign of $\alpha_1$; $\alpha_2$ turns back. The columns are "
            r"$\theta_i, d_i, a_i, \alpha_i$:",
            r"\mathrm{DH}",
            cells,
        )
    ]


def explain_transforms(v: Variant, given: Given) -> list[Step]:
    closed = robot_of(v).symbolic()
    general = (
        r"Each row gives $\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$, and "
        r"$\mathbf T_0^i = \mathbf T_0^1 \cdots \mathbf T_{i-1}^{i}$. In closed form:"
    )
    steps = [Step(general if i == 1 else "", rf"\mathbf T_0^{i}", closed.frames[i]) for i in (1, 2, 3)]
    return [
        *steps,
        *(
            Step("With your numbers:" if i == 1 else "", rf"\mathbf T_0^{i}", numbers=given["rrt_T"][i - 1])
            for i in (1, 2, 3)
        ),
    ]


def explain_jacobian(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Joints 1 and 2 are revolute: column $i$ is $\mathbf z_{i-1} \times (\mathbf o_3 - \mathbf o_{i-1})$ above "
            r"$\mathbf z_{i-1}$. Joint 3 is prismatic: its column is $\mathbf z_2$ above zeros. "
            r"(The index is $i-1$ in both places: in the standard convention $\mathbf z_{i-1}$ is the axis of joint $i$.)",
            r"\mathbf J",
            robot_of(v).symbolic().J,
        ),
        Step("With your numbers:", r"\mathbf J", numbers=given["rrt_J"]),
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    home = (0.0, 0.0, v["q"][2])
    return (
        _drawing(v, home, "Home pose, q1 = q2 = 0, with the positive sense of each joint.", with_lengths=True),
        _drawing(v, tuple(v["q"]), "The same robot at your q.", with_lengths=False),
    )


def _drawing(v: Variant, q: tuple[float, ...], caption: str, *, with_lengths: bool) -> Drawing:
    arm = robot_of(v)
    poses = arm.frames(lengths(v), q)
    return Drawing(
        arm.chain(lengths(v)),
        q,
        caption,
        f"RRT arm: a vertical revolute joint, a horizontal revolute joint, a slide. {caption}",
        (Triad(poses[0], "0"), *((Triad(poses[-1], "tool"),) if with_lengths else ())),
        _dimensions(v, poses) if with_lengths else (),
    )


def _dimensions(v: Variant, poses: Array) -> tuple[Dimension, ...]:
    """One line for every length and for the stroke q3, along the arm at home."""
    corner = poses[0, :3, 3]
    lines: list[Dimension] = []
    for name, size, direction in (
        ("d1", v["d1"], poses[0, :3, 2]),
        ("a1", v.get("a1", 0.0), poses[1, :3, 0]),
        ("d2", v.get("d2", 0.0), poses[1, :3, 2]),
        ("l3", v.get("l3", 0.0), poses[2, :3, 2]),
        ("q3", v["q"][2], poses[2, :3, 2]),
    ):
        end = corner + size * direction
        if size:
            lines.append(Dimension(point(corner), point(end), name))
        corner = end
    return tuple(lines)


def statement(_: Variant) -> str:
    return r"""The robot turns about the vertical axis 1 and the horizontal axis 2, and slides along axis 3 (RRT). The first
figure shows it in its home pose, $q_1 = q_2 = 0$, with frame 0, the lengths, the tool frame and the positive sense of each
joint; the second shows it at your $\mathbf q$.

Use the **standard** Denavit–Hartenberg convention: $\mathbf z_{i-1}$ along the axis of joint $i$ in its positive sense,
joint $i$ between frames $i-1$ and $i$. Place the frames so that $\theta_1 = q_1$, $\theta_2 = q_2$ and $\theta_3 = 0$, without joint
offsets, and so that frame 3 is the tool frame that is drawn. With that the table is unique."""


EXERCISE = Exercise(
    slug="rrt",
    title="Jacobian of an RRT robot",
    source="S3 5.4.1",
    draw=draw,
    statement=statement,
    units={"d1": "m", "a1": "m", "d2": "m", "l3": "m", "q": ["rad", "rad", "m"]},
    scale=lambda v: sum(lengths(v).values()) + v["q"][2],
    objectives=(
        "Read a Denavit–Hartenberg table off a drawing.",
        "Build the Jacobian of an arm with a prismatic joint from its frames.",
    ),
    minutes=45,
    robot="rrt_offset",
    drawings=drawings,
    parts=(
        Part(
            "rrt_dh",
            r"The DH table: one row $[\theta_i, d_i, a_i, \alpha_i]$ per joint, as text in the names of your lengths and "
            r"q1, q2, q3, for instance `['q1 + pi', 0.25, 'd1', 'pi/3']`, or as numbers at your $\mathbf q$ (radians, metres)",
            3,
            TableOf(LENGTHS, KINDS),
            table,
            hints=(
                "Which way does the positive arrow of joint 2 make its axis point?",
                "A prismatic joint's variable stands in the column d.",
            ),
            explain=explain_table,
        ),
        Part(
            "rrt_T",
            r"The transforms from the fixed frame to each frame, $\mathbf T_0^1, \mathbf T_0^2, \mathbf T_0^3$ at your "
            r"$\mathbf q$, stacked to an array 3 × 4 × 4",
            3,
            Numbers((3, 4, 4), [[["1", "1", "1", "m"]] * 3 + [["1"] * 4]], decimals=3),
            transforms,
            mistakes=(
                Mistake(
                    "These lead from each frame to the next; all three shall start at the fixed frame.", link_transforms
                ),
            ),
            needs=("rrt_dh",),
            hints=("Multiply from the left to the right: T01, then T01 @ T12, then the last.",),
            explain=explain_transforms,
        ),
        Part(
            "rrt_J",
            r"The 6 × 3 Jacobian $\mathbf J$ of the tool point in the base frame at your $\mathbf q$, linear rows above angular rows",
            4,
            Numbers((6, 3), [["m/rad", "m/rad", "1"]] * 3 + [["1", "1", "1"]] * 3, decimals=3),
            jacobian_of,
            mistakes=(
                Mistake(
                    "Column i seems to be taken from frame i; in the standard convention the axis of joint i is z of "
                    "frame i - 1.",
                    one_frame_late,
                ),
            ),
            needs=("rrt_T", "rrt_dh"),
            hints=(
                "What does a prismatic joint contribute to the angular velocity?",
                "The axis of joint i is the z axis of frame i - 1.",
            ),
            explain=explain_jacobian,
        ),
    ),
)
