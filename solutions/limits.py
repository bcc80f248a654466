"""Joint limits: which joints are outside theirs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .chain import configuration, one_configuration

Limits = Sequence[tuple[float, float]]
ROUNDING = 1e-12  # of a limit: 120 degrees are the same number however they are computed
TURN = (-math.pi, math.pi)  # of a joint that goes all the way round [rad]
FULL_TURN = (-180, 180)  # the same [deg]
DEGREE = math.pi / 180


@dataclass(frozen=True)
class Outside:
    """A joint, counted from 1, whose value is outside its limits [rad, m]."""

    joint: int
    kind: str
    value: float
    low: float
    high: float

    def __str__(self) -> str:
        """A sentence for people, with angles in degrees."""
        limits = f"{self._shown(self.low)} to {self._shown(self.high)}"
        return f"q{self.joint} takes {limits}, got {self._shown(self.value)}"

    def _shown(self, value: float) -> str:
        if self.kind == "R":
            return f"{math.degrees(value):.7g}\N{DEGREE SIGN}"
        return f"{value:.7g} m"


def in_radians(*degrees: tuple[float, float]) -> tuple[tuple[float, float], ...]:
    """Limits [rad] of revolute joints whose limits are given in degrees."""
    return tuple((low * DEGREE, high * DEGREE) for low, high in degrees)


def outside(limits: Limits, kinds: str, q: ArrayLike) -> tuple[Outside, ...]:
    """The joints that are outside their limits at q (n,) [rad, m], in order.

    None is within rounding of a limit. Angles count as they stand: 190 degrees are not -170.
    Raises ChainError if q is not real, finite and of that shape.
    """
    values = one_configuration(len(limits), q)
    found = list[Outside]()
    for i in np.flatnonzero(are_outside(limits, values)).tolist():
        low, high = limits[i]
        found.append(Outside(i + 1, kinds[i], float(values[i]), low, high))
    return tuple(found)


def are_outside(limits: Limits | NDArray[np.float64], q: ArrayLike) -> NDArray[np.bool_]:
    """Whether each joint is outside its limits (..., n), at q (..., n) [rad, m].

    Raises ChainError.
    """
    values = configuration(len(limits), q)
    low, high = np.transpose(np.asarray(limits, dtype=np.float64))
    return (values < low - ROUNDING * _size(low)) | (values > high + ROUNDING * _size(high))


def _size(limit: NDArray[np.float64]) -> NDArray[np.float64]:
    """How large a limit is; 0 for none, where rounding has no meaning."""
    return np.where(np.isfinite(limit), np.abs(limit), 0.0)
