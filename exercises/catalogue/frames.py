"""S0 4.3 and S1 5.10: one Jacobian in three frames, and the 6 x 6 matrix that leads from one to another.

Toolboxes call them by different words, so that the sheet names each by its axes and its point. The arm is the one of
`small_rotations`; the twist that is to be recognized carries no mark of the frame it was computed in.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.jacobian import at_point, in_axes, jacobian
from ...solutions.robot import Robot
from ..answers import LETTERS
from ..drawing import Drawing, Triad
from ..draws import angles, length, rates, until
from ..exercise import Choice, Exercise, Given, Mistake, Numbers, Part, Step, Variant
from ..printed_table import printed_table, table_rows
from .small_rotations import LENGTHS, SENSES, TURNS, lengths, robot

Array = NDArray[np.float64]
SLIDE = 2  # index of joint 3
APART = 0.05  # between the largest components of the twists that are to be told apart
UNITS = [["m/rad", "m/rad", "1", "m/rad"]] * 3 + [["1"] * 4] * 3
FRAMES = (
    "in base axes at the tool point",
    "in tool axes at the tool point",
    "in base axes at the base origin",
    "in tool axes at the base origin",
)


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 16 forms, a posture, rates, and the twist that comes of them in one of four frames."""
    v: dict[str, Any] = {"form": int(rng.integers(len(SENSES)))} | {name: length(rng) for name in LENGTHS}
    v |= until(lambda: _motion(rng), lambda motion: _is_telling({**v, **motion}))
    twist = _twists(v)[int(rng.integers(len(FRAMES)))]
    return v | {"xi": (np.round(twist, 3) + 0.0).tolist()}


def _motion(rng: np.random.Generator) -> dict[str, Any]:
    q1, q2, q4 = angles(rng, 3)
    return {"q": [q1, q2, length(rng, 0.3, 0.8), q4], "qdot": rates(rng, 4)}


def _is_telling(v: Variant) -> bool:
    """Whether neither pose nor Jacobian is special, and the four twists are far apart."""
    T, twists = pose(v, {}), _twists(v)
    pairs = [(a, b) for a in range(4) for b in range(a)]
    generic = np.abs(T[:3, 3]).min() >= 0.1 and np.abs(T[:3, :3]).max() <= 0.99
    return bool(generic and min(np.abs(twists[a] - twists[b]).max() for a, b in pairs) >= APART)


def pose(v: Variant, _: Given) -> Array:
    return robot(v["form"]).frames(lengths(v), v["q"])[-1]


def at_tool_point(v: Variant, _: Given) -> Array:
    return jacobian(robot(v["form"]).chain(lengths(v)), v["q"])


def rotated(_: Variant, given: Given) -> Array:
    return _turned(given["frames_J"], given["frames_T"][:3, :3].T)


def shifted(_: Variant, given: Given) -> Array:
    """At the base origin: v + p x w, in each column."""
    return _moved(given["frames_J"], given["frames_T"][:3, 3])


def conversion(_: Variant, given: Given) -> Array:
    """Matrix (6, 6) from tool axes at the tool point to base axes at the base origin."""
    T: Array = given["frames_T"]
    return _blocks(T[:3, :3], cross_matrix(T[:3, 3]) @ T[:3, :3])


def named_frame(v: Variant, given: Given) -> str:
    """Letter of the frame whose twist is nearest to the printed one."""
    J, tool, origin = (given[f"frames_{name}"] for name in ("J", "tool", "origin"))
    fourth = _turned(origin, given["frames_T"][:3, :3].T)
    misses = [np.linalg.norm(M @ np.array(v["qdot"]) - np.array(v["xi"])) for M in (J, tool, origin, fourth)]
    return LETTERS[int(np.argmin(misses))]


def cross_matrix(p: Array) -> Array:
    """S(p), with S(p) w = p x w."""
    x, y, z = p
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def _blocks(rotation: Array, coupling: Array) -> Array:
    return np.block([[rotation, coupling], [np.zeros((3, 3)), rotation]])


def _turned(J: Array, rotation: Array) -> Array:
    return np.concatenate([rotation @ J[:3], rotation @ J[3:]])


def _moved(J: Array, p: Array) -> Array:
    return np.concatenate([J[:3] + np.cross(p[:, None], J[3:], axis=0), J[3:]])


