"""The RRT robot of S3 5.4.1: its forms, the draw of one, and its drawings."""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.robots import ROBOTS, Robot
from ..drawing import Dimension, Drawing, Triad, point
from ..draws import angles, length
from ..exercise import Variant

Array = NDArray[np.float64]
LENGTHS = ("d1", "a1", "d2", "l3")
OFFSETS = ((), ("a1",), ("d2",), ("l3",), ("a1", "d2"), ("a1", "l3"), ("d2", "l3"))
FORMS = tuple((alpha1, offsets) for offsets in OFFSETS for alpha1 in (-90, 90))


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 14 forms (which offsets, which sense of axis 2), away from its singular postures."""
    form = int(rng.integers(len(FORMS)))
    alpha1, offsets = FORMS[form]
    while True:
        v: dict[str, Any] = {"form": form, "d1": length(rng)}
        v |= {name: length(rng, 0.2, 0.5) for name in offsets}
        v["q"] = [*angles(rng, 2), length(rng)]
        stretch = v["q"][2] + v.get("l3", 0.0)
        reach = v.get("a1", 0.0) - np.sign(alpha1) * stretch * np.sin(v["q"][1])
        if abs(reach) > 0.2:
            return v


def lengths(v: Variant) -> dict[str, float]:
    return {name: v[name] for name in LENGTHS if name in v}


@lru_cache
def robot(form: int) -> Robot:
    """The arm of one form, with every length 1 m by default."""
    alpha1, offsets = FORMS[form]
    first, second = ("pi/2", "-pi/2") if alpha1 > 0 else ("-pi/2", "pi/2")
    return Robot(
        name="rrt",
        title="RRT robot",
        parameters=dict.fromkeys((name for name in LENGTHS if name in ("d1", *offsets)), 1.0),
        rows=(
            ("q1", "d1", "a1" if "a1" in offsets else "0", first),
            ("q2", "d2" if "d2" in offsets else "0", "0", second),
            ("0", "q3 + l3" if "l3" in offsets else "q3", "0", "0"),
        ),
        limits=ROBOTS["rrt_spherical"].limits,
        source="S3 5.4.1; figure 5.2 is missing, the form is drawn for each student",
    )


def robot_of(v: Variant) -> Robot:
    return robot(v["form"])


def drawings(v: Variant) -> tuple[Drawing, ...]:
    home = (0.0, 0.0, v["q"][2])
    return (
        _drawing(v, home, "Home pose, q1 = q2 = 0, with the positive sense of each joint.", with_lengths=True),
        _drawing(v, tuple(v["q"]), "The same robot at your q.", with_lengths=False),
    )


def _drawing(v: Variant, q: tuple[float, ...], caption: str, *, with_lengths: bool) -> Drawing:
    arm = robot_of(v)
    poses = arm.frames(lengths(v), q)
    return Drawing(
        arm.chain(lengths(v)),
        q,
        caption,
        f"RRT arm: a vertical revolute joint, a horizontal revolute joint, a slide. {caption}",
        (Triad(poses[0], "0"), *((Triad(poses[-1], "tool"),) if with_lengths else ())),
        _dimensions(v, poses) if with_lengths else (),
    )


def _dimensions(v: Variant, poses: Array) -> tuple[Dimension, ...]:
    """One line for every length and for the stroke q3, along the arm at home."""
    corner = poses[0, :3, 3]
    lines: list[Dimension] = []
    for name, size, direction in (
        ("d1", v["d1"], poses[0, :3, 2]),
        ("a1", v.get("a1", 0.0), poses[1, :3, 0]),
        ("d2", v.get("d2", 0.0), poses[1, :3, 2]),
        ("l3", v.get("l3", 0.0), poses[2, :3, 2]),
        ("q3", v["q"][2], poses[2, :3, 2]),
    ):
        end = corner + size * direction
        if size:
            lines.append(Dimension(point(corner), point(end), name))
        corner = end
    return tuple(lines)
