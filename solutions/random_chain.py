"""Random chains that are nowhere special, for properties and benchmarks."""

from itertools import accumulate

import numpy as np

from .chain import Array, Chain, ChainError, steps_transform

TRIES = 24
OBLIQUE = (np.pi / 6, 5 * np.pi / 6)  # between one joint's axis and the next [rad]
LENGTHS = (0.2, 0.8)  # of a link [m]
SMALLEST = 1e-300  # singular value; below it the quotient would be infinite


def random_chain(pattern: str, rng: np.random.Generator) -> Chain:
    """Chain with joints as in `pattern`, such as "RRPRRR": oblique axes, links of 0.2 to 0.8 m.

    Of a few draws it is the one whose Jacobian at q = 0 has the smallest condition number, at the
    rank that the pattern allows: a slide only ever adds to the three linear directions. Raises
    ChainError.
    """
    if not pattern or set(pattern) - {"R", "P"}:
        raise ChainError(f"pattern takes one letter R or P for each joint, got {pattern!r}")

    draws = [_constants(len(pattern) + 1, rng) for _ in range(TRIES)]
    conditions = [_condition(fixed, pattern) for fixed in draws]
    return Chain(draws[int(np.argmin(conditions))], pattern)


def _constants(count: int, rng: np.random.Generator) -> Array:
    """Constant transforms (count, 4, 4) of a chain."""
    return np.array([_link(rng) for _ in range(count)])


def _link(rng: np.random.Generator) -> Array:
    before, behind = rng.uniform(-np.pi, np.pi, 2)
    oblique = rng.uniform(*OBLIQUE)
    length = rng.uniform(*LENGTHS)
    link = steps_transform([("Rz", before), ("Rx", oblique), ("Rz", behind)])

    direction = rng.normal(size=3)
    link[:3, 3] = length * direction / np.linalg.norm(direction)
    return link


def _condition(fixed: Array, pattern: str) -> float:
    """Condition number of the Jacobian at q = 0, over the rank that it can have."""
    reached = np.array(list(accumulate(fixed, np.matmul)))
    z = reached[:-1, :3, 2]
    lever = reached[-1, :3, 3] - reached[:-1, :3, 3]

    turns = (np.array(list(pattern)) == "R")[:, None]
    linear = np.where(turns, np.cross(z, lever), z)
    angular = np.where(turns, z, 0.0)
    values = np.linalg.svd(np.concatenate([linear, angular], axis=1), compute_uv=False)

    slides = pattern.count("P")
    rank = min(6, min(3, slides) + pattern.count("R"))
    return float(values[0] / max(values[rank - 1], SMALLEST))