def _twists(v: Variant) -> list[Array]:
    """Twists (6,) in the order of `FRAMES`."""
    J, T = at_tool_point(v, {}), pose(v, {})
    origin = at_point(J, -T[:3, 3])
    return [M @ np.array(v["qdot"]) for M in (J, in_axes(J, T[:3, :3]), origin, in_axes(origin, T[:3, :3]))]


def own(v: Variant) -> dict[str, Array]:
    """Pose and Jacobian at the tool point, from which mistakes are computed."""
    return {"frames_T": pose(v, {}), "frames_J": at_tool_point(v, {})}


@lru_cache
def without_constant_angle(form: int) -> Robot:
    rows = table_rows(robot(form))
    rows[SLIDE][0] = "0"
    return replace(robot(form), rows=rows)


@lru_cache
def with_degrees(form: int) -> Robot:
    """The arm with 90 for a right angle."""
    degrees = {"pi/2": "90", "-pi/2": "-90"}
    return replace(robot(form), rows=[[degrees.get(cell, cell) for cell in row] for row in table_rows(robot(form))])


def own_without_constant_angle(v: Variant) -> dict[str, Array]:
    return _of_arm(without_constant_angle(v["form"]), v, np.array(v["q"]))


def own_in_degrees(v: Variant) -> dict[str, Array]:
    """Pose and Jacobian with every angle in degrees in functions that take radians."""
    return _of_arm(with_degrees(v["form"]), v, np.array(v["q"]) * np.array([180 / np.pi if t else 1.0 for t in TURNS]))


def _of_arm(arm: Robot, v: Variant, q: Array) -> dict[str, Array]:
    J = jacobian(arm.chain(lengths(v)), q)
    return {"frames_T": arm.frames(lengths(v), q)[-1], "frames_J": J}


def all_turning(v: Variant, _: Given) -> Array:
    """The slide's column as that of a revolute joint."""
    J, poses = at_tool_point(v, {}), robot(v["form"]).frames(lengths(v), v["q"])
    z = poses[SLIDE, :3, 2]
    J[:, SLIDE] = np.concatenate([np.cross(z, poses[-1, :3, 3] - poses[SLIDE, :3, 3]), z])
    return J


def slide_turns_too(v: Variant, _: Given) -> Array:
    J = at_tool_point(v, {})
    J[3:, SLIDE] = J[:3, SLIDE]
    return J


def turned_and_shifted(sign: int) -> Callable[[Variant, Given], Array]:
    """In tool axes at the base origin, or moved as far the other way."""
    return lambda _, given: _turned(
        _moved(given["frames_J"], sign * given["frames_T"][:3, 3]), given["frames_T"][:3, :3].T
    )


def shifted_in_tool_axes(v: Variant, given: Given) -> Array:
    """The shift in base coordinates, on a Jacobian in tool axes."""
    return _moved(rotated(v, given), given["frames_T"][:3, 3])


def only_for_this_arm(v: Variant, given: Given) -> Array:
    """A matrix that turns the one Jacobian into the other, but not every twist."""
    known = own(v) | {"frames_T": given["frames_T"]}
    return shifted(v, known) @ np.linalg.pinv(rotated(v, known))


def wrong_blocks(of: Callable[[Array, Array], tuple[Array, Array]]) -> Callable[[Variant, Given], Array]:
    """X with the rotation and the coupling block that `of(R, S)` gives."""
    return lambda _, given: _blocks(*of(given["frames_T"][:3, :3], cross_matrix(given["frames_T"][:3, 3])))


def angular_first(v: Variant, given: Given) -> Array:
    X = conversion(v, given)
    return np.block([[X[3:, 3:], X[3:, :3]], [X[:3, 3:], X[:3, :3]]])


def one_frame_late(v: Variant, _: Given) -> Array:
    """Columns from frame i in place of frame i - 1."""
    poses = robot(v["form"]).frames(lengths(v), v["q"])[1:]
    z, o = poses[:, :3, 2], poses[:, :3, 3]
    turned = np.concatenate([np.cross(z, o[-1] - o).T, z.T])
    return np.where(np.array([True, True, False, True]), turned, np.concatenate([z.T, np.zeros((3, 4))]))


