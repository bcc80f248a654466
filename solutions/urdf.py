"""A chain read from a URDF file."""

from collections import Counter
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from .axes import PlacedJoint, along, assembled
from .chain import Array, Chain, steps_transform
from .errors import KinegradeError
from .limits import TURN

KINDS = {"revolute": "R", "continuous": "R", "prismatic": "P"}



class UrdfError(KinegradeError):
    """A URDF text that describes no serial chain."""


@dataclass(frozen=True, eq=False)
class UrdfArm:
    """The chain between two links, with the name and the limits [rad or m] of each joint that moves."""

    chain: Chain
    names: tuple[str, ...]
    limits: tuple[tuple[float, float], ...]
    base: str
    tip: str


def read_urdf(
    text_or_path: str | PathLike[str], base: str | None = None, tip: str | None = None
) -> UrdfArm:
    """Chain from the link `base`, by default the root, to the link `tip`, by default the only end.

    A string that starts with "<" is the text itself. Fixed joints are merged; a continuous joint is revolute and has
    one turn as its limits. Joints off the way from base to tip are not looked at. Raises UrdfError.
    """
    robot = _parsed(_text(text_or_path))
    links = _links(robot)
    above = _joints_above(robot, links)
    first = _base(links, above, base)
    last = _tip(links, above, first, tip)
    way = _way(above, first, last)
    moving = [joint for joint in way if _kind(joint)]
    if not moving:
        raise UrdfError(
            f"the way from {first} to {last} takes a joint that moves, got fixed joints only"
        )
    moves = [move for joint in way for move in _moves(joint)]
    names = tuple(_name(joint) for joint in moving)
    return UrdfArm(assembled(moves), names, tuple(_limits(joint) for joint in moving), first, last)


def _text(text_or_path: str | PathLike[str]) -> str:
    if isinstance(text_or_path, str) and text_or_path.lstrip("\ufeff \t\r\n").startswith("<"):
        return text_or_path
    path = Path(text_or_path)
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise UrdfError(f"{path.name} takes UTF-8 text, got other bytes") from None
    except (OSError, ValueError) as error:
        raise UrdfError(
            f"read_urdf takes the path of a readable file, or a text that starts with <, got {error}"
        ) from None


def _parsed(text: str) -> ET.Element:
    # looked for in the text, before a parser sees it: entities of a DTD can grow without bound or name other files
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise UrdfError("a URDF takes no document type and no entities, got <!DOCTYPE or <!ENTITY")
    try:
        root = ET.fromstring(text.lstrip("\ufeff \t\r\n"))  # noqa: S314 - no DTD gets here
    except ET.ParseError as error:
        raise UrdfError(f"a URDF takes well-formed XML, got {error}") from None
    if root.tag != "robot":
        raise UrdfError(f"a URDF takes <robot> as its outermost element, got <{root.tag}>")
    return root


def _links(robot: ET.Element) -> list[str]:
    links = [_attribute(link, "name", "a link") for link in robot.findall("link")]
    if twice := [link for link, count in Counter(links).items() if count > 1]:
        raise UrdfError(f"links take names of their own, got {twice[0]} twice")
    return links


def _joints_above(robot: ET.Element, links: list[str]) -> dict[str, ET.Element]:
    """The joint that carries each link but the root."""
    above = dict[str, ET.Element]()
    seen = set[str]()
    for joint in robot.findall("joint"):
        name, parent, child = _name(joint), _link(joint, "parent"), _link(joint, "child")
        if name in seen:
            raise UrdfError(f"joints take names of their own, got {name} twice")
        seen.add(name)
        if missing := [link for link in (parent, child) if link not in links]:
            raise UrdfError(f"joint {name} takes links of this robot, got {missing[0]!r}")
        if child in above:
            raise UrdfError(
                f"link {child} takes one joint above it, got {_name(above[child])} and {name}: a loop"
            )
        above[child] = joint
    return above


def _base(links: list[str], above: dict[str, ET.Element], base: str | None) -> str:
    if base is not None:
        return _known("base", base, links)
    roots = [link for link in links if link not in above]
    if len(roots) != 1:
        found = ", ".join(roots) or "none"
        raise UrdfError(f"a URDF takes one link that no joint carries, got {found}; choose base")
    return roots[0]


