"""The pose of the planar arm and its derivatives as formulas, for an arm of any form.

A form is the sense of each joint, +1 counter-clockwise, seen against z of frame 0, and the angle
from link 1 to link 2 where q2 = 0 [quarter turns].
"""

from collections.abc import Callable
from dataclasses import replace
from itertools import product

from ...solutions.expression_array import ExpressionArray, expression_array, same_formulas
from ..contract.printed_table import cell_latex
from ..exercise import Outcome

NAMES = ("l1", "l2", "beta", "q1", "q2")
SENSES = ((1, -1), (-1, 1), (-1, -1), (1, 1))
FORMS = tuple((one, two, quarter) for (one, two), quarter in product(SENSES, (0, 1, -1)))
SIGN = {1: "+", -1: "-"}
QUARTER = {0: "", 1: " + pi/2", -1: " - pi/2"}


def angle_formulas(form: int, mounting: str = "beta") -> tuple[str, str]:
    """Angles of both links from x of frame 0."""
    one, two, quarter = FORMS[form]
    first = f"{mounting} {SIGN[one]} q1"
    return first, f"{first} {SIGN[two]} q2{QUARTER[quarter]}"


def bend_formula(form: int) -> str:
    """What link 2 turns from link 1, with its sign in front, such as -q2 + pi/2."""
    first, second = angle_formulas(form)
    return second.removeprefix(first).replace(" ", "", 2)


def pose(form: int, mounting: str = "beta") -> list[str]:
    """x, y, theta of frame 2 in frame 0, for an arm mounted at this angle."""
    return pose_formulas(*angle_formulas(form, mounting))


def pose_formulas(first: str, second: str) -> list[str]:
    """x, y, theta of frame 2 for the angles of both links."""
    return [f"l1*cos({first}) + l2*cos({second})", f"l1*sin({first}) + l2*sin({second})", second]


def link_2_alone(form: int) -> list[str]:
    """The pose of an arm whose link 2 does not turn with joint 1."""
    return pose_formulas(angle_formulas(form)[0], f"0{bend_formula(form)}")


def exchanged(form: int) -> list[str]:
    """The pose with x for y."""
    x, y, theta = pose(form)
    return [y, x, theta]


SOURCE = pose_formulas("q1", "q1 + q2")
ANGLES: dict[str, Callable[[int], str]] = {
    "angle1": lambda form: cell_latex(angle_formulas(form)[0]),
    "angle2": lambda form: cell_latex(angle_formulas(form)[1]),
    "bend": lambda form: cell_latex(bend_formula(form).strip("+")),
}  # of both links and between them, in LaTeX


def less_source(found: Outcome, value: ExpressionArray) -> Outcome:
    """What was found of a pose; the one that the source prints earns nothing."""
    if same_formulas(value, expression_array(SOURCE, NAMES), NAMES).all():
        return replace(found, share=0.0)
    return found


def slopes(form: int, inner: tuple[int, ...] = (), minus: int = -1) -> list[list[str]]:
    """The 3 x 2 Jacobian of the pose.

    It is wrong with other `inner` derivatives of the angles than the senses of the joints, and
    with another `minus` than that of the derivative of a cosine.
    """
    x, y, second = pose(form)
    one, two = inner or FORMS[form][:2]
    return [
        [f"{minus * one}*({y})", f"{minus * two}*l2*sin({second})"],
        [f"{one}*({x})", f"{two}*l2*cos({second})"],
        [str(one), str(two)],
    ]


def without_link_2(form: int) -> list[list[str]]:
    """The Jacobian of an arm whose joint 1 does not move link 2."""
    return [[one.replace("l2", "0"), two] for one, two in slopes(form)]
