"""Chains from robots of the Robotics Toolbox for Python, by their attributes.

The toolbox is never imported here.
"""

from collections.abc import Iterable
from itertools import pairwise
from typing import Any

import numpy as np

from .axes import PlacedJoint, along, assembled
from .chain import Array, Chain, elementary, modified_transform, reals, standard_transform
from .errors import KinegradeError

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
KINDS = {"R": "R", "t": "P"}
Moves = list[Array | PlacedJoint]


class ToolboxError(KinegradeError):
    """An object that is no robot of the toolbox, or one that is no chain."""


def from_toolbox(robot: Any) -> Chain:
    """Chain of a DHRobot, a Robot (ERobot) or an ETS of roboticstoolbox-python 1.4.4.

    Base and tool are taken along. Standard and modified rows, offsets, prismatic joints, flipped
    joints and joints about x and y are understood. Of a robot that branches the toolbox's own
    choice is taken, `robot.ets()`; pass `robot.ets(end=...)` for another. Raises ToolboxError.
    """
    if _has_rows(robot):
        moves = Moves()
        for link in robot.links:
            moves += _row_moves(link)
        return _between(robot, moves)

    if callable(getattr(robot, "ets", None)):
        return _between(robot, _element_moves(robot.ets()))
    if hasattr(robot, "__iter__") and not isinstance(robot, str):
        return _chain(_element_moves(robot))
    raise ToolboxError(
        f"from_toolbox takes a DHRobot, a Robot or an ETS of roboticstoolbox, got {_kind_of(robot)}"
    )


def _has_rows(robot: Any) -> bool:
    """Whether all links are rows of a Denavit-Hartenberg table."""
    links: Any = getattr(robot, "links", None)
    if links is None:
        return False
    return all(_has(link, "sigma", "mdh", "alpha") for link in links)


def _between(robot: Any, moves: Moves) -> Chain:
    return _chain([_pose(robot, "base"), *moves, _pose(robot, "tool")])


def _chain(moves: Moves) -> Chain:
    if not any(isinstance(move, tuple) for move in moves):
        raise ToolboxError("from_toolbox takes a robot with joints, got none that moves")
    return assembled(moves)


def _row_moves(link: Any) -> Moves:
    """Moves of one Denavit-Hartenberg row, in which theta or d of the joint is its q + offset."""
    offset = _number(link, "offset")
    a = _number(link, "a")
    alpha = _number(link, "alpha")
    if link.sigma:
        kind, theta, d = "P", _number(link, "theta"), offset
    else:
        kind, theta, d = "R", offset, _number(link, "d")

    axis = np.eye(4)
    if getattr(link, "isflip", False):
        axis = elementary("Rx", np.pi)  # half a turn reverses z
    joint: PlacedJoint = (kind, axis)

    if not link.mdh:
        return [joint, standard_transform([theta, d, a, alpha])]
    before = modified_transform([0.0, 0.0, a, alpha])
    behind = modified_transform([theta, d, 0.0, 0.0])
    return [before, joint, behind]


def _element_moves(elements: Iterable[Any]) -> Moves:
    """Moves of an elementary transform sequence, whose joints take q in the order they stand."""
    moves = Moves()
    indices = list[int]()
    for element in elements:
        if not _has(element, "isjoint", "A"):
            raise ToolboxError(f"an ETS takes elementary transforms, got {_kind_of(element)}")
        if not element.isjoint:
            moves.append(_matrix(element.A(), "an elementary transform"))
            continue

        moves.append(_joint(element))
        index = getattr(element, "jindex", None)
        if index is not None:
            indices.append(int(index))

    if any(low >= high for low, high in pairwise(indices)):
        raise ToolboxError(
            f"an ETS takes joints numbered in the order in which they stand, got {indices}"
        )
    return moves


def _joint(element: Any) -> PlacedJoint:
    name = _motion_name(element)
    if len(name) != 2 or name[0] not in KINDS or name[1] not in AXES:
        raise ToolboxError(f"a joint takes one of Rx, Ry, Rz, tx, ty, tz, got {name}")

    axis = np.array(AXES[name[1]])
    if getattr(element, "isflip", False):
        axis = -1.0 * axis
    return KINDS[name[0]], along(axis)


def _motion_name(element: Any) -> str:
    # `kind` is called `axis` up to 1.3, and 1.4 warns about the old name
    if hasattr(element, "kind"):
        return str(element.kind)
    return str(element.axis)


def _pose(robot: Any, key: str) -> Array:
    """Base or tool transform of a robot, the identity if it has none."""
    value = getattr(robot, key, None)
    if value is None:
        return np.eye(4)
    return _matrix(getattr(value, "A", value), f"the {key}")


def _matrix(value: Any, what: str) -> Array:
    try:
        matrix = reals(what, value)
    except (KinegradeError, TypeError):
        matrix = np.zeros(0)
    if matrix.shape != (4, 4):
        raise ToolboxError(
            f"{what} takes one transform of shape (4, 4) in numbers, got {_kind_of(value)}"
        )
    return matrix


def _number(link: Any, key: str) -> float:
    try:
        return float(getattr(link, key))
    except (AttributeError, TypeError, ValueError):
        raise ToolboxError(
            f"a row takes a number for {key}, got {getattr(link, key, None)!r}"
        ) from None


def _has(value: Any, *keys: str) -> bool:
    return all(hasattr(value, key) for key in keys)


def _kind_of(value: Any) -> str:
    kind = f"an object of type {type(value).__name__}"
    shape = getattr(value, "shape", None)
    if shape is None:
        return kind
    return f"{kind} and shape {shape}"
