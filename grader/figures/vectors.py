"""Vectors of two or three numbers, as a picture needs them."""

from math import sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def norm(v: Array) -> float:
    """The length of a vector."""
    return sqrt(float(v @ v))


def unit(v: Array) -> Array:
    """`v` over its length; zero stays zero."""
    length = norm(v)
    if length <= 1e-12:
        return np.zeros_like(v)
    return v / length


def cross(a: Array, b: Array) -> Array:
    """The vector product of two vectors (3,); many times faster than numpy's on so few."""
    (p, q, r), (x, y, z) = a.tolist(), b.tolist()
    return np.array([q * z - r * y, r * x - p * z, p * y - q * x])


def lifted(p: Array) -> Array:
    """`p` (2,) as a vector (3,) in the plane of the picture."""
    return np.array([p[0], p[1], 0.0])


def quarter_turned(v: Array) -> Array:
    """`v` (2,) turned by a right angle in the plane of the picture."""
    return np.array([-v[1], v[0]])


def spaced(first: float, last: float, count: int) -> Array:
    """`count` numbers from `first` to `last`."""
    return np.asarray(np.linspace(first, last, count), dtype=np.float64)


def square_to(d: Array) -> tuple[Array, Array]:
    """Two unit vectors square to the unit vector `d` and to each other."""
    least = int(np.argmin(np.abs(d)))
    u = unit(cross(d, np.eye(3)[least]))
    return u, cross(d, u)


def along_line(start: Array, end: Array, shares: tuple[float, ...]) -> Array:
    """Points (k, d) at these shares of the way from `start` (d,) to `end`."""
    return np.stack([start + share * (end - start) for share in shares])


def every_pixel(points: Array) -> Array:
    """Points about a pixel apart along the line through `points` (k, 2 or 3)."""
    steps = np.sqrt(((points[1:] - points[:-1]) ** 2).sum(1))
    reach = np.concatenate([[0.0], steps.cumsum()])
    at = spaced(0.0, float(reach[-1]), int(reach[-1]) + 2)
    coordinates = range(points.shape[1])
    return np.column_stack([np.interp(at, reach, points[:, k]) for k in coordinates])
