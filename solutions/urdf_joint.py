"""One joint element of a URDF: its name, its links, its type, its moves and its limits."""

from xml.etree import ElementTree as ET

import numpy as np

from .axes import PlacedJoint, along
from .chain import Array, steps_transform
from .errors import KinegradeError
from .limits import TURN

KINDS = {"revolute": "R", "continuous": "R", "prismatic": "P"}
SHORTEST = 1e-9  # of an axis with a direction


class UrdfError(KinegradeError):
    """A URDF text that describes no serial chain."""


def joint_name(joint: ET.Element) -> str:
    """Name of a joint; UrdfError if it has none."""
    return attribute(joint, "name", "a joint")


def joint_link(joint: ET.Element, side: str) -> str:
    """Name of the link on one side, "parent" or "child"; UrdfError if there is none."""
    element = joint.find(side)
    if element is None:
        raise UrdfError(f"joint {joint_name(joint)} takes a {side} link, got none")
    return attribute(element, "link", f"the {side} of joint {joint_name(joint)}")


def joint_kind(joint: ET.Element) -> str:
    """Letter "R" or "P" of a joint on the way, empty for a fixed one. Raises UrdfError."""
    kind = joint.get("type", "")
    if kind not in KINDS and kind != "fixed":
        valid = ", ".join([*KINDS, "fixed"])
        raise UrdfError(
            f"joint {joint_name(joint)} takes a type of {valid} on the way to the tip, "
            f"got {kind or 'none'}"
        )
    if joint.find("mimic") is not None:
        raise UrdfError(
            f"joint {joint_name(joint)} takes a motion of its own on the way to the tip, got mimic"
        )
    return KINDS.get(kind, "")


def joint_moves(joint: ET.Element) -> list[Array | PlacedJoint]:
    """The constant transform to a joint, and the joint if it is not fixed. Raises UrdfError."""
    origin = joint.find("origin")
    x, y, z = _three_numbers(joint, origin, "xyz", "0 0 0")
    roll, pitch, yaw = _three_numbers(joint, origin, "rpy", "0 0 0")
    placed = steps_transform(
        [("Tx", x), ("Ty", y), ("Tz", z), ("Rz", yaw), ("Ry", pitch), ("Rx", roll)]
    )
    kind = joint_kind(joint)
    if not kind:
        return [placed]

    axis = np.array(_three_numbers(joint, joint.find("axis"), "xyz", "1 0 0"))
    length = float(np.linalg.norm(axis))
    if length < SHORTEST:
        raise UrdfError(f"joint {joint_name(joint)} takes an axis with a direction, got zeros")
    return [placed, (kind, along(axis / length))]


def joint_limits(joint: ET.Element) -> tuple[float, float]:
    """Limits [rad or m] of a joint that moves, one turn for a continuous one. Raises UrdfError."""
    if joint.get("type") == "continuous":
        return TURN

    limit = joint.find("limit")
    if limit is None:
        raise UrdfError(
            f"joint {joint_name(joint)} takes limits, as it is {joint.get('type')}, got none"
        )
    low = _number(joint, limit.get("lower", "0"), "the limit lower")
    high = _number(joint, limit.get("upper", "0"), "the limit upper")
    if low > high:
        raise UrdfError(
            f"joint {joint_name(joint)} takes a lower limit below the upper one, "
            f"got {low:g} and {high:g}"
        )
    return low, high


def attribute(element: ET.Element, key: str, what: str) -> str:
    """Value of an attribute; UrdfError if it is not there or empty."""
    value = element.get(key)
    if not value:
        raise UrdfError(f"{what} takes a {key}, got none")
    return value


def _three_numbers(
    joint: ET.Element, element: ET.Element | None, key: str, default: str
) -> list[float]:
    text = default
    if element is not None:
        text = element.get(key, default)

    words = text.split()
    if len(words) != 3:
        raise UrdfError(
            f"joint {joint_name(joint)} takes three numbers in {key}, got {' '.join(words)!r}"
        )
    return [_number(joint, word, key) for word in words]


def _number(joint: ET.Element, word: str, what: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = np.nan
    # Python reads 1_0 as 10; no URDF means that
    if "_" in word or not np.isfinite(value):
        raise UrdfError(f"joint {joint_name(joint)} takes finite numbers in {what}, got {word!r}")
    return value