def linear_rows_only(_: Variant, given: Given) -> Array:
    J: Array = given["frames_J"]
    return np.concatenate([given["frames_T"][:3, :3].T @ J[:3], J[3:]])


def order_reversed(_: Variant, given: Given) -> Array:
    T: Array = given["frames_T"]
    return _blocks(T[:3, :3], T[:3, :3] @ cross_matrix(T[:3, 3]))


def explain_pose(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"$\mathbf T_0^4 = \mathbf T_0^1 \mathbf T_1^2 \mathbf T_2^3 \mathbf T_3^4$, one row of the table after the other; its columns are the "
            r"axes of the tool frame ($\mathbf R$) and the tool point ($\mathbf p$), in base coordinates. The tool point in closed form:",
            r"\mathbf p",
            robot(v["form"]).symbolic().T[:3, 3],
        ),
        Step("With your numbers:", r"\mathbf T_0^4", numbers=given["frames_T"]),
    ]


def explain_jacobian(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"A revolute column is $\mathbf z_{i-1} \times (\mathbf p - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$, the prismatic one $\mathbf z_2$ above "
            r"zeros. Axes and lever arms are those of base coordinates:",
            r"\mathbf J",
            numbers=given["frames_J"],
        )
    ]


def explain_rotated(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"The point stays, the axes change: $\mathbf v_{tool} = \mathbf R^T \mathbf v$ and $\boldsymbol\omega_{tool} = \mathbf R^T \boldsymbol\omega$, because "
            r"$\mathbf R$ leads from tool axes to base axes. Both blocks turn alike:",
            r"\begin{bmatrix}\mathbf R^T & \mathbf 0\\ \mathbf 0 & \mathbf R^T\end{bmatrix} \mathbf J",
            numbers=given["frames_tool"],
        )
    ]


def explain_shifted(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"The axes stay, the point changes. The point of the body at the base origin lies $-\mathbf p$ from the tool point, so its "
            r"velocity is $\mathbf v + \boldsymbol\omega \times (-\mathbf p) = \mathbf v + \mathbf p \times \boldsymbol\omega$; $\boldsymbol\omega$ is the same for every point:",
            r"\begin{bmatrix}\mathbf 1 & S(\mathbf p)\\ \mathbf 0 & \mathbf 1\end{bmatrix} \mathbf J",
            numbers=given["frames_origin"],
        )
    ]


def explain_conversion(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"First turn to base axes, then shift the point: the second matrix stands on the left, and the product is",
            r"\mathbf X = \begin{bmatrix}\mathbf 1 & S(\mathbf p)\\ \mathbf 0 & \mathbf 1\end{bmatrix} "
            r"\begin{bmatrix}\mathbf R & \mathbf 0\\ \mathbf 0 & \mathbf R\end{bmatrix} = "
            r"\begin{bmatrix}\mathbf R & S(\mathbf p) \mathbf R\\ \mathbf 0 & \mathbf R\end{bmatrix}",
            numbers=given["frames_X"],
        )
    ]


