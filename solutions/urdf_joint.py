"""One joint element of a URDF: its name, its links, its type, its moves and its limits."""

from xml.etree import ElementTree as ET

import numpy as np

from .axes import PlacedJoint, along
from .chain import Array, steps_transform
from .limits import TURN
from .rotation import inverse_transform
from .urdf_text import UrdfError

KINDS = {"revolute": "R", "continuous": "R", "prismatic": "P"}
FREE = ("floating", "planar")  # joints of a base that drives or flies
SHORTEST = 1e-9  # of an axis with a direction


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
    if kind in FREE:
        raise UrdfError(
            f"joint {joint_name(joint)} takes a type of {', '.join([*KINDS, 'fixed'])} on the way "
            f"to the tip, got {kind}; choose a base behind it: "
            f"base={joint_link(joint, 'child')!r}"
        )
    if kind not in KINDS and kind != "fixed":
        valid = ", ".join([*KINDS, "fixed"])
        raise UrdfError(
            f"joint {joint_name(joint)} takes a type of {valid} on the way to the tip, "
            f"got {kind or 'none'}"
        )
    return KINDS.get(kind, "")


def joint_moves(joint: ET.Element, *, upwards: bool = False) -> list[Array | PlacedJoint]:
    """The constant transform to a joint, and the joint if it is not fixed.

    On a way that leads `upwards`, from the child to the parent, both are the other way round.
    Raises UrdfError.
    """
    origin = joint.find("origin")
    x, y, z = _three_numbers(joint, origin, "xyz", "0 0 0")
    roll, pitch, yaw = _three_numbers(joint, origin, "rpy", "0 0 0")
    placed = steps_transform(
        [("Tx", x), ("Ty", y), ("Tz", z), ("Rz", yaw), ("Ry", pitch), ("Rx", roll)]
    )
    kind = joint_kind(joint)
    if not kind:
        return [inverse_transform(placed) if upwards else placed]

    axis = np.array(_three_numbers(joint, joint.find("axis"), "xyz", "1 0 0"))
    length = float(np.linalg.norm(axis))
    if length < SHORTEST:
        raise UrdfError(f"joint {joint_name(joint)} takes an axis with a direction, got zeros")
    if upwards:  # E(q) about the axis undone is E(q) about its opposite
        return [(kind, along(-axis / length)), inverse_transform(placed)]
    return [placed, (kind, along(axis / length))]


def mimicked(joint: ET.Element) -> tuple[str, float, float] | None:
    """The joint that this one follows, with multiplier and offset [rad or m]; None for none.

    Raises UrdfError.
    """
    mimic = joint.find("mimic")
    if mimic is None or not joint_kind(joint):
        return None
    followed = attribute(mimic, "joint", f"mimic of joint {joint_name(joint)}")
    multiplier = _number(joint, mimic.get("multiplier", "1"), "the multiplier of mimic")
    offset = _number(joint, mimic.get("offset", "0"), "the offset of mimic")
    return followed, multiplier, offset


def joint_limits(joint: ET.Element) -> tuple[float, float]:
    """Limits [rad or m] of a joint that moves, one turn for a continuous one.

    Reversed ones are put in order; `reversed_limits` says that they were. Raises UrdfError.
    """
    if joint.get("type") == "continuous":
        return TURN

    limit = joint.find("limit")
    if limit is None:
        raise UrdfError(
            f"joint {joint_name(joint)} takes limits, as it is {joint.get('type')}, got none"
        )
    low = _number(joint, limit.get("lower", "0"), "the limit lower")
    high = _number(joint, limit.get("upper", "0"), "the limit upper")
    return min(low, high), max(low, high)


def reversed_limits(joint: ET.Element) -> str:
    """What to say of limits that stand the other way round; empty where they do not."""
    limit = joint.find("limit")
    if joint.get("type") == "continuous" or limit is None:
        return ""
    low = _number(joint, limit.get("lower", "0"), "the limit lower")
    high = _number(joint, limit.get("upper", "0"), "the limit upper")
    if low <= high:
        return ""
    return (
        f"joint {joint_name(joint)} has its lower limit {low:g} above the upper one {high:g}; "
        "they were exchanged"
    )


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
