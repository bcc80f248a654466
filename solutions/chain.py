"""The normal form of an arm: T(q) = C0 E1(q1) C1 E2(q2) ... En(qn) Cn."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import KinegradeError

Array = NDArray[np.float64]
MOTIONS = ("Rx", "Ry", "Rz", "Tx", "Ty", "Tz")
OWN_MOTIONS = {"R": "Rz", "P": "Tz"}
"""What a joint of each kind does in its own frame."""
SNAP = 1e-15  # cos(pi/2) is 6e-17 in floating point; the trace can drop only exact zeros and ones
IDENTITY = np.eye(4)


class ChainError(KinegradeError):
    """A chain, or a configuration of one, that is not of the stated form."""


@dataclass(frozen=True, eq=False)
class Chain:
    """Joint i turns about, or slides along, the z axis of the frame before E_i.

    `fixed` (n + 1, 4, 4) holds C0 ... Cn, read-only: entries of rotations within 1e-15 of 0 and +-1
    are exact, and lengths below 1e-15 of the longest are 0. `kinds` names the joints in order, "R"
    revolute and "P" prismatic. Raises ChainError.
    """

    fixed: Array
    kinds: str
    compiled: dict[str, Any] = field(default_factory=dict[str, Any], init=False, repr=False)

    def __post_init__(self) -> None:
        fixed = reals("fixed", self.fixed)

        if not self.kinds or set(self.kinds) - {"R", "P"}:
            raise ChainError(f"kinds takes one letter R or P for each joint, got {self.kinds!r}")
        expected = (len(self.kinds) + 1, 4, 4)
        if fixed.shape != expected:
            raise ChainError(
                f"fixed takes shape {expected} for kinds {self.kinds!r}, got {fixed.shape}"
            )

        fixed = snapped_transforms(fixed)
        _check_rigid(fixed)
        fixed.flags.writeable = False
        object.__setattr__(self, "fixed", fixed)

    def __reduce__(self) -> tuple[type["Chain"], tuple[Array, str]]:
        """Leave the compiled programs behind: functions do not travel between processes."""
        return Chain, (self.fixed, self.kinds)

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.kinds)


def snapped(values: ArrayLike) -> Array:
    """Copy of `values` with entries within 1e-15 of 0 and +-1 made exact."""
    array = np.array(values, dtype=np.float64)
    nearest = np.round(array)
    close = (np.abs(array - nearest) < SNAP) & (np.abs(nearest) <= 1)
    return np.where(close, nearest + 0.0, array)  # -0.0 + 0.0 is 0.0


def _snapped(value: float) -> float:
    """The same of one number in [-1, 1], in a tenth of the time; what is no number stays."""
    for whole in (0.0, 1.0, -1.0):
        if abs(value - whole) < SNAP:
            return whole
    return value


def snapped_transforms(transforms: Array) -> Array:
    """Copy of transforms (..., 4, 4): rotations `snapped`, very short lengths made 0.

    Those are the ones below 1e-15 of the longest of them all.
    """
    result = snapped(transforms)
    p = transforms[..., :3, 3]
    longest = np.max(np.abs(p), initial=0.0)
    result[..., :3, 3] = np.where(np.abs(p) < SNAP * longest, 0.0, p + 0.0)
    return result


def elementary(motion: str, amount: ArrayLike) -> Array:
    """Transforms (..., 4, 4) of one rotation [rad] or translation [m] about or along one axis.

    `motion` is "Rx" ... "Tz", `amount` has shape (...).
    """
    if motion not in MOTIONS:
        raise ChainError(f"motion takes one of {', '.join(MOTIONS)}, got {motion!r}")

    value = np.asarray(amount, dtype=np.float64)
    transform = np.zeros((*value.shape, 4, 4))
    transform[...] = IDENTITY
    axis = "xyz".index(motion[1])
    if motion[0] == "T":
        transform[..., axis, 3] = value
        return transform

    i, j = (axis + 1) % 3, (axis + 2) % 3  # the plane that turns
    if value.ndim:
        cosine, sine = snapped(np.cos(value)), snapped(np.sin(value))
    else:
        cosine, sine = _snapped(float(np.cos(value))), _snapped(float(np.sin(value)))
    transform[..., i, i] = cosine
    transform[..., j, j] = cosine
    transform[..., i, j] = -sine
    transform[..., j, i] = sine
    return transform


def standard_transform(rows: ArrayLike) -> Array:
    """Rz(theta) Tz(d) Tx(a) Rx(alpha), shape (..., 4, 4), of rows (..., 4): theta, d, a, alpha."""
    theta, d, a, alpha = np.moveaxis(np.asarray(rows, dtype=np.float64), -1, 0)
    return (
        elementary("Rz", theta)
        @ elementary("Tz", d)
        @ elementary("Tx", a)
        @ elementary("Rx", alpha)
    )


def modified_transform(rows: ArrayLike) -> Array:
    """Rx(alpha) Tx(a) Rz(theta) Tz(d), shape (..., 4, 4), of rows (..., 4): theta, d, a, alpha.

    Row i holds alpha and a of the link before joint i (Craig, eq. 3.6).
    """
    theta, d, a, alpha = np.moveaxis(np.asarray(rows, dtype=np.float64), -1, 0)
    return (
        elementary("Rx", alpha)
        @ elementary("Tx", a)
        @ elementary("Rz", theta)
        @ elementary("Tz", d)
    )


def from_standard(
    rows: ArrayLike, kinds: str, base: ArrayLike | None = None, tool: ArrayLike | None = None
) -> Chain:
    """Chain of a standard Denavit-Hartenberg table with rows (n, 4): theta, d, a, alpha [rad, m].

    The theta (revolute) or d (prismatic) of a row is that joint's offset. Raises ChainError.
    """
    links = standard_transform(_table(rows, kinds))
    links[-1] = links[-1] @ _transform("tool", tool)
    return Chain(np.concatenate([_transform("base", base)[None], links]), kinds)


def from_modified(
    rows: ArrayLike, kinds: str, base: ArrayLike | None = None, tool: ArrayLike | None = None
) -> Chain:
    """Chain of a modified Denavit-Hartenberg table with rows (n, 4): theta, d, a, alpha [rad, m].

    The theta (revolute) or d (prismatic) of a row is that joint's offset. Raises ChainError.
    """
    theta, d, a, alpha = _table(rows, kinds).T
    zero = np.zeros(len(kinds))
    before = modified_transform(np.stack([zero, zero, a, alpha], axis=-1))
    behind = modified_transform(np.stack([theta, d, zero, zero], axis=-1))

    # an offset and the link of the next row share a constant
    first = _transform("base", base) @ before[0]
    last = behind[-1] @ _transform("tool", tool)
    return Chain(np.stack([first, *(behind[:-1] @ before[1:]), last]), kinds)


def from_frames(placements: ArrayLike, kinds: str, tool: ArrayLike | None = None) -> Chain:
    """Chain of hand-placed frames.

    `placements` (n, 4, 4) put each joint's frame into the one before it. Raises ChainError.
    """
    frames = reals("placements", placements)
    if frames.shape != (len(kinds), 4, 4):
        raise ChainError(f"placements takes shape {(len(kinds), 4, 4)}, got {frames.shape}")
    return Chain(np.concatenate([frames, _transform("tool", tool)[None]]), kinds)


def configuration(n: int, q: ArrayLike, name: str = "q") -> Array:
    """Joint values as float64 of shape (..., n); ChainError says what is wrong with other input."""
    values = reals(name, q)
    if values.ndim == 0 or values.shape[-1] != n:
        raise ChainError(f"{name} takes shape (..., {n}), got {values.shape}")
    return values


def one_configuration(n: int, q: ArrayLike, name: str = "q") -> Array:
    """Joint values as float64 of shape (n,); ChainError says what is wrong with other input."""
    values = configuration(n, q, name)
    if values.ndim != 1:
        raise ChainError(f"{name} takes shape ({n},), got {values.shape}")
    return values


def product(transforms: Iterable[Array]) -> Array:
    """Product of transforms, left to right; the identity if there are none."""
    result = np.eye(4)
    for transform in transforms:
        result = result @ transform
    return result


def steps_transform(steps: Sequence[tuple[str, ArrayLike]]) -> Array:
    """Product (..., 4, 4) of elementary motions, given as pairs such as ("Tz", 0.3)."""
    return product(elementary(motion, amount) for motion, amount in steps)


def reals(name: str, values: ArrayLike) -> Array:
    """Values as float64; ChainError if they are ragged, not real numbers or not finite."""
    try:
        array = np.asarray(values)
    except (ValueError, TypeError):
        raise ChainError(
            f"{name} takes rows of equal length, got rows of different lengths"
        ) from None
    if array.size and array.dtype.kind not in "iuf":
        raise ChainError(f"{name} takes real numbers, got values of type {array.dtype.name}")

    array = array.astype(np.float64)
    if not np.isfinite(array).all():
        raise ChainError(f"{name} takes finite numbers, got NaN or infinity")
    return array


def _table(rows: ArrayLike, kinds: str) -> Array:
    numbers = reals("rows", rows)
    if not kinds or numbers.shape != (len(kinds), 4):
        raise ChainError(
            f"rows takes shape {(len(kinds), 4)} for kinds {kinds!r}, got {numbers.shape}"
        )
    return numbers


def _transform(name: str, value: ArrayLike | None) -> Array:
    if value is None:
        return np.eye(4)
    transform = reals(name, value)
    if transform.shape != (4, 4):
        raise ChainError(f"{name} takes shape (4, 4), got {transform.shape}")
    return snapped_transforms(transform)


def _check_rigid(fixed: Array) -> None:
    """Raises ChainError for the first of transforms (m, 4, 4) that moves no rigid body."""
    R = fixed[:, :3, :3]
    last_row = (fixed[:, 3] != IDENTITY[3]).any(axis=1)
    rotation = np.abs(R.mT @ R - IDENTITY[:3, :3]).max(axis=(1, 2)) > 1e-9
    rotation |= np.linalg.det(R) < 0
    wrong = np.flatnonzero(last_row | rotation)
    if not len(wrong):
        return
    first = wrong[0]
    if last_row[first]:
        raise ChainError(
            f"fixed[{first}] takes the last row [0 0 0 1], got {fixed[first, 3].tolist()}"
        )
    raise ChainError(
        f"fixed[{first}] takes a right-handed rotation in its upper left corner, got another matrix"
    )
