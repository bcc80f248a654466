"""S1 5.10, Example 2.25: the linear rows of a Jacobian by differentiating the position of the hand.

S1 prints the position and the first row for an arm on the floor. Here the mounting, the zeros of joints 1 and 2 and the
sense of joints 2 to 4 are drawn, and the shoulder stands beside axis 1, so that none of those rows is the answer.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.expression_array import ExpressionArray, expression_array, same_formulas
from ..arms.articulated import (
    LENGTHS,
    MOUNTED,
    NAMES,
    PRINTED,
    STRUCTURES,
    coordinates,
    derivatives,
    position,
    row,
    structure_of,
)
from ..draws import angles, length, until
from ..exercise import Choice, Exercise, Formulas, Given, Mistake, Numbers, Outcome, Part, Step, Variant

Array = NDArray[np.float64]
ROWS = tuple(f"articulated_derivatives_{x}" for x in "xyz")
POINTS: tuple[tuple[Callable[[int, int], str], str], ...] = (  # of two distances in centimetres
    (lambda far, _: rf"$Q$ is a point of the gripper. Seen from $\mathbf p$ it lies 0.{far} m along axis 6", "c"),
    (
        lambda far, near: (
            rf"$Q$ is a point of the gripper. Seen from $\mathbf p$ it lies 0.{far} m along axis 6 and 0.0{near} m beside that axis"
        ),
        "e",
    ),
    (lambda far, _: f"$Q$ is a point of the link between joints 4 and 5, 0.{far} m away from axis 5", "b"),
)
OPTIONS = (
    "both are zero: joints of the wrist turn the hand and move no point of it",
    "both are zero: neither joint moves the link that Q belongs to",
    "column 5 is not zero, column 6 is zero: Q lies on axis 6, but not on axis 5",
    "column 5 is zero, column 6 is not zero: Q lies on axis 5, but not on axis 6",
    "neither is zero: Q lies on neither axis, and both joints carry it along",
)


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one structure with a hand that every joint moves, and a point for the last question."""
    structure, asked = int(rng.integers(len(STRUCTURES))), int(rng.integers(len(POINTS)))
    away = [int(rng.integers(11, 30)), int(rng.integers(3, 9))]

    def drawn() -> dict[str, Any]:
        v: dict[str, Any] = {"structure": structure, "point": asked, "away": away}
        v |= {"d1": length(rng), "a1": length(rng, 0.2, 0.5), "a2": length(rng), "a3": length(rng)}
        return v | {"a4": length(rng, 0.2, 0.6), "q": angles(rng, 6, [(1, 2), (1, 2, 3)])}

    def every_joint_moves_it(v: Variant) -> bool:
        J = at_numbers(v, {name: row(v, i) for i, name in enumerate(ROWS)})
        return bool((np.linalg.norm(J[:, :4], axis=0) > 0.2).all())

    return until(drawn, every_joint_moves_it)


def signs_forgotten(v: Variant, i: int) -> ExpressionArray:
    """No minus in the derivative of a cosine; in a coordinate without cosines, one in that of a sine."""
    turn, lift = coordinates(*structure_of(v))[i]
    cosines = "cos" in (lift[1], turn[1] if turn else "")
    return row(v, i, slopes={"cos": (1, "sin"), "sin": (1 if cosines else -1, "cos")})


def wrist_counted(v: Variant, i: int) -> ExpressionArray:
    """Columns 5 and 6 like column 4."""
    entries = row(v, i).entries
    return ExpressionArray((*entries[:4], entries[3], entries[3]), (6,))


def at_numbers(v: Variant, given: Given) -> Array:
    """The three rows at the student's lengths and q."""
    values = {**{name: v[name] for name in LENGTHS}, **{f"q{i}": x for i, x in enumerate(v["q"], 1)}}
    return np.stack([np.broadcast_to(given[name].at(values), 6) for name in ROWS])


def with_single_angles(v: Variant, _: Given) -> Array:
    """The rows with q3 for q2 + q3 and q4 for q2 + q3 + q4."""
    return at_numbers(v, {name: row(v, i, sums={2: "q2", 3: "q3", 4: "q4"}) for i, name in enumerate(ROWS)})


def shared(i: int) -> Callable[[Variant, Given, ExpressionArray], Outcome]:
    """Each right derivative earns its share, each wrong zero costs one."""

    def check(v: Variant, _: Given, value: ExpressionArray) -> Outcome:
        wanted = row(v, i)
        right = same_formulas(value, wanted, NAMES)
        earning = np.array([bool(entry.names) for entry in wanted.entries])
        share = int((right & earning).sum()) - int((~right & ~earning).sum())
        return Outcome(share=max(0, share) / int(earning.sum()))

    return check


def point_letter(v: Variant, _: Given) -> str:
    return POINTS[int(v["point"])][1]


def explain_row(i: int) -> Callable[[Variant, Given], list[Step]]:
    def explain(v: Variant, given: Given) -> list[Step]:
        x = "xyz"[i]
        return [
            Step(
                rf"Row {i + 1} holds the derivatives of $p_{x}$. An angle such as $q_2 + q_3 + q_4$ changes with each of its joints, "
                r"so $q_2$ moves the links $a_2, a_3, a_4$, $q_3$ the links $a_3, a_4$ and $q_4$ the link $a_4$; "
                r"the derivative of a cosine is minus the sine, that of a sine the cosine.",
                rf"p_{x}",
                expression_array(position(v), NAMES).sympy()[i],
            ),
            Step(
                r"The columns are the derivatives by $q_1 \ldots q_6$. Where $q_j$ does not stand in the formula, the entry is zero:",
                rf"\mathbf J_{{{i + 1}}}",
                given[ROWS[i]].sympy().T,
            ),
        ]

    return explain


