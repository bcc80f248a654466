"""A chain read from a URDF file."""

from collections import Counter
from dataclasses import dataclass
from os import PathLike
from xml.etree import ElementTree as ET

import numpy as np
from numpy.typing import ArrayLike

from .axes import PlacedJoint, assembled
from .chain import Array, Chain, configuration
from .jacobian import jacobian
from .urdf_joint import (
    attribute,
    joint_kind,
    joint_limits,
    joint_link,
    joint_moves,
    joint_name,
    mimicked,
    reversed_limits,
)
from .urdf_text import UrdfError, robot_element

__all__ = ["UrdfArm", "UrdfError", "read_urdf"]

Way = list[tuple[ET.Element, bool]]  # the joints, and whether each is passed upwards
Joints = dict[str, ET.Element]  # by name


@dataclass(frozen=True, eq=False)
class UrdfArm:
    """The chain between two links, with the name and limits [rad or m] of each moving joint.

    A joint that mimics another has no value of its own: `chain` has m joints, of which the values
    of the n in `names` decide, as `coupling` (m, n) times them plus `offsets` (m,). Without mimic
    joints m = n and the coupling is the identity.

    Attributes:
        notes: What in the file was not as it should be and was read all the same.
    """

    chain: Chain
    names: tuple[str, ...]
    limits: tuple[tuple[float, float], ...]
    base: str
    tip: str
    coupling: Array
    offsets: Array
    notes: tuple[str, ...] = ()

    @property
    def is_coupled(self) -> bool:
        """Whether a joint of the chain mimics another."""
        coupled = not np.array_equal(self.coupling, np.eye(self.chain.n))
        return coupled or bool(self.offsets.any())

    def configuration(self, q: ArrayLike) -> Array:
        """Values (..., m) of all joints of the chain from those (..., n) in `names`."""
        values = configuration(len(self.names), q)
        return values @ self.coupling.T + self.offsets

    def jacobian(self, q: ArrayLike) -> Array:
        """Jacobians (..., 6, n) at q (..., n), base axes: a mimic joint adds to a column."""
        return jacobian(self.chain, self.configuration(q)) @ self.coupling


def read_urdf(
    text_or_path: str | PathLike[str], base: str | None = None, tip: str | None = None
) -> UrdfArm:
    """Chain from the link `base`, by default the root, to the link `tip`, by default the only end.

    A string that starts with "<" is the text itself. Fixed joints are merged; a continuous joint is
    revolute and has one turn as its limits; a way that leads up from the base and down to the tip
    passes the joints above the base the other way round. Joints off the way are not looked at.
    Raises UrdfError.
    """
    robot = robot_element(text_or_path)
    links = _links(robot)
    above = _joints_above(robot, links)
    first = _base(links, above, base)
    last = _tip(links, above, first, tip)

    way = _way(above, first, last)
    moving = [joint for joint, _ in way if joint_kind(joint)]
    if not moving:
        raise UrdfError(
            f"the way from {first} to {last} takes a joint that moves, got fixed joints only"
        )

    moves = list[Array | PlacedJoint]()
    for joint, upwards in way:
        moves += joint_moves(joint, upwards=upwards)
    named = {joint_name(joint): joint for joint in above.values()}
    names, coupling, offsets = _coupled(moving, named)
    notes = [reversed_limits(named[name]) for name in names]
    return UrdfArm(
        chain=assembled(moves),
        names=names,
        limits=tuple(joint_limits(named[name]) for name in names),
        base=first,
        tip=last,
        coupling=coupling,
        offsets=offsets,
        notes=tuple(filter(None, notes)),
    )


def _coupled(moving: list[ET.Element], named: Joints) -> tuple[tuple[str, ...], Array, Array]:
    """The joints with values of their own, and how those of all that move follow from them."""
    followed = [_leader(joint, named) for joint in moving]
    names = tuple(dict.fromkeys(name for name, _, _ in followed))
    coupling = np.zeros((len(moving), len(names)))
    offsets = np.zeros(len(moving))
    for i, (name, multiplier, offset) in enumerate(followed):
        coupling[i, names.index(name)] = multiplier
        offsets[i] = offset
    return names, coupling, offsets


def _leader(joint: ET.Element, named: Joints) -> tuple[str, float, float]:
    """The joint whose value decides that of another, with multiplier and offset.

    A joint that mimics none is its own; one that mimics a mimic follows the last of them.
    """
    multiplier, offset = 1.0, 0.0
    passed = [joint_name(joint)]
    while (mimic := mimicked(joint)) is not None:
        name, factor, shift = mimic
        if name not in named or not joint_kind(named[name]):
            raise UrdfError(f"joint {passed[-1]} takes a moving joint to mimic, got {name!r}")
        if name in passed:
            raise UrdfError(f"joint {passed[0]} takes another joint to mimic, got a loop")
        offset += multiplier * shift
        multiplier *= factor
        passed.append(name)
        joint = named[name]
    return passed[-1], multiplier, offset


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


def _way(above: dict[str, ET.Element], base: str, tip: str) -> Way:
    """The joints from the base up to the first link that carries both, and down to the tip."""
    from_tip, from_base = _upwards(above, tip), _upwards(above, base)
    common = [link for link in from_base if link in from_tip]
    if not common:
        raise UrdfError(
            f"base takes a link that is joined to {tip}, such as {', '.join(from_tip[::-1])}, "
            f"got {base}"
        )
    top = common[0]
    up = from_base[: from_base.index(top)]
    down = from_tip[: from_tip.index(top)]
    return [(above[link], True) for link in up] + [(above[link], False) for link in down[::-1]]


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
