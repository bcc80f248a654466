"""S2: the planar arm with two revolute joints, by trigonometry and by transforms.

S2 prints the answers for an arm whose angles all count counter-clockwise from x. Here the arm is mounted at an angle beta,
at least one joint counts clockwise, and link 2 may stand at a right angle to link 1 where q2 = 0.
"""

import math
from collections.abc import Callable
from itertools import product as combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.chain import Chain, elementary, product
from ...solutions.expression_array import ExpressionArray, expression_array, same_formulas, sampled
from ..drawing import Dimension, Drawing, Triad, point
from ..draws import CLEARANCE, angles, length, until
from ..exercise import Exercise, ExerciseError, Formulas, Given, Mistake, Numbers, Outcome, Part, Step, Variant

Array = NDArray[np.float64]
NAMES = ("l1", "l2", "beta", "q1", "q2")
Form = tuple[int, int, int]
SENSES = ((1, -1), (-1, 1), (-1, -1))  # +1 counter-clockwise, seen against z of frame 0
FORMS: tuple[Form, ...] = tuple((*senses, offset) for senses, offset in combinations(SENSES, (0, 90, -90)))
SIGN = {1: "+", -1: "-"}
QUARTER = {0: "", 90: " + pi/2", -90: " - pi/2"}
BENT = 0.3  # smallest |sin| of q2 and of the angle between the links
UP = np.array([0.0, 0.0, 1.0])
NEAR = 2e-3  # how far rounded numbers may be from a known mistake that is followed or paid less
OMEGA = 0.2  # share of the points that a wrong angular entry costs where the linear rows are right


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of nine forms, bent, with no link near an axis of frame 0."""
    form = int(rng.integers(len(FORMS)))
    l1, l2 = until(lambda: (length(rng), length(rng)), lambda pair: abs(pair[0] - pair[1]) > 0.05)

    def clear(v: dict[str, Any]) -> bool:
        first, second = link_angles(v, form_of(v))
        bends = np.sin([v["q"][1], second - first])
        return bool((np.abs(bends) > BENT).all()) and all(
            CLEARANCE <= np.degrees(angle) % 90 <= 90 - CLEARANCE for angle in (first, second, v["q"][0] + v["q"][1])
        )

    def arm() -> dict[str, Any]:
        beta, *q = angles(rng, 3)
        return {"form": form, "l1": l1, "l2": l2, "beta": beta, "q": q}

    drawn: dict[str, Any] = until(arm, clear)
    return drawn


def form_of(v: Variant) -> Form:
    """Senses of joints 1 and 2 and the angle of link 2 to link 1 at q2 = 0 [deg]."""
    return FORMS[int(v["form"])]


def link_angles(v: Variant, form: Form) -> tuple[float, float]:
    """Angles of both links from x of frame 0 [rad]."""
    sense1, sense2, offset = form
    first = v["beta"] + sense1 * v["q"][0]
    return first, first + sense2 * v["q"][1] + math.radians(offset)


def angle_formulas(form: Form, mounting: str = "beta") -> tuple[str, str]:
    """The same as formulas."""
    sense1, sense2, offset = form
    first = f"{mounting} {SIGN[sense1]} q1"
    return first, f"{first} {SIGN[sense2]} q2{QUARTER[offset]}"


def pose_formulas(first: str, second: str) -> list[str]:
    """x, y, theta of frame 2 for the angles of both links."""
    return [f"l1*cos({first}) + l2*cos({second})", f"l1*sin({first}) + l2*sin({second})", second]


SOURCE = pose_formulas("q1", "q1 + q2")


def pose(v: Variant, _: Given) -> list[str]:
    return pose_formulas(*angle_formulas(form_of(v)))


def full_turns(v: Variant, given: Given, value: ExpressionArray) -> Outcome:
    """A check by which theta may be reduced by full turns."""
    reference = expression_array(pose(v, given), NAMES)
    turns = (sampled(value, NAMES) - sampled(reference, NAMES))[:, 2] / (2 * np.pi)
    right = same_formulas(value, reference, NAMES)
    right[2] = np.isfinite(turns).all() and np.abs(turns - np.round(turns)).max() < 1e-9
    return Outcome(right=right)


def own_angle(v: Variant, _: Given) -> list[str]:
    """Link 2 at the angle of joint 2 alone."""
    first, second = angle_formulas(form_of(v))
    return pose_formulas(first, f"0{second.removeprefix(first)}")


def exchanged(v: Variant, given: Given) -> list[str]:
    x, y, theta = pose(v, given)
    return [y, x, theta]


def derivatives(_: Variant, given: Given) -> Any:
    """The 3 x 2 Jacobian of the formulas of the pose, by differentiation."""
    import sympy  # pyright: ignore[reportMissingTypeStubs]

    q: Any = sympy.symbols("q1 q2", real=True)  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
    if same_formulas(given["planar_2r_pose"], expression_array(SOURCE, NAMES), NAMES).all():
        raise ExerciseError("nothing follows from the pose of another arm, whose Jacobian is printed in the source")
    J: Any = given["planar_2r_pose"].sympy().jacobian(q)
    if any(entry.free_symbols.isdisjoint(q) for entry in J[:2, :]):  # nothing follows from a pose that is made easy
        raise ExerciseError("x and y take formulas whose derivatives depend on q1 or q2")
    return J


def columns_formulas(form: Form, inner: tuple[int, int], d_cos: str = "-") -> list[list[str]]:
    """The Jacobian with these inner derivatives of the angles and this sign of the derivative of a cosine."""
    first, second = angle_formulas(form)
    one, two = (SIGN[sense] for sense in inner)
    return [
        [f"{one}({d_cos}1)*(l1*sin({first}) + l2*sin({second}))", f"{two}({d_cos}1)*l2*sin({second})"],
        [f"{one}(l1*cos({first}) + l2*cos({second}))", f"{two}l2*cos({second})"],
        [f"{one}1", f"{two}1"],
    ]


def first_link_only(v: Variant, _: Given) -> list[list[str]]:
    """Column 1 without the terms of link 2."""
    form = form_of(v)
    return [[first.replace("l2", "0"), second] for first, second in columns_formulas(form, form[:2])]


def linear_formulas_paid(v: Variant, given: Given, value: ExpressionArray) -> Outcome:
    """A check by which the rows of x and y are paid where only the row of theta is wrong."""
    return _less_omega(same_formulas(value, expression_array(derivatives(v, given), NAMES), NAMES))


def _less_omega(right: NDArray[np.bool_]) -> Outcome:
    """Angular entries alone are a sign each: wrong ones cost a share, but not the linear rows above them."""
    wrong = int((~right[2]).sum())
    return Outcome(share=1 - OMEGA * wrong if right[:2].all() and wrong else None)


def links(v: Variant, first: float, second: float) -> tuple[Array, Array]:
    """Frame 1 in frame 0 and frame 2 in frame 1 for the angles of both links."""
    angles_and_lengths = ((first, v["l1"]), (second - first, v["l2"]))
    elbow, hand = (elementary("Rz", angle) @ elementary("Tx", size) for angle, size in angles_and_lengths)
    return elbow, hand


def transforms(v: Variant, _: Given) -> Array:
    """Frames 1 and 2 in frame 0, (2, 4, 4)."""
    return transforms_of(v, form_of(v))


def transforms_of(v: Variant, form: Form) -> Array:
    return multiplied(*links(v, *link_angles(v, form)))


def multiplied(elbow: Array, hand: Array) -> Array:
    return np.array([elbow, elbow @ hand])


def in_wrong_order(v: Variant, _: Given) -> Array:
    elbow, hand = links(v, *link_angles(v, form_of(v)))
    return np.array([elbow, hand @ elbow])


def half_paid(v: Variant, given: Given, value: Any) -> Outcome:
    """A check by which a product in the wrong order, whose rotation is right by chance, earns nothing for it."""
    return Outcome(share=0.5 if np.abs(value - in_wrong_order(v, given)).max() <= NEAR else None)


def jacobian_from(lever: Callable[[Array, Array], tuple[Array, Array]], T: Array, senses: tuple[int, int]) -> Array:
    """6 x 2 with the lever arms that come out of the origins o1 and o2."""
    levers = lever(*T[:, :3, 3])
    columns = [s * np.concatenate([np.cross(UP, r), UP]) for s, r in zip(senses, levers, strict=True)]
    return np.array(columns).T


def to_tool(o1: Array, o2: Array) -> tuple[Array, Array]:
    return o2, o2 - o1


def jacobian(v: Variant, given: Given) -> Array:
    return jacobian_from(to_tool, given["planar_2r_T"], form_of(v)[:2])


def jacobian_of(v: Variant, form: Form) -> Array:
    """The Jacobian of the arm in another form."""
    return jacobian_from(to_tool, transforms_of(v, form), form[:2])


def senses_forgotten(_: Variant, given: Given) -> Array:
    return jacobian_from(to_tool, given["planar_2r_T"], (1, 1))


def upward_omega(v: Variant, given: Given) -> Array:
    J = jacobian(v, given)
    J[5] = 1.0
    return J


def same_reading(v: Variant, given: Given, value: Array) -> Outcome:
    """A check that follows a misread arm from its transforms on, and pays linear rows under wrong angular ones."""
    for _, read in READINGS:
        form = read(form_of(v))
        misread_T, misread_J = transforms_of(v, form), jacobian_of(v, form)
        if np.abs(given["planar_2r_T"] - misread_T).max() <= NEAR and np.abs(value - misread_J).max() <= NEAR:
            return Outcome(right=np.ones((6, 2), dtype=bool))
    right = np.abs(value - jacobian(v, given)) <= NEAR
    if not right[2:5].all():
        return Outcome()
    return _less_omega(right[[0, 1, 5]])


def explain_pose(v: Variant, given: Given) -> list[Step]:
    first, second = map(_latex, angle_formulas(form_of(v)))
    return [
        Step(
            r"Add the angles from $\mathbf x_0$ on: the mounting angle, each joint with its sense, and what stands between the "
            rf"links where $q_2 = 0$. Link 1 has the angle ${first}$, link 2 the angle ${second}$. A link of length $l$ at an "
            r"angle $\psi$ leads on by $(l \cos\psi,\; l \sin\psi)$; the tool has the angle of link 2:",
            r"\begin{bmatrix} x \\ y \\ \theta \end{bmatrix}",
            given["planar_2r_pose"].sympy(),
        )
    ]


def _latex(text: str) -> str:
    for name, symbol in (("beta", r"\beta"), ("q1", "q_1"), ("q2", "q_2"), ("pi/2", r"\frac{\pi}{2}")):
        text = text.replace(name, symbol)
    return text


def explain_derivatives(_: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Differentiate row by row: $d \cos\psi = -\sin\psi \, d\psi$ and $d \sin\psi = \cos\psi \, d\psi$, where $\psi$ "
            r"may fall as $q_i$ grows. Both links turn with $q_1$, link 2 alone with $q_2$:",
            r"\mathbf J",
            given["planar_2r_J_symbolic"].sympy(),
        )
    ]


def explain_transforms(v: Variant, given: Given) -> list[Step]:
    sense1, sense2, offset = form_of(v)
    return [
        Step(
            rf"$\mathbf T_0^1 = R_z(\beta {SIGN[sense1]} q_1)\,T_x(l_1)$ and $\mathbf T_0^2 = \mathbf T_0^1\,"
            rf"R_z({SIGN[sense2].strip('+')}q_2{_latex(QUARTER[offset])})\,T_x(l_2)$. With your numbers:",
            r"\mathbf T_0^1,\; \mathbf T_0^2",
            numbers=given["planar_2r_T"],
        )
    ]


def explain_jacobian(v: Variant, given: Given) -> list[Step]:
    sense1, sense2, _ = (f"{sign:+d}" for sign in form_of(v))
    return [
        Step(
            r"Column $i$ is $\mathbf z \times (\mathbf o_2 - \mathbf o_{i-1})$ above $\mathbf z$, where $\mathbf z$ is the axis of "
            r"joint $i$ in its positive sense and $\mathbf o_{i-1}$ the origin of frame $i-1$, which lies on it. Here "
            rf"$\mathbf z = (0, 0, {sense1})$ for joint 1 and $(0, 0, {sense2})$ for joint 2:",
            r"\mathbf J",
            numbers=given["planar_2r_J"],
        ),
        Step(
            "Rows 1, 2 and 6 are the formulas of the 3 × 2 Jacobian at your numbers; the others are zero in the plane."
        ),
    ]


def chain_of(v: Variant) -> Chain:
    """The arm with z of each joint in its positive sense."""
    sense1, sense2, offset = form_of(v)
    flip1, flip2 = (elementary("Rx", 0.0 if sense > 0 else np.pi) for sense in (sense1, sense2))
    base = elementary("Rz", v["beta"]) @ flip1
    middle = product([flip1, elementary("Tx", v["l1"]), elementary("Rz", np.radians(offset)), flip2])
    return Chain(np.stack([base, middle, flip2 @ elementary("Tx", v["l2"])]), "RR")


def drawings(v: Variant) -> tuple[Drawing, ...]:
    home = {**v, "q": [0.0, 0.0]}
    foot, knee, tip = (point(pose[:3, 3]) for pose in (np.eye(4), *transforms(home, {})))
    lines = (Dimension(foot, knee, "l1"), Dimension(knee, tip, "l2"))
    caption = "Home pose, q1 = q2 = 0, mounted at the angle beta, with the positive sense of each joint."
    return (_drawing(v, (0.0, 0.0), caption, lines), _drawing(v, tuple(v["q"]), "The same arm at your q.", ()))


def _drawing(v: Variant, q: tuple[float, ...], caption: str, lines: tuple[Dimension, ...]) -> Drawing:
    alt = f"Planar arm with two links and two revolute joints, seen from obliquely above. {caption}"
    return Drawing(chain_of(v), q, caption, alt, (Triad(np.eye(4), "0"),), lines, view=(-75.0, 52.0))


def statement(v: Variant) -> str:
    sense1, sense2, offset = form_of(v)
    turns = {1: "counter-clockwise", -1: "clockwise"}
    at_zero = {
        0: "link 2 points the way link 1 points",
        90: "link 2 stands at a right angle to link 1, 90° counter-clockwise from the way link 1 points",
        -90: "link 2 stands at a right angle to link 1, 90° clockwise from the way link 1 points",
    }
    return rf"""Two links of lengths $l_1$ and $l_2$ move in the plane of $\mathbf x_0$ and $\mathbf y_0$. Frame 0 is fixed, its origin is on the
