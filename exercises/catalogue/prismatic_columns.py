"""S1 5.27: the column of a prismatic joint, in the last frame and in the base, on the Stanford arm."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.jacobian import jacobian
from ...solutions.jacobian import last_frame_columns as last_frame
from ...solutions.robots import ROBOTS
from ..answers import LETTERS
from ..drawing import Drawing, Triad
from ..draws import angles, length, until
from ..exercise import Choice, Exercise, Given, Mistake, Numbers, Outcome, Part, Step, Variant

Array = NDArray[np.float64]
ROBOT = ROBOTS["stanford_spong"]
LENGTHS = ("d2", "d6")
SLIDE = 2  # index of joint 3
SHOWS = 0.05  # by which a mistake changes a column
TOLERANCE = 2e-3  # of the entries of J: three decimals, from transforms and a column that were rounded
WEIGHT = 0.4  # of column 3 in the points for J: what this exercise is about
CHANGES = (
    ("every length and linear velocity is given in millimetres, the stroke $q_3$ and its rate too", "b"),
    ("only the rate of joint 3 is given in millimetres per second, and nothing else changes", "d"),
    ("only the rates of the revolute joints are given in degrees per second; twists stay in m/s and rad/s", "e"),
)
UNIT_OPTIONS = (
    "all entries of the linear rows are multiplied by 1000, the angular rows stay",
    "the linear rows of the revolute columns are multiplied by 1000, column 3 and the angular rows stay",
    "column 3 is multiplied by 1000, all other columns stay",
    "column 3 is divided by 1000, all other columns stay",
    r"the revolute columns are multiplied by $\pi/180$ in all six rows, column 3 stays",
    r"the revolute columns are multiplied by $180/\pi$ in all six rows, column 3 stays",
)
RIGHT_REASON = "A slide moves all points of the hand alike, so that it does not matter where the point lies"
REASONS = (
    "The slide passes through the origin of frame 2, so that its lever arm is zero",
    "The lengths cancel at the drawn posture; at other postures they appear",
    RIGHT_REASON,
    "Joint 3 stands in front of the wrist, and only lengths behind the wrist count",
)


def lengths(v: Variant) -> dict[str, float]:
    return {name: v[name] for name in LENGTHS}


def frames(v: Variant) -> Array:
    """Frames 0 to 6 in the base, (7, 4, 4)."""
    return ROBOT.frames(lengths(v), v["q"])


def transforms(v: Variant, _: Given) -> Array:
    return frames(v)


def to_last_frame(given: Given) -> Array:
    """The pose of frame 6 in frame 2, (4, 4)."""
    poses: Array = given["prismatic_columns_frames"]
    return np.linalg.inv(poses)[SLIDE] @ poses[-1]


def last_column(_: Variant, given: Given) -> Array:
    return last_frame(to_last_frame(given)[None], "P")[:, 0]


def turning_last_column(_: Variant, given: Given) -> Array:
    return last_frame(to_last_frame(given)[None], "R")[:, 0]


def third_column_of_rotation(_: Variant, given: Given) -> Array:
    """The entries of a for the third entries of n, o and a."""
    return np.concatenate([to_last_frame(given)[:3, 2], np.zeros(3)])


def base_column(_: Variant, given: Given) -> Array:
    return np.concatenate([given["prismatic_columns_frames"][SLIDE, :3, 2], np.zeros(3)])


def turning_base_column(_: Variant, given: Given) -> Array:
    poses: Array = given["prismatic_columns_frames"]
    z = poses[SLIDE, :3, 2]
    return np.concatenate([np.cross(z, poses[-1, :3, 3] - poses[SLIDE, :3, 3]), z])


def with_axis_below(solve: Callable[[Variant, Given], Array]) -> Callable[[Variant, Given], Array]:
    """The axis in the angular rows, too."""
    return lambda v, given: np.tile(solve(v, given)[:3], 2)


def with_stroke(solve: Callable[[Variant, Given], Array]) -> Callable[[Variant, Given], Array]:
    """The column times q3, as a position has it."""
    return lambda v, given: solve(v, given) * float(v["q"][SLIDE])


def axis_before(_: Variant, given: Given) -> Array:
    return np.concatenate([given["prismatic_columns_frames"][SLIDE - 1, :3, 2], np.zeros(3)])


def whole(_: Variant, given: Given) -> Array:
    """All columns from the frames, the third from the student's own answer."""
    poses: Array = given["prismatic_columns_frames"]
    J = all_turning(poses)
    J[:, SLIDE] = given["prismatic_columns_base"]
    return J


