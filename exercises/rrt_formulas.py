"""The RRT robot of S3 5.4.1 in formulas: Jacobian, determinant of its linear block, singular postures.

What follows from a student's own table or Jacobian is put together from formulas, never simplified: it is compared,
not printed.
"""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

from ..solutions.errors import KinegradeError
from ..solutions.expression import Expression, parse
from ..solutions.expression_array import POINTS, ExpressionArray, expression_array, sample
from ..solutions.robots import Robot
from ..solutions.table import Table

JOINTS = ("q1", "q2", "q3")
CELLS = tuple(f"{cell}{i}" for i in (1, 2, 3) for cell in ("theta", "d", "a", "alpha"))
ENTRIES = tuple(f"x{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3))
DETERMINANT = parse(
    "x11*(x22*x33 - x23*x32) - x12*(x21*x33 - x23*x31) + x13*(x21*x32 - x22*x31)",
    ENTRIES,
)


class EasierError(KinegradeError):
    """Nothing follows from own formulas that make the question easier than it is."""


@lru_cache
def jacobian_formulas(arm: Robot) -> ExpressionArray:
    """The closed 6 x 3 Jacobian of an arm."""
    return expression_array(arm.symbolic().J, arm.names)


def jacobian_of_table(table: Table, arm: Robot) -> ExpressionArray:
    """The 6 x 3 Jacobian that follows from a table; the closed one from the arm's own.

    Raises:
        EasierError: the table leaves less than half of what the arm's own Jacobian holds.
    """
    closed = jacobian_formulas(arm)
    if table.rows == arm.table.rows:
        return closed
    cells = dict(zip(CELLS, (cell for row in table.rows for cell in row), strict=True))
    general = jacobian_formulas(_any_arm())
    own = {"q1": cells["theta1"], "q2": cells["theta2"], "q3": cells["d3"]} | cells
    return _no_easier(ExpressionArray(tuple(put_in(entry, own) for entry in general.entries), (6, 3)), closed)


def determinant_of(J: ExpressionArray, arm: Robot) -> ExpressionArray:
    """Determinant of the linear rows of J (6, 3); the factored one where J is the arm's own.

    Raises:
        EasierError: it hardly depends on the posture.
    """
    factored = determinant_formula(arm)
    if J is jacobian_formulas(arm):
        return factored
    entries = dict(zip(ENTRIES, J.entries[:9], strict=True))
    return _no_easier(ExpressionArray((put_in(DETERMINANT, entries),), ()), factored)


@lru_cache
def determinant_formula(arm: Robot, factor: str = "sin(q2)", sign: str = "-") -> ExpressionArray:
    """Determinant of the linear block, as the product of the factors that `conditions` returns."""
    stroke, side = conditions(arm, factor)
    second = side if _has_shoulder(arm) else f"({stroke})*{side}"
    return expression_array(f"{sign}({stroke})*({second})", arm.names)


def conditions(arm: Robot, factor: str = "sin(q2)") -> tuple[str, str]:
    """What is zero in the singular postures: the way from axis 2 to the hand, and the distance from axis 1.

    `factor` is the sine of the angle between axes 1 and 3; a1 counts against it where axis 2 points to the right.
    The offset d2 along axis 2 has no part in them.
    """
    stroke = "q3 + l3" if "l3" in arm.parameters else "q3"
    if not _has_shoulder(arm):
        return stroke, factor
    sense = "-" if arm.rows[0][3] == "pi/2" else "+"
    return stroke, f"({stroke})*{factor} {sense} a1"


def put_in(formula: Expression, values: Mapping[str, Expression]) -> Expression:
    """A formula with other formulas in place of some of its names."""
    nodes: list[Any] = []
    places: list[int] = []
    for kind, *arguments in formula.nodes:
        start = len(nodes)
        if kind == "s" and arguments[0] in values:
            nodes += (_moved(node, range(start, start + len(values[arguments[0]].nodes))) for node in values[arguments[0]].nodes)
        else:
            nodes.append(_moved((kind, *arguments), places))
        places.append(len(nodes) - 1)
    return Expression(tuple(nodes))


def prismatic_as_turning(arm: Robot) -> ExpressionArray:
    """The Jacobian with the axis of the slide in the angular rows, as if the slide turned the hand."""
    J = arm.symbolic().J.copy()
    J[3:, 2] = J[:3, 2]
    return expression_array(J, arm.names)


def one_frame_late(arm: Robot) -> ExpressionArray:
    """The Jacobian with z and o of frame i in column i."""
    return _from_frames(arm, late=1, to_hand=True)


def own_link_only(arm: Robot) -> ExpressionArray:
    """The Jacobian with o_i - o_(i-1) for the way to the hand."""
    return _from_frames(arm, late=0, to_hand=False)


@lru_cache
def _from_frames(arm: Robot, *, late: int, to_hand: bool) -> ExpressionArray:
    import sympy  # pyright: ignore[reportMissingTypeStubs]

    frames = arm.symbolic().frames
    columns: list[Any] = []
    for i, kind in enumerate(arm.kinds):
        z, o = (frames[i + late][:3, column] for column in (2, 3))
        end = frames[-1 if to_hand else i + 1][:3, 3]
        turned = [*z.cross(end - o), *z] if kind == "R" else [*z, 0, 0, 0]
        columns.append([sympy.expand(entry) for entry in turned])
    return expression_array(sympy.Matrix(columns).T, arm.names)


def _any_arm() -> Robot:
    return _ANY


_ANY = Robot(
    name="rrt",
    title="Any arm RRP",
    parameters=dict.fromkeys((name for name in CELLS if name not in ("theta1", "theta2", "d3")), 1.0),
    rows=(("q1", "d1", "a1", "alpha1"), ("q2", "d2", "a2", "alpha2"), ("theta3", "q3", "a3", "alpha3")),
    limits=((-1.0, 1.0),) * 3,
    source="standard Denavit-Hartenberg convention",
)


def _has_shoulder(arm: Robot) -> bool:
    return "a1" in arm.parameters


def _moved(node: Sequence[Any], places: Sequence[int]) -> tuple[Any, ...]:
    kind, *arguments = node
    return (kind, *arguments) if kind in ("n", "s") else (kind, *(places[i] for i in arguments))


def _no_easier(own: ExpressionArray, closed: ExpressionArray) -> ExpressionArray:
    """Own formulas that take at least half as many different numbers as the closed ones."""
    if 2 * _different_numbers(own, closed) < _different_numbers(closed, closed):
        raise EasierError("these formulas leave hardly anything to find out")
    return own