def explain_frame(v: Variant, given: Given) -> list[Step]:
    place = LETTERS.index(named_frame(v, given))
    return [
        Step(
            r"Multiply each Jacobian with the rates and compare. The angular velocity tells base axes from tool axes; the linear "
            rf"velocity tells the points apart. Your twist is {FRAMES[place]}. The four twists, one in each column:",
            r"\left[\boldsymbol\xi_a\; \boldsymbol\xi_b\; \boldsymbol\xi_c\; \boldsymbol\xi_d\right]",
            numbers=np.array(_twists(v)).T,
        )
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    arm = robot(v["form"])
    return (
        Drawing(
            arm.chain(lengths(v)),
            tuple(v["q"]),
            "Your arm at q, with the base frame and the tool frame.",
            "Arm with two revolute joints, a slide and another revolute joint, drawn at your q.",
            (Triad(np.eye(4), "0"), Triad(pose(v, {}), "tool")),
        ),
    )


def statement(v: Variant) -> str:
    return rf"""An arm with revolute joints 1, 2 and 4 and a prismatic joint 3 (RRPR) has this table in the **standard**
Denavit–Hartenberg convention, $\mathbf T_{{i-1}}^i = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$; the base frame is frame 0, the tool
frame is frame 4:

{printed_table(table_rows(robot(v["form"])))}

The same motion has a different Jacobian in each frame, and toolboxes print different ones without saying so. A frame is
named here by its **axes**, along which the components are taken, and by its **point**: the linear velocity is that of the point
of the tool body which is at that place now, where the body is imagined to be as large as needed.

- **base axes, tool point**: `jacob0` of roboticstoolbox, LOCAL_WORLD_ALIGNED of Pinocchio
- **tool axes, tool point**: `jacobe`, `jacobn` of roboticstoolbox, LOCAL of Pinocchio
- **base axes, base origin**: WORLD of Pinocchio

In the last question $\boldsymbol\xi$ (linear above angular) is the twist that some toolbox printed for the joint rates $\dot{{\mathbf q}}$."""


NO_CONSTANT_ANGLE = "Row 3 of the table: joint 3 slides, but its theta is a right angle and not zero."
DEGREES = "Angles in degrees seem to have gone into a sine or cosine that takes radians."
EXERCISE = Exercise(
    slug="frames",
    title="One Jacobian in three frames",
    source="S0 4.3, S1 5.10",
    draw=draw,
    statement=statement,
    units={
        **dict.fromkeys(LENGTHS, "m"),
        "q": ["rad", "rad", "m", "rad"],
        "qdot": ["rad/s", "rad/s", "m/s", "rad/s"],
        "xi": ["m/s"] * 3 + ["rad/s"] * 3,
    },
    symbols={"qdot": r"\dot{\mathbf{q}}"},
    scale=lambda v: sum(lengths(v).values()),
    objectives=(
        "Say of a Jacobian in which axes and at which point it is.",
        "Lead it from one frame to another by a rotation and a shift.",
    ),
    minutes=50,
    drawings=drawings,
    parts=(
        Part(
            "frames_T",
            r"The pose $\mathbf T_0^4$ of the tool frame in the base frame at your $\mathbf q$",
            2,
            Numbers((4, 4), [["1", "1", "1", "m"]] * 3 + [["1"] * 4], decimals=4),
            pose,
            mistakes=(
                Mistake(
                    "This is the base frame seen from the tool, the inverse of the asked pose.",
                    lambda v, _: np.linalg.inv(pose(v, {})),
                ),
                Mistake(NO_CONSTANT_ANGLE, lambda v, _: own_without_constant_angle(v)["frames_T"]),
                Mistake(DEGREES, lambda v, _: own_in_degrees(v)["frames_T"]),
            ),
            hints=("Multiply the four transforms of the table from left to right.",),
            explain=explain_pose,
        ),
        Part(
            "frames_J",
            r"The 6 × 4 Jacobian in base axes at the tool point, linear rows above angular rows",
            3,
            Numbers((6, 4), UNITS),
            at_tool_point,
            mistakes=(
                Mistake(
                    "Column i seems to be taken from frame i; in the standard convention the axis of joint i is z of "
                    "frame i - 1.",
                    one_frame_late,
                ),
                Mistake("This is in tool axes; base axes are asked.", lambda v, _: rotated(v, own(v))),
                Mistake("This is at the base origin; the tool point is asked.", lambda v, _: shifted(v, own(v))),
                Mistake("Column 3 looks as if joint 3 were revolute; look again at its type.", all_turning),
                Mistake("Column 3, angular rows: how fast does the tool turn while joint 3 slides?", slide_turns_too),
                Mistake(NO_CONSTANT_ANGLE, lambda v, _: own_without_constant_angle(v)["frames_J"]),
                Mistake(DEGREES, lambda v, _: own_in_degrees(v)["frames_J"]),
            ),
            hints=("The lever arm of a revolute joint ends at the tool point.", "Joint 3 slides."),
            explain=explain_jacobian,
        ),
        Part(
            "frames_tool",
            r"The 6 × 4 Jacobian in tool axes at the tool point, linear rows above angular rows",
            2,
            Numbers((6, 4), UNITS),
            rotated,
            needs=("frames_T", "frames_J"),
            mistakes=(
                Mistake("This is in base axes; tool axes are asked.", lambda _, given: given["frames_J"]),
                Mistake(
                    "The rotation is applied the wrong way round: R leads from tool axes to base axes.",
                    lambda _, given: _turned(given["frames_J"], given["frames_T"][:3, :3]),
                ),
                Mistake("Only the linear rows are turned; the angular ones have axes too.", linear_rows_only),
                Mistake(
                    "The axes are those of the tool, but the point has been moved as well; it stays the tool point.",
                    turned_and_shifted(1),
                ),
                Mistake("The point has been moved as well; it stays the tool point.", turned_and_shifted(-1)),
                Mistake("The point has been moved as well; it stays the tool point.", shifted_in_tool_axes),
                Mistake(NO_CONSTANT_ANGLE, lambda v, _: rotated(v, own_without_constant_angle(v))),
            ),
            hints=("Which way does R lead, and which way do you go?", "The point does not change."),
            explain=explain_rotated,
        ),
        Part(
            "frames_origin",
            r"The 6 × 4 Jacobian in base axes at the base origin, linear rows above angular rows",
            2,
            Numbers((6, 4), UNITS),
            shifted,
            needs=("frames_T", "frames_J"),
            mistakes=(
                Mistake(
                    "The shift has the wrong sign: how does one get from the tool point to the origin?",
                    lambda _, given: _moved(given["frames_J"], -given["frames_T"][:3, 3]),
                ),
                Mistake("This is at the tool point; the base origin is asked.", lambda _, given: given["frames_J"]),
                Mistake("This is in tool axes at the tool point; base axes at the base origin are asked.", rotated),
                Mistake("This is in tool axes; base axes are asked.", turned_and_shifted(1)),
                Mistake(
                    "The shift p is known in base axes; start from the Jacobian in base axes, not from the one in tool axes.",
                    shifted_in_tool_axes,
                ),
            ),
            hints=(
                "How do the velocities of two points of one body differ?",
                "The angular rows are those of every point.",
            ),
            explain=explain_shifted,
        ),
        Part(
            "frames_X",
            r"The 6 × 6 matrix $\mathbf X$ that turns every twist of the tool body (linear above angular), given in tool axes at the tool "
            r"point, into the same twist in base axes at the base origin; it holds for every twist, not only for those the joints can give",
            3,
            Numbers((6, 6), [["1"] * 3 + ["m"] * 3] * 3 + [["1"] * 6] * 3),
            conversion,
            needs=("frames_T",),
            mistakes=(
                Mistake(
                    "This leads the other way, from the base origin to the tool.",
                    lambda v, given: np.linalg.inv(conversion(v, given)),
                ),
                Mistake(
                    "This turns the axes but does not move the point.",
                    lambda _, given: _blocks(given["frames_T"][:3, :3], np.zeros((3, 3))),
                ),
                Mistake(
                    "The shift has the wrong sign.",
                    lambda v, given: (
                        conversion(v, given) * np.array([[1.0, -1.0], [1.0, 1.0]]).repeat(3, 0).repeat(3, 1)
                    ),
                ),
                Mistake(
                    "The shift is multiplied in the wrong order: p is known in base axes, so turn first, then shift.",
                    order_reversed,
                ),
                Mistake(
                    "This holds for the twists that your joints can give, but not for every twist; build it from R and p alone.",
                    only_for_this_arm,
                ),
                Mistake(
                    "The rotation is applied the wrong way round: R leads from tool axes to base axes.",
                    wrong_blocks(lambda R, S: (R.T, S @ R.T)),
                ),
                Mistake(
                    "The rotation is applied the wrong way round: R leads from tool axes to base axes.",
                    wrong_blocks(lambda R, S: (R.T, S @ R)),
                ),
                Mistake(
                    "The upper right block: the angular velocity comes in tool axes, too, before the shift meets it.",
                    wrong_blocks(lambda R, S: (R, S)),
                ),
                Mistake(
                    "The blocks are in the order of twists with the angular velocity first; here the linear one comes first.",
                    angular_first,
                ),
            ),
            hints=(
                "Two steps: turn the axes, then move the point.",
                "A cross product with p is a skew-symmetric matrix S(p).",
            ),
            explain=explain_conversion,
        ),
        Part(
            "frames_which",
            r"In which frame is the printed twist $\boldsymbol\xi$ of the tool body?",
            1,
            Choice(FRAMES),
            named_frame,
            needs=("frames_T", "frames_J", "frames_tool", "frames_origin"),
            hints=("Compare the angular velocities first.", "A Jacobian times the rates is a twist in the same frame."),
            explain=explain_frame,
        ),
    ),
)