def all_turning(poses: Array) -> Array:
    """The Jacobian (6, 6) as if every joint were revolute."""
    z, o = poses[:-1, :3, 2], poses[:-1, :3, 3]
    return np.concatenate([np.cross(z, poses[-1, :3, 3] - o), z], axis=1).T


def with_turning_slide(_: Variant, given: Given) -> Array:
    return all_turning(given["prismatic_columns_frames"])


def with_slide_turning_too(v: Variant, given: Given) -> Array:
    J = whole(v, given)
    J[3:, SLIDE] = J[:3, SLIDE]
    return J


def whole_with_stroke(v: Variant, given: Given) -> Array:
    J = whole(v, given)
    J[:, SLIDE] *= v["q"][SLIDE]
    return J


def weighed(v: Variant, given: Given, value: Array) -> Outcome:
    """Column 3 earns its weight as a whole, the others share the rest; a wrong zero or one voids its column."""
    J = whole(v, given)
    right = np.abs(value - J) <= TOLERANCE
    earning = (np.abs(np.abs(J)[..., None] - (0.0, 1.0)) > TOLERANCE).all(-1)
    earned = right & earning & (right | earning).all(axis=0)
    rest = float(np.delete(earned, SLIDE, 1).sum() / np.delete(earning, SLIDE, 1).sum())
    share = (1 - WEIGHT) * rest + WEIGHT * float(right[:, SLIDE].all())
    return Outcome(right, share=1.0 if right.all() else share)


def one_frame_late(_: Variant, given: Given) -> Array:
    """Columns from frame i in place of frame i - 1."""
    poses: Array = given["prismatic_columns_frames"]
    J = all_turning(np.concatenate([poses[1:], poses[-1:]]))
    J[:, SLIDE] = np.concatenate([poses[SLIDE + 1, :3, 2], np.zeros(3)])
    return J


def in_last_frame(v: Variant, _: Given) -> Array:
    return jacobian(ROBOT.chain(lengths(v)), v["q"], frame="tool")


def base_axes(v: Variant, _: Given) -> Array:
    return jacobian(ROBOT.chain(lengths(v)), v["q"])[:, SLIDE]


def last_axes(v: Variant, _: Given) -> Array:
    return in_last_frame(v, {})[:, SLIDE]


def letter_of_reason(v: Variant, _: Given) -> str:
    order: list[int] = v["reasons"]
    return LETTERS[[REASONS[k] for k in order].index(RIGHT_REASON)]


