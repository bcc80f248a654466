"""Random chains that are nowhere special, for properties and benchmarks."""

import numpy as np

from .chain import Array, Chain, ChainError, product, steps_transform

TRIES = 24
OBLIQUE = (np.pi / 6, 5 * np.pi / 6)  # between one joint's axis and the next [rad]
LENGTHS = (0.2, 0.8)  # of a link [m]


def random_chain(pattern: str, rng: np.random.Generator) -> Chain:
    """Chain with joints as in `pattern`, such as "RRPRRR": oblique axes and links of 0.2 to 0.8 m.

    Of a few draws it is the one whose Jacobian at q = 0 has the smallest condition number, at the rank that the
    pattern allows: a slide only ever adds to the three linear directions. Raises ChainError.
    """
    if not pattern or set(pattern) - {"R", "P"}:
        raise ChainError(f"pattern takes one letter R or P for each joint, got {pattern!r}")
    draws = [np.array([_link(rng) for _ in range(len(pattern) + 1)]) for _ in range(TRIES)]
    return Chain(min(draws, key=lambda fixed: _condition(fixed, pattern)), pattern)


def _link(rng: np.random.Generator) -> Array:
    before, behind = rng.uniform(-np.pi, np.pi, 2)
    oblique, length = rng.uniform(*OBLIQUE), rng.uniform(*LENGTHS)
    link = steps_transform([("Rz", before), ("Rx", oblique), ("Rz", behind)])
    direction = rng.normal(size=3)
    link[:3, 3] = length * direction / np.linalg.norm(direction)
    return link


def _condition(fixed: Array, pattern: str) -> float:
    reached = np.array([product(fixed[: i + 1]) for i in range(len(fixed))])
    z, lever = reached[:-1, :3, 2], reached[-1, :3, 3] - reached[:-1, :3, 3]
    turns = np.array([kind == "R" for kind in pattern])[:, None]
    J = np.concatenate([np.where(turns, np.cross(z, lever), z), np.where(turns, z, 0.0)], axis=1)
    values = np.linalg.svd(J, compute_uv=False)
    rank = min(6, min(3, pattern.count("P")) + pattern.count("R"))
    return float(values[0] / max(values[rank - 1], 1e-300))