axis of joint 1, and $\mathbf z_0$ points towards you. All turns are named as you see them from there.

- The arm is mounted at an angle: where $q_1 = 0$, link 1 points in the direction that $\mathbf x_0$ takes when it is turned by
  $\beta$ counter-clockwise (clockwise if $\beta$ is negative).
- Positive $q_1$ turns link 1 **{turns[sense1]}**.
- Positive $q_2$ turns link 2 **{turns[sense2]}** against link 1; where $q_2 = 0$, {at_zero[offset]}.

Frame 1 has its origin on the axis of joint 2, frame 2 at the tool point at the end of link 2. $\mathbf x_1$ points along link 1 and
$\mathbf x_2$ along link 2, away from the base; $\mathbf z_1$ and $\mathbf z_2$ are parallel to $\mathbf z_0$. $x$ and $y$ are the
coordinates of the tool point in frame 0, and $\theta$ is the angle from $\mathbf x_0$ to $\mathbf x_2$, counter-clockwise positive."""


MOUNTING = "The angle beta of the mounting does not seem to be in it; where does link 1 point at q1 = 0?"
SENSE = "Each joint's angle seems to count counter-clockwise; look again at the positive senses."
ONE_SENSE = "The angle of joint {} seems to be counted the other way; look again at its positive sense."
AT_ZERO = "Look again at how link 2 stands to link 1 where q2 = 0."
PRINTED = (
    "This looks like an arm whose joints both count counter-clockwise and whose links are in line at q2 = 0; "
    "look again at the positive senses and at where q2 is zero."
)
READINGS: tuple[tuple[str, Callable[[Form], Form]], ...] = (
    (SENSE, lambda form: (1, 1, form[2])),
    (ONE_SENSE.format(1), lambda form: (-form[0], form[1], form[2])),
    (ONE_SENSE.format(2), lambda form: (form[0], -form[1], form[2])),
    (AT_ZERO, lambda form: (form[0], form[1], 0 if form[2] else 90)),
    (AT_ZERO, lambda form: (form[0], form[1], -form[2] or -90)),
    (PRINTED, lambda _: (1, 1, 0)),
)  # of the arm by somebody who overlooks what makes it another than the source's


def misread(solve: Callable[[Variant, Form], Any]) -> tuple[Mistake, ...]:
    """The readings as mistakes of a part, with its answer for an arm of another form."""
    return tuple(Mistake(sentence, lambda v, _, read=read: solve(v, read(form_of(v)))) for sentence, read in READINGS)


EXERCISE = Exercise(
    slug="planar_2r",
    title="Planar arm with two joints",
    source="S2",
    draw=draw,
    statement=statement,
    units={"l1": "m", "l2": "m", "beta": "rad", "q": ["rad", "rad"]},
    scale=lambda v: v["l1"] + v["l2"],
    objectives=(
        "Write the pose of a planar arm by trigonometry and differentiate it.",
        "Reach the same Jacobian from transforms.",
    ),
    minutes=40,
    robot="planar_2r",
    drawings=drawings,
    parts=(
        Part(
            "planar_2r_pose",
            r"The pose $(x, y, \theta)$ of frame 2 in frame 0, as three formulas in `l1`, `l2`, `beta`, `q1`, `q2`, with "
            "a `*` in every product and angles in radians (`pi/2` for 90°), such as `l1*cos(q1)`",
            3,
            Formulas((3,), NAMES),
            pose,
            check=full_turns,
            hints=(
                r"Which angle does each link make with $\mathbf x_0$?",
                "A joint that counts clockwise lowers the angle of everything behind it.",
            ),
            mistakes=(
                Mistake("Link 2 seems to be at the angle of joint 2 alone; joint 1 turns it too.", own_angle),
                Mistake(MOUNTING, lambda v, _: pose_formulas(*angle_formulas(form_of(v), "0"))),
                Mistake("Sine and cosine are exchanged: which of them belongs to x?", exchanged),
                *misread(lambda _, form: pose_formulas(*angle_formulas(form))),
                Mistake(PRINTED, lambda _, __: SOURCE),
            ),
            explain=explain_pose,
        ),
        Part(
            "planar_2r_J_symbolic",
            r"The 3 × 2 Jacobian of $(x, y, \theta)$ with respect to $(q_1, q_2)$, rows in the order $x, y, \theta$, as formulas in "
            "`l1`, `l2`, `beta`, `q1`, `q2`",
            4,
            Formulas((3, 2), NAMES),
            derivatives,
            check=linear_formulas_paid,
            needs=("planar_2r_pose",),
            hints=(
                "The derivative of an angle sum with respect to one joint may be negative.",
                r"Which links move when only $q_2$ changes?",
            ),
            mistakes=(
                Mistake(
                    "The derivative of the cosine is the sine with a minus sign; look again at the row of x.",
                    lambda v, _: columns_formulas(form_of(v), form_of(v)[:2], d_cos="+"),
                ),
                Mistake(
                    "A factor of the chain rule seems to be missing: the derivative of each angle with respect to q1 or q2.",
                    lambda v, _: columns_formulas(form_of(v), (1, 1)),
                ),
                Mistake("A term of column 1 is missing: joint 1 moves link 2 as well.", first_link_only),
                *misread(lambda _, form: columns_formulas(form, form[:2])),
            ),
            explain=explain_derivatives,
        ),
        Part(
            "planar_2r_T",
            r"The transforms $\mathbf T_0^1$ and $\mathbf T_0^2$ (poses of frames 1 and 2 in frame 0) at your $\mathbf q$, stacked to an "
            "array 2 × 4 × 4",
            3,
            Numbers((2, 4, 4), [[["1", "1", "1", "m"]] * 3 + [["1"] * 4]]),
            transforms,
            check=half_paid,
            hints=("Turn first, then go along the link.", r"$\mathbf T_0^2 = \mathbf T_0^1\,\mathbf T_1^2$"),
            mistakes=(
                Mistake(
                    "The second transform seems to start at frame 1; both shall start at frame 0.",
                    lambda v, _: np.array(links(v, *link_angles(v, form_of(v)))),
                ),
                Mistake("The two transforms seem to be multiplied in the wrong order.", in_wrong_order),
                Mistake(MOUNTING, lambda v, given: transforms({**v, "beta": 0.0}, given)),
                *misread(transforms_of),
            ),
            explain=explain_transforms,
        ),
        Part(
            "planar_2r_J",
            r"The 6 × 2 Jacobian $\mathbf J$ of the tool point in the axes of frame 0 at your $\mathbf q$, rows "
            r"$v_x, v_y, v_z, \omega_x, \omega_y, \omega_z$, from the transforms",
            3,
            Numbers((6, 2), [["m/rad"]] * 3 + [["1"]] * 3),
            jacobian,
            check=same_reading,
            needs=("planar_2r_T",),
            hints=(
                "The axis of a joint that counts clockwise points the other way.",
                "Compare with your formulas at your numbers.",
            ),
            mistakes=(
                Mistake(SENSE, senses_forgotten),
                Mistake(
                    "The lever arm of column 2 seems to start at the base; it starts at joint 2.",
                    lambda v, given: jacobian_from(lambda _, o2: (o2, o2), given["planar_2r_T"], form_of(v)[:2]),
                ),
                Mistake(
                    "The lever arm of column 1 seems to end at joint 2; it ends at the tool point.",
                    lambda v, given: jacobian_from(lambda o1, o2: (o1, o2 - o1), given["planar_2r_T"], form_of(v)[:2]),
                ),
                Mistake(
                    "Both angular columns seem to turn counter-clockwise; look again at the positive senses.",
                    upward_omega,
                ),
                *misread(jacobian_of),
            ),
            explain=explain_jacobian,
        ),
    ),
)