def letter_of_change(v: Variant, _: Given) -> str:
    letter: str = CHANGES[int(v["change"])][1]
    return letter


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A posture in which column 3 looks the same in no two readings, a change of units, and an order of the reasons."""
    change = int(rng.integers(len(CHANGES)))

    def drawn() -> dict[str, Any]:
        sizes = {"d2": length(rng, 0.1, 0.4), "d6": length(rng, 0.1, 0.4)}
        return {"change": change, **sizes, "q": [*angles(rng, 2), length(rng), *angles(rng, 3)]}

    v = until(drawn, shows_mistakes)
    return {**v, "reasons": [int(k) for k in rng.permutation(len(REASONS))]}


def shows_mistakes(v: Variant) -> bool:
    """Whether every known mistake changes column 3."""
    given = {"prismatic_columns_frames": frames(v)}
    right = (last_column(v, given), base_column(v, given))
    wrong = (
        (
            turning_last_column(v, given),
            third_column_of_rotation(v, given),
            right[1],
            with_stroke(last_column)(v, given),
        ),
        (turning_base_column(v, given), axis_before(v, given), right[0], with_stroke(base_column)(v, given)),
    )
    return min(np.abs(a - b).max() for a, others in zip(right, wrong, strict=True) for b in others) > SHOWS


def explain_last(_: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Joint 3 slides along $\mathbf z_2$. Its column in the axes of frame 6 comes from $\mathbf T_2^{6}$, the product of rows 3 to 6, "
            r"with the columns $\mathbf n, \mathbf o, \mathbf a, \mathbf p$:",
            r"\mathbf T_2^{6}",
            numbers=to_last_frame(given),
        ),
        Step(
            r"It is $(n_z, o_z, a_z, 0, 0, 0)$: the third row of the rotation, which is $\mathbf z_2$ in the axes of frame 6, above "
            r"zeros, since a slide does not turn the hand:",
            r"\mathbf J_3^{6}",
            numbers=given["prismatic_columns_last"],
        ),
    ]


def explain_base(_: Variant, given: Given) -> list[Step]:
    closed = ROBOT.symbolic()
    return [
        Step(
            r"In base axes the column is $\mathbf z_2$ above zeros, and $\mathbf z_2$ is the third column of the rotation in $\mathbf T_0^{2}$:",
            r"\mathbf J_3^{0}",
            closed.J[:, SLIDE],
        ),
        Step("With your numbers:", r"\mathbf J_3^{0}", numbers=given["prismatic_columns_base"]),
    ]


def explain_whole(_: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"The other joints are revolute: column $i$ is $\mathbf z_{i-1} \times (\mathbf o_6 - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$. The axes "
            r"$\mathbf z_0 \ldots \mathbf z_5$ as columns:",
            r"\left[\mathbf z_0 \cdots \mathbf z_5\right]",
            numbers=given["prismatic_columns_frames"][:6, :3, 2].T,
        ),
        Step(
            r"The origins $\mathbf o_0 \ldots \mathbf o_6$ as columns:",
            r"\left[\mathbf o_0 \cdots \mathbf o_6\right]",
            numbers=given["prismatic_columns_frames"][:, :3, 3].T,
        ),
        Step("With column 3 from above:", r"\mathbf J^{0}", numbers=given["prismatic_columns_J"]),
    ]


def explain_reason(v: Variant, _: Given) -> list[Step]:
    return [
        Step(
            rf"Reason {LETTERS.index(letter_of_reason(v, {})) + 1}. The column of a revolute joint holds $\mathbf z \times \mathbf r$ with "
            r"the way $\mathbf r$ from its axis to the point, and so lengths. A slide gives every point of the hand the same velocity "
            r"$\mathbf z_2$ per unit of its rate: no way $\mathbf r$ stands in it, at any posture."
        )
    ]


def explain_change(v: Variant, _: Given) -> list[Step]:
    why = {
        "b": "Lengths in the linear rows of the revolute columns are 1000 times as large. Column 3 is a velocity per velocity, "
        "mm/s per mm/s, and has no unit; nor have the angular rows.",
        "d": "The rate of joint 3 is 1000 times as large a number for the same motion, so its column is a thousandth; twist and other "
        "rates are the same numbers as before.",
        "e": r"A rate in degrees per second is $180/\pi$ times the number in radians per second for the same motion, so the revolute columns "
        r"are $\pi/180$ times as large, in linear and angular rows. Column 3 belongs to a rate in m/s.",
    }
    return [
        Step(
            r"An entry of column $i$ has the unit of its twist component over that of rate $i$: m/rad and 1 for a revolute joint, 1 and 1/m for a "
            rf"prismatic one. {why[letter_of_change(v, {})]}"
        )
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    return (
        Drawing(
            ROBOT.chain(lengths(v)),
            tuple(v["q"]),
            "Your Stanford arm at your q, with frame 0 and frame 6.",
            "Stanford arm: two revolute joints, a slide and a wrist of three revolute joints, drawn at your q.",
            (Triad(np.eye(4), "0"), Triad(frames(v)[-1], "6")),
            arrows=False,
        ),
    )


def statement(v: Variant) -> str:
    reasons = "\n".join(f"- **reason {i}**: {REASONS[k]}." for i, k in enumerate(v["reasons"], 1))
    return rf"""In the Stanford arm joint 3 is a slide. Its table in the **standard** Denavit–Hartenberg convention:

| $i$ | $\theta_i$ | $d_i$ | $a_i$ | $\alpha_i$ |
|:-:|:-:|:-:|:-:|:-:|
| 1 | $q_1$ | 0 | 0 | $-\pi/2$ |
| 2 | $q_2$ | $d_2$ | 0 | $\pi/2$ |
| 3 | 0 | $q_3$ | 0 | 0 |
| 4 | $q_4$ | 0 | 0 | $-\pi/2$ |
| 5 | $q_5$ | 0 | 0 | $\pi/2$ |
| 6 | $q_6$ | $d_6$ | 0 | 0 |

The point whose velocity is meant is the origin of frame 6. $\mathbf J^{{0}}$ is its Jacobian in base axes (frame 0), $\mathbf J^{{6}}$
that of the same point in the axes of frame 6. In both the linear rows stand above the angular ones.

Why does column 3 hold no lengths? One of these reasons is right:

{reasons}

