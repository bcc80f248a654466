"""A gauge between a frame of one chain and the frame of another that stands for it."""

from dataclasses import dataclass, replace
from math import pi

import numpy as np

from ..chain import Array

UNLINKED = (np.eye(4), np.eye(4))


@dataclass(frozen=True, eq=False)
class Gauge:
    """A gauge up to translations still open: `turn` (3, 3), `shift` (3,) + `open` (3, m) y.

    `chosen` (k,) + `choice` (k, m) y are the values of all unknowns met so far, called `names`:
    first those of the base, then c1, c2 ... With a `pending` joint the turn may be followed by
    any angle about its axis, and `links` are the transforms of both chains from that joint on.
    """

    turn: Array
    shift: Array
    open: Array
    chosen: Array
    choice: Array
    names: tuple[str, ...]
    signs: tuple[float, ...]
    pending: int | None = None
    links: tuple[Array, Array] = UNLINKED

    def with_open(self, name: str, direction: Array) -> "Gauge":
        """The gauge with another open translation along a direction (3,)."""
        count, columns = self.choice.shape
        choice = np.zeros((count + 1, columns + 1))
        choice[:count, :columns] = self.choice
        choice[count, columns] = 1.0
        return replace(
            self,
            open=np.column_stack([self.open, direction]),
            chosen=np.append(self.chosen, 0.0),
            choice=choice,
            names=(*self.names, name),
        )

    def with_angle(self, name: str, angle: float) -> "Gauge":
        """The gauge with a settled unknown noted down."""
        choice = np.vstack([self.choice, np.zeros((1, self.choice.shape[1]))])
        chosen = np.append(self.chosen, wrapped(angle))
        return replace(self, chosen=chosen, choice=choice, names=(*self.names, name))

    def settled(self, y: Array, left: Array) -> "Gauge":
        """The gauge with y replaced by y + left z."""
        return replace(
            self,
            shift=self.shift + self.open @ y,
            open=self.open @ left,
            chosen=self.chosen + self.choice @ y,
            choice=self.choice @ left,
        )


def wrapped(angle: Array | float) -> Array:
    """Angles [rad] within half a turn."""
    return np.asarray((np.asarray(angle) + pi) % (2 * pi) - pi, dtype=np.float64)
