# pyright: basic
"""Figures of where a robot is singular and where its tool gets, with the finding in words."""

import re
from functools import lru_cache
from io import BytesIO
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ...solutions.errors import KinegradeError
from ...solutions.expression import latex_name, parse
from ...solutions.singularity import (
    Parameters,
    RegionalArm,
    Values,
    arm,
    factor_values,
    sigma_min,
    task_block,
    zero_set,
)
from ...solutions.workspace import LIMITS, SINGULAR, Section, reach, section
from .panels import JointMap, short, sigma_unit, sign_rule, spatial_panels
from .planar_panels import planar_panels

if TYPE_CHECKING:
    from ...solutions.robots import Robot

SAMPLES = 181  # per axis of a joint map
STYLE: Any = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 11,
    "axes.titlesize": 12,
    "legend.fontsize": 10,
    "legend.frameon": False,
    "hatch.linewidth": 0.6,
    "svg.hashsalt": "kinegrade",
    "svg.fonttype": "path",
}


class FigureError(KinegradeError):
    """A figure that cannot be drawn."""


def figure(robot: "Robot", parameters: Parameters = None) -> Figure:
    """The robot's singularities and workspace: three panels, 12 inches wide."""
    with mpl.rc_context(STYLE):
        found, cut = _found(robot, tuple(robot.values(parameters).items()))
        flat = found.part.chain.kinds == "RR" and cut.axes == ("x", "y")
        drawn = Figure(figsize=(12, 4.7 if flat else 5.5), dpi=100, layout="constrained")
        FigureCanvasAgg(drawn)
        (planar_panels if flat else spatial_panels)(
            drawn, found, cut, _formula(robot, found, parameters)
        )
        values = ",  ".join(
            f"${latex_name(n)}={v:.5g}$" for n, v in robot.values(parameters).items()
        )
        drawn.suptitle(f"{robot.title}  ({values} m)", fontsize=13)
        # Ticks and layout settle here, inside the style; later draws repeat them.
        drawn.draw_without_rendering()
        drawn.set_layout_engine("none")
    return drawn