For the question about units: **{CHANGES[int(v["change"])][0]}**."""


STROKE = "The stroke itself does not belong there: what moves the hand is the rate of joint 3."
COLUMN = Numbers((6,), "1", decimals=3)
EXERCISE = Exercise(
    slug="prismatic_columns",
    title="The column of a prismatic joint",
    source="S1 5.10, eq. 5.27",
    draw=draw,
    statement=statement,
    units={**dict.fromkeys(LENGTHS, "m"), "q": ["rad", "rad", "m", "rad", "rad", "rad"]},
    scale=lambda v: v["d2"] + v["d6"] + v["q"][SLIDE],
    objectives=(
        "Write down the column of a prismatic joint in the last frame and in the base.",
        "Tell which entries of a Jacobian hold lengths, and in which units they are.",
    ),
    minutes=40,
    robot=ROBOT.name,
    drawings=drawings,
    parts=(
        Part("prismatic_columns_frames", "", 0, Numbers((7, 4, 4)), transforms, asked=False),
        Part(
            "prismatic_columns_last",
            r"Column 3 of $\mathbf J^{6}$ at your $\mathbf q$, in the axes of frame 6: six numbers, linear rows first",
            2,
            COLUMN,
            last_column,
            needs=("prismatic_columns_frames",),
            mistakes=(
                Mistake("Which formula belongs to a slide? Look again at the type of joint 3.", turning_last_column),
                Mistake(
                    "The angular rows: how fast does the hand turn while only joint 3 slides?",
                    with_axis_below(last_column),
                ),
                Mistake(
                    "n, o and a are the columns of the rotation; the formula takes one entry of each.",
                    third_column_of_rotation,
                ),
                Mistake("This is in base axes; the axes of frame 6 are asked.", base_axes),
                Mistake(STROKE, with_stroke(last_column)),
            ),
            hints=("Column 3 takes the pose of frame 6 in frame 2.", "A slide does not turn the hand."),
            explain=explain_last,
        ),
        Part(
            "prismatic_columns_base",
            r"Column 3 of $\mathbf J^{0}$ at your $\mathbf q$, in base axes: six numbers, linear rows first",
            2,
            COLUMN,
            base_column,
            needs=("prismatic_columns_frames",),
            mistakes=(
                Mistake("Which formula belongs to a slide? Look again at the type of joint 3.", turning_base_column),
                Mistake(
                    "The angular rows: how fast does the hand turn while only joint 3 slides?",
                    with_axis_below(base_column),
                ),
                Mistake("The axis of joint i is z of frame i - 1; this one belongs to another joint.", axis_before),
                Mistake("This is in the axes of frame 6; base axes are asked.", last_axes),
                Mistake(STROKE, with_stroke(base_column)),
            ),
            hints=("Along which axis does joint 3 slide?",),
            explain=explain_base,
        ),
        Part(
            "prismatic_columns_J",
            r"The whole 6 × 6 Jacobian $\mathbf J^{0}$ at your $\mathbf q$, linear rows above angular rows",
            4,
            Numbers(
                (6, 6),
                [["m/rad", "m/rad", "1", "m/rad", "m/rad", "m/rad"]] * 3 + [["1"] * 6] * 3,
                decimals=3,
            ),
            whole,
            needs=("prismatic_columns_base", "prismatic_columns_frames"),
            mistakes=(
                Mistake("Column 3 looks as if joint 3 were revolute; look again at its type.", with_turning_slide),
                Mistake(
                    "Column 3, angular rows: how fast does the hand turn while only joint 3 slides?",
                    with_slide_turning_too,
                ),
                Mistake(
                    "Column i seems to be taken from frame i; in the standard convention the axis of joint i is z of "
                    "frame i - 1.",
                    one_frame_late,
                ),
                Mistake("This is in the axes of frame 6; base axes are asked.", in_last_frame),
                Mistake(f"Column 3: {STROKE[:1].lower()}{STROKE[1:]}", whole_with_stroke),
            ),
            check=weighed,
            tolerance=TOLERANCE,
            hints=(
                "Frames 2 and 3 have the same axes, but not the same origin.",
                "The lever arm of every revolute column ends at the origin of frame 6.",
            ),
            explain=explain_whole,
        ),
        Part(
            "prismatic_columns_why",
            r"Which of the four reasons on the sheet says why no length, neither $d_2$ nor $d_6$ nor $q_3$, stands in column 3, though "
            r"lengths stand in the linear rows of columns 1 and 2?",
            1,
            Choice(tuple(f"reason {i}" for i in range(1, len(REASONS) + 1))),
            letter_of_reason,
            hints=("Let only joint 3 move, and compare the velocities of two points of the hand.",),
            explain=explain_reason,
        ),
        Part(
            "prismatic_columns_units",
            r"What becomes of $\mathbf J^{0}$ when units change as the sheet says, so that $\mathbf J^{0} \dot{\mathbf q}$ is the twist of the "
            r"same motion in the new units?",
            2,
            Choice(UNIT_OPTIONS),
            letter_of_change,
            hints=(
                "The motion is the same: which rates and which twist components become other numbers?",
                "An entry has the unit of its row over the unit of its rate.",
            ),
            explain=explain_change,
        ),
    ),
)