def _tip(links: list[str], above: dict[str, ET.Element], base: str, tip: str | None) -> str:
    if tip is not None:
        return _known("tip", tip, links)
    parents = {_link(joint, "parent") for joint in above.values()}
    ends = [link for link in links if link not in parents and base in _upwards(above, link)]
    if len(ends) != 1:
        raise UrdfError(
            f"tip takes one of {', '.join(ends) or 'no links'}, as the robot branches after {base}, got none"
        )
    return ends[0]


def _way(above: dict[str, ET.Element], base: str, tip: str) -> list[ET.Element]:
    upwards = _upwards(above, tip)
    if base not in upwards:
        raise UrdfError(
            f"base takes a link on the way from the root to {tip}, {', '.join(upwards[::-1])}, got {base}"
        )
    return [above[link] for link in upwards[: upwards.index(base)][::-1]]


def _upwards(above: dict[str, ET.Element], link: str) -> list[str]:
    """The link, the one that carries it, and so on to the root, or once around a loop."""
    upwards = [link]
    while upwards[-1] in above:
        parent = _link(above[upwards[-1]], "parent")
        if parent in upwards:
            break
        upwards.append(parent)
    return upwards


def _kind(joint: ET.Element) -> str:
    """Letter of a joint on the way, empty for a fixed one."""
    kind = joint.get("type", "")
    if kind not in KINDS and kind != "fixed":
        valid = ", ".join([*KINDS, "fixed"])
        raise UrdfError(
            f"joint {_name(joint)} takes a type of {valid} on the way to the tip, got {kind or 'none'}"
        )
    if joint.find("mimic") is not None:
        raise UrdfError(
            f"joint {_name(joint)} takes a motion of its own on the way to the tip, got mimic"
        )
    return KINDS.get(kind, "")


def _moves(joint: ET.Element) -> list[Array | PlacedJoint]:
    origin = joint.find("origin")
    x, y, z = _three(joint, origin, "xyz", "0 0 0")
    roll, pitch, yaw = _three(joint, origin, "rpy", "0 0 0")
    placed = steps_transform(
        [("Tx", x), ("Ty", y), ("Tz", z), ("Rz", yaw), ("Ry", pitch), ("Rx", roll)]
    )
    if not (kind := _kind(joint)):
        return [placed]
    axis = np.array(_three(joint, joint.find("axis"), "xyz", "1 0 0"))
    length = float(np.linalg.norm(axis))
    if length < 1e-9:
        raise UrdfError(f"joint {_name(joint)} takes an axis with a direction, got zeros")
    return [placed, (kind, along(axis / length))]


def _limits(joint: ET.Element) -> tuple[float, float]:
    if joint.get("type") == "continuous":
        return TURN
    limit = joint.find("limit")
    if limit is None:
        raise UrdfError(
            f"joint {_name(joint)} takes limits, as it is {joint.get('type')}, got none"
        )
    low, high = (
        _number(joint, limit.get(side, "0"), f"the limit {side}") for side in ("lower", "upper")
    )
    if low > high:
        raise UrdfError(
            f"joint {_name(joint)} takes a lower limit below the upper one, got {low:g} and {high:g}"
        )
    return low, high


def _three(joint: ET.Element, element: ET.Element | None, key: str, default: str) -> list[float]:
    words = (default if element is None else element.get(key, default)).split()
    if len(words) != 3:
        raise UrdfError(
            f"joint {_name(joint)} takes three numbers in {key}, got {' '.join(words)!r}"
        )
    return [_number(joint, word, key) for word in words]


def _number(joint: ET.Element, word: str, what: str) -> float:
    try:
        value = np.nan if "_" in word else float(word)  # Python reads 1_0 as 10; no URDF means that
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise UrdfError(f"joint {_name(joint)} takes finite numbers in {what}, got {word!r}")
    return value


def _link(joint: ET.Element, side: str) -> str:
    element = joint.find(side)
    if element is None:
        raise UrdfError(f"joint {_name(joint)} takes a {side} link, got none")
    return _attribute(element, "link", f"the {side} of joint {_name(joint)}")


def _name(joint: ET.Element) -> str:
    return _attribute(joint, "name", "a joint")


def _attribute(element: ET.Element, key: str, what: str) -> str:
    if not (value := element.get(key)):
        raise UrdfError(f"{what} takes a {key}, got none")
    return value


def _known(what: str, link: str, links: list[str]) -> str:
    if link not in links:
        raise UrdfError(f"{what} takes one of {', '.join(links)}, got {link!r}")
    return link
