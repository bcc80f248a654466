"""Whether two chains are the same mechanism, when frames may be placed in many legitimate ways.

With gauges G_0 ... G_n between the frames of both, G_i = C_i^-1 G_(i-1) E_i(c_i) C'_i, the second
chain at S q + c is the first at q: T'(S q + c) = B T(q) E, with B = C'_0 G_0^-1 C_0^-1, E = G_n.
A gauge before a revolute joint turns about and slides along its axis, before a prismatic one it
slides anywhere; both may reverse it. The search (gauges/search.py) goes from joint to joint over
the senses; what a joint leaves open of the translation is carried on, until an axis settles it.
"""

from dataclasses import dataclass

import numpy as np

from .chain import Array, Chain, ChainError, elementary
from .gauges.gauge import Gauge, wrapped
from .gauges.search import Difference, Given, Search, kept_or_reversed
from .kinematics import multiplied
from .rotation import inverse_transform

__all__ = ["Difference", "Equivalence", "Given", "equivalence"]

PROBES = 4  # configurations at which an equivalence is proved before it is believed
MOST_FOUND = 16
ALL_GIVEN = Given()


@dataclass(frozen=True, eq=False)
class Equivalence:
    """T'(signs q + offsets) = base T(q) tool, for every q (n,) [rad, m]."""

    signs: Array
    offsets: Array
    base: Array
    tool: Array


def equivalence(
    first: Chain,
    second: Chain,
    given: Given = ALL_GIVEN,
    *,
    angle: float = 1e-6,
    length: float = 1e-6,
) -> Equivalence | Difference:
    """How the second chain is the first with frames placed otherwise, or where they differ.

    Of several equivalences it is the one with the fewest reversed senses and smallest offsets.
    `angle` [rad] and `length` [m] are how far angles and distances may be off, which rounded
    tables need.

    Raises:
        ChainError: the chains have no joints of the same number and types, in order.
    """
    if first.kinds != second.kinds:
        raise ChainError(
            f"equivalence takes chains of the same joints, got {first.kinds!r} and {second.kinds!r}"
        )
    search = Search(first, second, given, angle, length)
    found = list[Equivalence]()
    for start in search.starts():
        for gauge in search.found(start, 1):
            believed = _believed(search, gauge)
            if believed is not None:
                found.append(believed)
            if len(found) >= MOST_FOUND:
                break
    if not found:
        return search.difference
    return min(found, key=_effort)


def _believed(search: Search, gauge: Gauge) -> Equivalence | None:
    """What a gauge G_n says, where it holds at random postures and agrees with a given zero."""
    n = search.first.n
    moved = list[float]()  # along the base's free directions
    values = dict[str, float]()
    for name, value in zip(gauge.names, gauge.chosen, strict=True):
        if name == "base":
            moved.append(float(value))
        else:
            values[name] = float(value)
    signs = np.array(gauge.signs)
    offsets = np.array([values.get(f"c{i}", 0.0) for i in range(1, n + 1)])
    base = np.eye(4)
    if not search.given.base:
        base = _base(search, signs[0], moved, values.get("base angle", 0.0))
    found = Equivalence(signs, offsets, base, _transform(gauge.turn, gauge.shift))
    if search.given.zero and not _at_zero(search, offsets):
        search.note(n + 1, "the home pose has other joint values")
        return None
    if not _holds(search, found):
        return None
    return found


def _base(search: Search, sign: float, moved: list[float], angle: float) -> Array:
    """B, where the first gauge is reversed or not, slid along the free directions, and turned."""
    shift = np.zeros(3)
    shift[3 - len(moved) :] = moved  # along z alone, or along x, y and z
    start = _transform(kept_or_reversed(sign), shift) @ elementary("Rz", angle)
    return (
        search.second.fixed[0] @ inverse_transform(start) @ inverse_transform(search.first.fixed[0])
    )


def _at_zero(search: Search, offsets: Array) -> bool:
    """Whether the home pose is the same."""
    revolute = np.array(list(search.first.kinds)) == "R"
    allowed = np.where(revolute, search.angle, search.length)
    off = np.where(revolute, np.abs(wrapped(offsets)), np.abs(offsets))
    return bool((off <= 2 * allowed).all())


def _holds(search: Search, found: Equivalence) -> bool:
    """Whether both chains agree at random configurations, as far as rounded links can."""
    first = search.first
    q = np.random.default_rng(0).uniform(-2, 2, (PROBES, first.n))
    theirs = multiplied(search.second, found.signs * q + found.offsets)
    off = np.abs(theirs - found.base @ multiplied(first, q) @ found.tool)
    reach = 1 + float(np.abs(first.fixed[:, :3, 3]).sum())
    return bool(off.max() <= search.length + 2 * first.n * search.angle * reach)


def _effort(found: Equivalence) -> float:
    reversed_senses = float((found.signs < 0).sum())
    moved = float(np.abs(wrapped(found.offsets)).sum())
    return reversed_senses + 0.01 * moved


def _transform(turn: Array, shift: Array) -> Array:
    result = np.eye(4)
    result[:3, :3] = turn
    result[:3, 3] = shift
    return result
