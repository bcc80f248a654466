"""Robots that are not in the catalogue: from a table, from a chain, from a URDF."""

import math
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Literal

from .analytic import RepresentationError, angles_from_rotation
from .chain import OWN_MOTIONS, Array, Chain
from .denavit_hartenberg import named_table
from .limits import TURN
from .robot import ALL, LINEAR, Motion, Robot
from .table import joint_names, read_table
from .urdf import UrdfError, read_urdf

STROKE = (0.1, 1.0)  # of a slide whose limits nobody said [m]
ROUNDED = 1e-5  # right angles in files are 1.5708
TINY = 1e-12  # what is smaller in a transform is 0


def robot_from_table(
    rows: Sequence[Sequence[str]],
    lengths: Mapping[str, float],
    *,
    title: str = "Arm",
    convention: Literal["standard", "modified"] = "standard",
    limits: Sequence[tuple[float, float]] | None = None,
    task_rows: Sequence[int] | None = None,
) -> Robot:
    """The robot of a table: rows of theta, d, a, alpha in the names of `lengths` [m] and q1 ... qn.

    `limits` [rad, m] are by default one turn, and 0.1 to 1 m for a slide; `task_rows` the linear
    rows of an arm with up to three joints, all rows of any other. Raises TableError.
    """
    names = (*lengths, *joint_names(len(rows)))
    kinds = read_table(rows, names, convention).kinds
    return Robot(
        name="table",
        title=title,
        parameters=dict(lengths),
        rows=tuple(map(tuple, rows)),
        limits=tuple(limits or _limits(kinds)),
        source="a table",
        convention=convention,
        task_rows=tuple(task_rows or _task_rows(kinds)),
    )


def robot_from_chain(
    chain: Chain,
    *,
    title: str = "Arm",
    limits: Sequence[tuple[float, float]] | None = None,
    task_rows: Sequence[int] | None = None,
    named: bool = False,
    tolerance: float = ROUNDED,
) -> Robot:
    """A robot of hand-placed frames with the transforms of a chain, which has no named lengths.

    With `named` it is that of a standard Denavit-Hartenberg table, as closed forms want it: its
    lengths and angles [m, rad] have names, such as a2 and alpha2, with the chain's values as
    defaults. What is within the `tolerance` [of the arm's length, rad] of zero, or of a multiple of
    pi/4, is that: 1.5708 is a right angle.

    `limits` [rad, m] and `task_rows` are by default those of `robot_from_table`.
    """
    if named:
        return _named(chain, title, limits, task_rows, tolerance)
    *before, tool = [_motions(transform) for transform in chain.fixed]
    rows = list[tuple[Motion, ...]]()
    for kind, joint, placement in zip(chain.kinds, joint_names(chain.n), before, strict=True):
        rows.append((*placement, (OWN_MOTIONS[kind], joint)))

    return Robot(
        name="chain",
        title=title,
        parameters={},
        rows=tuple(rows),
        limits=tuple(limits or _limits(chain.kinds)),
        source="a chain",
        convention="frames",
        tool=tuple(tool),
        task_rows=tuple(task_rows or _task_rows(chain.kinds)),
    )


def robot_from_urdf(
    text_or_path: str | PathLike[str],
    base: str | None = None,
    tip: str | None = None,
    *,
    title: str = "Arm",
    named: bool = False,
) -> Robot:
    """The robot between two links of a URDF, with its limits; see `read_urdf`. Raises UrdfError.

    With `named` its lengths have names, as in `robot_from_chain`.
    """
    arm = read_urdf(text_or_path, base, tip)
    if arm.is_coupled:
        raise UrdfError(
            f"a robot takes joints that move by themselves between {arm.base} and {arm.tip}, "
            "got one that mimics another; read_urdf has the Jacobian of such an arm"
        )
    return robot_from_chain(arm.chain, title=title, limits=arm.limits, named=named)


def _named(
    chain: Chain,
    title: str,
    limits: Sequence[tuple[float, float]] | None,
    task_rows: Sequence[int] | None,
    tolerance: float,
) -> Robot:
    table = named_table(chain, tolerance)
    first = chain.fixed[0]
    return Robot(
        name="chain",
        title=title,
        parameters=table.parameters,
        rows=tuple(table.rows),
        limits=tuple(limits or _limits(chain.kinds)),
        source="a chain",
        base=tuple(_motions(first)),
        tool=tuple(table.tool),
        task_rows=tuple(task_rows or _task_rows(chain.kinds)),
    )


def _limits(kinds: str) -> list[tuple[float, float]]:
    usual = {"R": TURN, "P": STROKE}
    return [usual[kind] for kind in kinds]


def _task_rows(kinds: str) -> tuple[int, ...]:
    if len(kinds) <= 3:
        return LINEAR
    return ALL


def _motions(transform: Array) -> list[Motion]:
    """Elementary motions, first along and then about the axes, whose product is a transform (4, 4).

    Those that do nothing are left out.
    """
    R = transform[:3, :3]
    turns = ("Rz", "Ry", "Rx")
    try:
        angles = angles_from_rotation(R, "ZYX")
    except RepresentationError:
        # the second angle is a right one, where these axes are not unique; then others are
        turns = ("Rz", "Rx", "Rz")
        angles = angles_from_rotation(R, "ZXZ")

    motions = list[Motion]()
    amounts = [*transform[:3, 3], *angles]
    for motion, amount in zip(("Tx", "Ty", "Tz", *turns), amounts, strict=True):
        if abs(amount) > TINY:
            motions.append((motion, _typed(float(amount))))
    return motions


def _typed(amount: float) -> str:
    """A number as it is, a multiple of pi/4 as that, so that right angles stay exact."""
    quarters = amount / (math.pi / 4)
    nearest = round(quarters)
    if nearest and abs(quarters - nearest) < TINY:
        return f"{nearest}*pi/4"
    return repr(amount)