def picture(robot: "Robot", suffix: str, parameters: Parameters = None) -> bytes:
    """The figure as a file that ends in .png, .svg or .pdf, the same bytes every time.

    Raises:
        FigureError: Another suffix.
    """
    kind = suffix.lower()
    dates = {".png": {"Software": None}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    if kind not in dates:
        raise FigureError(f"A figure takes a name in .png, .svg or .pdf, got one in {suffix!r}.")
    drawn = figure(robot, parameters)
    file = BytesIO()
    with mpl.rc_context(STYLE):
        drawn.savefig(file, format=kind[1:], metadata=dates[kind])
    return file.getvalue()


def joint_map(robot: "Robot", parameters: Parameters = None) -> JointMap:
    """The map over q2 and q3 (of a two-joint arm: q1 and q2), the other joints held."""
    part = arm(robot, parameters)
    n = part.chain.n
    if n < 2:
        raise FigureError(
            f"A joint map takes a robot of two joints or more, got {robot.name} with {n}."
        )
    free = (0, 1) if n == 2 else (1, 2)
    spans = (_span(part, free[0]), _span(part, free[1]))
    # Held joints stay off zero, where a wrist is singular whatever the arm does.
    held = (
        np.array([low + 0.62 * (high - low) for low, high in part.limits]) if n > 3 else np.zeros(n)
    )
    held[0] = 0.0
    q = np.broadcast_to(held, (SAMPLES, SAMPLES, n)).copy()
    x, y = (low + (high - low) * (np.arange(SAMPLES) + 0.5) / SAMPLES for low, high in spans)
    q[..., free[0]], q[..., free[1]] = np.meshgrid(x, y)
    block = task_block(part, q)
    det = np.linalg.det(block) if block.shape[-1] == block.shape[-2] else None
    at = np.concatenate([held, np.zeros(robot.n - n)])
    curves = (
        (factor.name, zero_set(robot, factor.name, parameters, free=free, at=at, ranges=spans))
        for factor in part.factors
    )
    seen = tuple(
        (name, lines) for name, lines in curves if lines
    )  # a wrist has no line on a map of shoulder and elbow
    return JointMap(part, free, spans, held, sigma_min(block), det, seen)


@lru_cache(maxsize=8)
def _found(robot: "Robot", values: tuple[tuple[str, float], ...]) -> tuple[JointMap, Section]:
    """Both halves of a figure, kept for its description and its other formats."""
    return joint_map(robot, dict(values)), section(robot, dict(values))


def _span(part: RegionalArm, joint: int) -> tuple[float, float]:
    low, high = part.limits[joint]
    if part.chain.kinds[joint] == "R":
        return -np.pi, np.pi
    margin = 0.08 * (high - low)
    return min(low, 0.0) - margin, max(high, 0.0) + margin


def _formula(robot: "Robot", found: JointMap, parameters: Parameters) -> str | None:
    """The determinant as the robot's constant times the factors of the drawn block, where that is what it is."""
    part, n = found.part, found.part.chain.n
    texts = [
        _shorthand(robot.constant, 1),
        *(_shorthand(f.expression, f.power) for f in part.factors),
    ]
    if found.det is None or not part.factors or None in texts:
        return None
    q = np.array([[0.3, 0.7, 0.4, -0.5, 0.6, 0.2], [0.3, -1.1, 1.3, 0.9, -0.8, 0.5]])[:, : robot.n]
    values = factor_values(robot, parameters, q)
    product = parse(robot.constant, robot.names).at(robot.values(parameters))
    product = product * np.prod([values[f.name] ** f.power for f in part.factors], axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):  # a length may be zero
        ratio = np.linalg.det(task_block(part, q[:, :n])) / product
    if not np.allclose(np.abs(ratio), 1.0) or ratio[0] * ratio[1] < 0:
        return None  # the wrist's part of a constant is of size 1
    sign = "-" if (ratio[0] < 0) != str(texts[0]).startswith("-") else ""
    lengths = str(texts[0]).lstrip("-")
    product_text = r"\,".join([*([lengths] if lengths != "1" else []), *map(str, texts[1:])])
    return rf"$\det\mathbf{{A}}={sign}{product_text}$"


def _shorthand(expression: str, power: int) -> str | None:
    """A sum of products in the course's shorthand, s_23 for sin(q2 + q3); None for any other expression."""
    text = re.sub(
        r"(sin|cos)\(([q0-9 +]+)\)",
        lambda m: f"{m[1][0]}_{{{re.sub('[q +]', '', m[2])}}}",
        expression,
    )
    if re.search(r"[(/^]|\*\*", text):
        return None
    terms = [
        r"\,".join(_symbol(s) for s in term.split("*")) for term in re.split(r"(?= [+-] )", text)
    ]
    text = "".join(terms) if len(terms) == 1 else f"({''.join(terms)})"
    return text if power == 1 else f"{text}^{power}"


def _symbol(text: str) -> str:
    sign, name = re.findall(r"^(\s*[+-]?\s*)(.*?)\s*$", text)[0]
    return sign.strip() + (name if "{" in name else latex_name(name))


def describe(robot: "Robot", parameters: Parameters = None) -> str:
    """The figure in words: what is singular and where, how far the tool gets, and what bounds its workspace."""
    found, cut = _found(robot, tuple(robot.values(parameters).items()))
    part, point = found.part, found.part.point
    values = ", ".join(
        f"{name} = {value:.5g} m" for name, value in robot.values(parameters).items()
    )
    first, second = (f"q{i + 1}" for i in found.free)
    near, far = (0.0 if value < 1e-9 else value for value in reach(robot, parameters))
    where = "; ".join(f"{name} ({_where(found, lines)})" for name, lines in found.curves)
    bound = f"{np.nanmax(cut.cells):.3g} {sigma_unit(part)}"
    sentences = [
        f"Singularities and workspace: {robot.title} ({values}).",
        f"Over {first} and {second}, the smallest singular value of the {point}'s Jacobian block is at most {bound}.",
        f"It falls to zero, where the {point} loses a direction, on: {where}." if where else "",
        sign_rule(found) if found.det is not None else "",
        f"Within the joint limits the {point} gets from {near:.3g} m to {far:.3g} m away from axis 1.",
        _walls(part, cut),
    ]
    return " ".join(sentence for sentence in sentences if sentence)


def _where(found: JointMap, lines: tuple[Values, ...]) -> str:
    """The values of a joint on straight lines along the map; else how far a curve runs."""
    for k, joint in ((1, found.free[1]), (0, found.free[0])):
        if lines and all(np.ptp(line[:, k]) < 1e-6 for line in lines):
            values = {
                _value(found.part, joint, float(line[0, k])): None
                for line in sorted(lines, key=lambda v: abs(v[0, k]))
            }
            return f"q{joint + 1} = " + " and ".join(values)
    return "a curve across the map" if lines else "nowhere on the map"


def _value(part: RegionalArm, joint: int, value: float) -> str:
    turn = part.chain.kinds[joint] == "R" and abs(abs(value) - np.pi) < 1e-9
    value = 0.0 if abs(value) < 1e-9 else np.pi if turn else value
    return f"{np.degrees(value):.4g}°" if part.chain.kinds[joint] == "R" else f"{value:.3g} m"


def _walls(part: RegionalArm, cut: Section) -> str:
    found = {curve.name for curve in cut.curves}
    factors = (
        [] if SINGULAR in found else [short(f.name) for f in part.factors]
    )  # those of another, larger, block
    names = [*factors, short(SINGULAR), LIMITS]
    bounding = {short(curve.name) for curve in cut.curves if curve.boundary.any()}
    crossing = {
        short(curve.name)
        for curve in cut.curves
        if (~curve.boundary).any() and curve.name != LIMITS
    }
    away = set(factors) - {short(name) for name in found} if found else set()
    texts = [
        ("Its workspace is bounded by the images of: ", bounding),
        ("Singular inside the workspace: ", crossing),
        ("Out of the joint limits' reach: ", away),
    ]
    return " ".join(
        f"{text}{', '.join(n for n in names if n in chosen)}." for text, chosen in texts if chosen
    )
