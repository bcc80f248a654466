# pyright: basic
"""The figure of a robot's singularities and workspace in words."""

from collections.abc import Mapping, Sequence

import numpy as np

from ...solutions.reach import Reach
from ...solutions.singularity import RegionalArm, Values
from ...solutions.workspace import LIMITS, SINGULAR, Section
from .amounts import said_amounts
from .joint_map import JointMap, short, sigma_unit, sign_rule

SINGULAR_POSTURES = {short(SINGULAR): "singular postures"}  # where no factor has a name of its own
PROVEN = 5e-3  # of the largest distance, which is printed to three digits


def description(
    title: str,
    values: Mapping[str, float],
    found: JointMap,
    cut: Section,
    reached: Reach,
) -> str:
    """Sentences on what is singular and where, how far the tool gets, what bounds its workspace.

    `values` are the parameters by name, `reached` the distances of the tool from axis 1 [m].
    """
    point = found.part.point
    sentences = [f"Singularities and workspace: {title} ({said_amounts(values)})."]

    first, second = found.free
    bound = f"{np.nanmax(cut.cells):.3g} {sigma_unit(found.part)}"
    sentences.append(
        f"Over q{first + 1} and q{second + 1}, the smallest singular value"
        f" of the {point}'s Jacobian block is at most {bound}."
    )
    if found.curves:
        zeros = [f"{name} ({_where(found, lines)})" for name, lines in found.curves]
        sentences.append(
            f"It falls to zero, where the {point} loses a direction, on: {'; '.join(zeros)}."
        )
    if found.det is not None:
        sentences.append(sign_rule(found))

    near, far = _without_dust(reached.near), _without_dust(reached.far)
    sentences.append(
        f"Within the joint limits the {point} gets"
        f" from {near:.3g} m to {far:.3g} m away from axis 1{_certainty(reached)}."
    )
    sentences += _walls(found.part, cut)
    return " ".join(sentence for sentence in sentences if sentence)


def _certainty(reached: Reach) -> str:
    """A caution where a search found the distances and nothing proves that they are the last."""
    if reached.error <= PROVEN * reached.far:
        return ""
    return ", as far as a search from many postures found"


def _without_dust(value: float) -> float:
    return 0.0 if abs(value) < 1e-9 else value


def _where(found: JointMap, lines: Sequence[Values]) -> str:
    """The values of a joint on straight lines along the map; else how far a curve runs."""
    for axis in (1, 0):
        if any(np.ptp(line[:, axis]) >= 1e-6 for line in lines):
            continue
        joint = found.free[axis]
        places = sorted((float(line[0, axis]) for line in lines), key=abs)
        values = [_joint_value(found.part, joint, place) for place in places]
        once = dict.fromkeys(values)
        return f"q{joint + 1} = {' and '.join(once)}"
    return "a curve across the map"


def _joint_value(part: RegionalArm, joint: int, value: float) -> str:
    value = _without_dust(value)
    if part.chain.kinds[joint] == "P":
        return f"{value:.3g} m"
    if abs(abs(value) - np.pi) < 1e-9:  # -pi is the same place
        value = np.pi
    return f"{np.degrees(value):.4g}°"


def _walls(part: RegionalArm, cut: Section) -> list[str]:
    """Sentences on which curves bound the workspace, run inside of it, or lie out of reach."""
    bounding, crossing, drawn = set(), set(), set()
    for curve in cut.curves:
        name = short(curve.name)
        drawn.add(name)
        if curve.boundary.any():
            bounding.add(name)
        if curve.name != LIMITS and not curve.boundary.all():
            crossing.add(name)

    factors = [short(factor.name) for factor in part.factors]
    if any(
        curve.name == SINGULAR for curve in cut.curves
    ):  # then the factors are those of another, larger, block
        factors = []
    away = set()
    if drawn:
        away = set(factors) - drawn

    names = [*factors, short(SINGULAR), LIMITS]
    return [
        _listed("Its workspace is bounded by the images of", bounding, names),
        _listed("Inside the workspace, too, lie images of", crossing, names),
        _listed("Out of the joint limits' reach", away, names),
    ]


def _listed(text: str, chosen: set[str], names: Sequence[str]) -> str:
    """The sentence that lists the chosen ones in the order of `names`; empty if none is chosen."""
    if not chosen:
        return ""
    listed = [SINGULAR_POSTURES.get(name, name) for name in sorted(chosen, key=names.index)]
    return f"{text}: {', '.join(listed)}."