def explain_numbers(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            "The three rows with your numbers, the angles added before a sine or cosine is taken:",
            r"\mathbf J_v",
            numbers=given["articulated_derivatives_J"],
        )
    ]


def explain_point(v: Variant, _: Given) -> list[Step]:
    reasons = {
        "b": "Joints 5 and 6 come behind that link: whatever they do, it stays where it is. Both columns are zero.",
        "c": "Turning about axis 6 leaves a point on axis 6 where it is, but axis 5 crosses axis 6 in p and not in Q: joint 5 "
        "moves Q. Only column 6 is zero.",
        "e": "Q lies on neither axis and belongs to the gripper, so both joints move it.",
    }
    return [
        Step(
            r"Column $i$ of the linear rows is $\mathbf z_{i-1} \times (\mathbf p - \mathbf o_{i-1})$: it is zero for a point on the "
            r"axis of joint $i$, and for every point of the links in front of that joint. $\mathbf p$ lies on axes 5 and 6, which "
            rf"cross there, so both its columns are zero. {reasons[point_letter(v, {})]}"
        )
    ]


def statement(v: Variant) -> str:
    p = r" \\ ".join(position(v, latex=True))
    return rf"""The arm has six revolute joints and {MOUNTED[structure_of(v)[0]]}. $\mathbf p$ is the point in which axes 5 and 6 cross, the
origin of frame 6. In base axes it is

$$\mathbf p = \begin{{bmatrix}} p_x \\ p_y \\ p_z \end{{bmatrix}} = \begin{{bmatrix}} {p} \end{{bmatrix}}$$

with $C_1 = \cos q_1$, $S_2 = \sin q_2$, $C_{{23}} = \cos(q_2 + q_3)$, $S_{{234}} = \sin(q_2 + q_3 + q_4)$ and so on. The linear
rows $\mathbf J_v$ of its Jacobian, $\dot{{\mathbf p}} = \mathbf J_v \dot{{\mathbf q}}$, are its derivatives: the entry in row $x$ and column
$j$ is the derivative of $p_x$ with respect to $q_j$. Start from $\mathbf p$ as it is printed here; how the arm is mounted and where
its joints are zero is personal.

For the last question: {POINTS[v["point"]][0](*v["away"])}."""


WRITTEN = (
    "with a * in every product and angles in radians, such as `a2*C2 + a3*C23`; C23 and S234 are read as on the sheet"
)


def row_part(i: int) -> Part:
    x = "xyz"[i]
    return Part(
        ROWS[i],
        rf"Row {i + 1} of $\mathbf J_v$: the derivatives of $p_{x}$ with respect to $q_1, \ldots, q_6$, a list of six formulas as texts in "
        f"d1, a1, a2, a3, a4 and q1 to q6, {WRITTEN if i == 0 else 'written as in row 1'}",
        2,
        Formulas((6,), NAMES),
        lambda v, _: row(v, i),
        check=shared(i),
        mistakes=(
            Mistake(
                r"Look again at the angles that are sums: which links move when q2 alone changes?",
                lambda v, _: row(v, i, terms={2: (2,), 3: (3,), 4: (4,)}),
            ),
            Mistake(
                "Column 2: an angle that is a sum of three joints depends on each of them.",
                lambda v, _: row(v, i, terms={2: (2, 3), 3: (3, 4), 4: (4,)}),
            ),
            Mistake(
                "Look again at the signs: one of sine and cosine takes a minus when it is differentiated.",
                lambda v, _: signs_forgotten(v, i),
            ),
            Mistake("Columns 5 and 6: which joints stand in p?", lambda v, _: wrist_counted(v, i)),
            Mistake(
                "This is the row of the arm on the slides, which stands otherwise; start from p as your sheet prints it.",
                lambda _, __: derivatives(PRINTED[i], shoulder=False),
            ),
        ),
        hints=(
            "All other joint variables are constants while you differentiate by one of them.",
            "Write down first which terms of the coordinate hold that joint variable.",
        ),
        explain=explain_row(i),
    )


EXERCISE = Exercise(
    slug="articulated_derivatives",
    title="The Jacobian of an articulated arm by differentiation",
    source="S1 5.10",
    draw=draw,
    statement=statement,
    units={**dict.fromkeys(LENGTHS, "m"), "q": ["rad"] * 6},
    scale=lambda v: sum(v[name] for name in LENGTHS),
    objectives=(
        "Differentiate the position of the hand with respect to every joint variable.",
        "Tell from the axes of an arm which entries of its Jacobian are zero.",
    ),
    minutes=40,
    robot="articulated_6r",
    parts=(
        *(row_part(i) for i in range(3)),
        Part(
            "articulated_derivatives_J",
            r"The linear block $\mathbf J_v$ at your $\mathbf q$ and with your lengths, a 3 × 6 matrix with the rows $x, y, z$ of the base frame",
            3,
            Numbers((3, 6), "m/rad", decimals=3),
            at_numbers,
            needs=ROWS,
            mistakes=(
                Mistake(
                    "Which angle does the index 234 stand for? Look again at the letters that the sheet explains.",
                    with_single_angles,
                ),
            ),
            hints=("C23 takes the sum of two of your angles, in radians.",),
            explain=explain_numbers,
        ),
        Part(
            "articulated_derivatives_point",
            r"For $\mathbf p$ the columns 5 and 6 of $\mathbf J_v$ are zero. Which statement about columns 5 and 6 of the linear rows is right for "
            r"the point $Q$, in a general posture?",
            2,
            Choice(OPTIONS),
            point_letter,
            hints=(
                "A point on a joint's axis does not move when that joint turns.",
                "Which links does a joint carry along?",
            ),
            explain=explain_point,
        ),
    ),
)
