"""A chain read from a URDF file."""

from collections import Counter
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from xml.etree import ElementTree as ET

from .axes import PlacedJoint, assembled
from .chain import Array, Chain
from .urdf_joint import (
    UrdfError,
    attribute,
    joint_kind,
    joint_limits,
    joint_link,
    joint_moves,
    joint_name,
)

__all__ = ["UrdfArm", "UrdfError", "read_urdf"]

BLANK = "\ufeff \t\r\n"  # what may stand before the first element


@dataclass(frozen=True, eq=False)
class UrdfArm:
    """The chain between two links, with the name and limits [rad or m] of each moving joint."""

    chain: Chain
    names: tuple[str, ...]
    limits: tuple[tuple[float, float], ...]
    base: str
    tip: str


def read_urdf(
    text_or_path: str | PathLike[str], base: str | None = None, tip: str | None = None
) -> UrdfArm:
    """Chain from the link `base`, by default the root, to the link `tip`, by default the only end.

    A string that starts with "<" is the text itself. Fixed joints are merged; a continuous joint is
    revolute and has one turn as its limits. Joints off the way from base to tip are not looked at.
    Raises UrdfError.
    """
    robot = _parsed(_text(text_or_path))
    links = _links(robot)
    above = _joints_above(robot, links)
    first = _base(links, above, base)
    last = _tip(links, above, first, tip)

    way = _way(above, first, last)
    moving = [joint for joint in way if joint_kind(joint)]
    if not moving:
        raise UrdfError(
            f"the way from {first} to {last} takes a joint that moves, got fixed joints only"
        )

    moves = list[Array | PlacedJoint]()
    for joint in way:
        moves += joint_moves(joint)
    return UrdfArm(
        chain=assembled(moves),
        names=tuple(map(joint_name, moving)),
        limits=tuple(map(joint_limits, moving)),
        base=first,
        tip=last,
    )


def _text(text_or_path: str | PathLike[str]) -> str:
    if isinstance(text_or_path, str) and text_or_path.lstrip(BLANK).startswith("<"):
        return text_or_path

    path = Path(text_or_path)
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise UrdfError(f"{path.name} takes UTF-8 text, got other bytes") from None
    except (OSError, ValueError) as error:
        raise UrdfError(
            "read_urdf takes the path of a readable file, or a text that starts with <, "
            f"got {error}"
        ) from None


def _parsed(text: str) -> ET.Element:
    # looked for in the text, before a parser sees it: entities of a DTD can grow without bound or
    # name other files
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise UrdfError("a URDF takes no document type and no entities, got <!DOCTYPE or <!ENTITY")
    try:
        root = ET.fromstring(text.lstrip(BLANK))  # noqa: S314 - no DTD gets here
    except ET.ParseError as error:
        raise UrdfError(f"a URDF takes well-formed XML, got {error}") from None
    if root.tag != "robot":
        raise UrdfError(f"a URDF takes <robot> as its outermost element, got <{root.tag}>")
    return root


def _links(robot: ET.Element) -> list[str]:
    links = [attribute(link, "name", "a link") for link in robot.findall("link")]
    for link, count in Counter(links).items():
        if count > 1:
            raise UrdfError(f"links take names of their own, got {link} twice")
    return links


def _joints_above(robot: ET.Element, links: list[str]) -> dict[str, ET.Element]:
    """The joint that carries each link but the root."""
    above = dict[str, ET.Element]()
    seen = set[str]()
    for joint in robot.findall("joint"):
        name = joint_name(joint)
        parent = joint_link(joint, "parent")
        child = joint_link(joint, "child")
        if name in seen:
            raise UrdfError(f"joints take names of their own, got {name} twice")
        seen.add(name)

        for link in (parent, child):
            if link not in links:
                raise UrdfError(f"joint {name} takes links of this robot, got {link!r}")
        if child in above:
            raise UrdfError(
                f"link {child} takes one joint above it, "
                f"got {joint_name(above[child])} and {name}: a loop"
            )
        above[child] = joint
    return above


def _base(links: list[str], above: dict[str, ET.Element], base: str | None) -> str:
    """The link that is asked for, or the root."""
    if base is not None:
        return _known("base", base, links)

    roots = [link for link in links if link not in above]
    if len(roots) != 1:
        found = ", ".join(roots) or "none"
        raise UrdfError(f"a URDF takes one link that no joint carries, got {found}; choose base")
    return roots[0]


def _tip(links: list[str], above: dict[str, ET.Element], base: str, tip: str | None) -> str:
    """The link that is asked for, or the only one behind the base that carries nothing."""
    if tip is not None:
        return _known("tip", tip, links)

    parents = {joint_link(joint, "parent") for joint in above.values()}
    ends = list[str]()
    for link in links:
        if link not in parents and base in _upwards(above, link):
            ends.append(link)
    if len(ends) != 1:
        valid = ", ".join(ends) or "no links"
        raise UrdfError(f"tip takes one of {valid}, as the robot branches after {base}, got none")
    return ends[0]


def _way(above: dict[str, ET.Element], base: str, tip: str) -> list[ET.Element]:
    """The joints from the base to the tip."""
    way = _upwards(above, tip)[::-1]
    if base not in way:
        raise UrdfError(
            f"base takes a link on the way from the root to {tip}, {', '.join(way)}, got {base}"
        )
    carried = way[way.index(base) + 1 :]
    return [above[link] for link in carried]


def _upwards(above: dict[str, ET.Element], link: str) -> list[str]:
    """The link, the one that carries it, and so on to the root, or once around a loop."""
    upwards = [link]
    while upwards[-1] in above:
        parent = joint_link(above[upwards[-1]], "parent")
        if parent in upwards:
            break
        upwards.append(parent)
    return upwards


def _known(what: str, link: str, links: list[str]) -> str:
    if link not in links:
        raise UrdfError(f"{what} takes one of {', '.join(links)}, got {link!r}")
    return link
