"""Robots that are not in the catalogue: from a table, from a chain, from a URDF."""

import math
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Literal

from .analytic import RepresentationError, angles_from_rotation
from .chain import Array, Chain
from .robot import LINEAR, Motion, Robot
from .table import read_table
from .urdf import read_urdf

TURN = (-math.pi, math.pi)
STROKE = (0.1, 1.0)  # of a slide whose limits nobody said [m]
MOVES = {"R": "Rz", "P": "Tz"}
TINY = 1e-12
ALL = (0, 1, 2, 3, 4, 5)


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

    `limits` [rad, m] are by default one turn, and 0.1 to 1 m for a slide; `task_rows` the linear rows of an arm with
    three joints, all rows of one with six or more. Raises TableError.
    """
    kinds = read_table(
        rows, (*lengths, *(f"q{i}" for i in range(1, len(rows) + 1))), convention
    ).kinds
    return Robot(
        name="table",
        title=title,
        parameters=dict(lengths),
        rows=tuple(tuple(row) for row in rows),
        limits=tuple(limits)
        if limits
        else tuple(TURN if kind == "R" else STROKE for kind in kinds),
        source="a table",
        convention=convention,
        task_rows=tuple(task_rows) if task_rows else _task(kinds),
    )


def robot_from_chain(
    chain: Chain,
    *,
    title: str = "Arm",
    limits: Sequence[tuple[float, float]] | None = None,
    task_rows: Sequence[int] | None = None,
) -> Robot:
    """A robot of hand-placed frames with the transforms of a chain, which has no named lengths."""
    steps = [_steps(transform) for transform in chain.fixed]
    kinds = chain.kinds
    return Robot(
        name="chain",
        title=title,
        parameters={},
        rows=tuple(
            (*before, (MOVES[kind], f"q{i}"))
            for i, (kind, before) in enumerate(zip(kinds, steps, strict=False), 1)
        ),
        limits=tuple(limits)
        if limits
        else tuple(TURN if kind == "R" else STROKE for kind in kinds),
        source="a chain",
        convention="frames",
        tool=tuple(steps[-1]),
        task_rows=tuple(task_rows) if task_rows else _task(kinds),
    )


def robot_from_urdf(
    text_or_path: str | PathLike[str],
    base: str | None = None,
    tip: str | None = None,
    *,
    title: str = "Arm",
) -> Robot:
    """The robot between two links of a URDF, with its limits; see `read_urdf`. Raises UrdfError."""
    arm = read_urdf(text_or_path, base, tip)
    return robot_from_chain(arm.chain, title=title, limits=arm.limits)


def _task(kinds: str) -> tuple[int, ...]:
    return LINEAR if len(kinds) <= 3 else ALL


def _steps(transform: Array) -> list[Motion]:
    """Elementary motions, first along and then about the axes, whose product is a transform (4, 4)."""
    along = zip(("Tx", "Ty", "Tz"), transform[:3, 3], strict=True)
    try:
        turns = zip(("Rz", "Ry", "Rx"), angles_from_rotation(transform[:3, :3], "ZYX"), strict=True)
    except (
        RepresentationError
    ):  # the second angle is a right one, where these axes are not unique; then others are
        turns = zip(("Rz", "Rx", "Rz"), angles_from_rotation(transform[:3, :3], "ZXZ"), strict=True)
    return [
        (motion, _typed(float(amount))) for motion, amount in (*along, *turns) if abs(amount) > TINY
    ]


def _typed(amount: float) -> str:
    """A number as it is, a multiple of pi/4 as that, so that right angles stay exact."""
    quarters = amount / (math.pi / 4)
    if abs(quarters - round(quarters)) < TINY and round(quarters):
        return f"{round(quarters)}*pi/4"
    return repr(amount)
