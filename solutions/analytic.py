"""Three angles for a rotation, and the Jacobian of their rates.

A set of angles is named by three axes. Lower case turns about the fixed axes, upper case about the
moving ones, in reading order: "xyz" is R = Rz(c) Ry(b) Rx(a), "ZYZ" is R = Rz(a) Ry(b) Rz(c) for
angles (a, b, c). There are twelve sets, and each has both readings.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, ChainError, reals
from .jacobian import jacobian
from .kinematics import forward
from .rotation import rotations

ROLL_PITCH_YAW = "xyz"  # R = Rz(yaw) Ry(pitch) Rx(roll)
ROLL_PITCH_YAW_OF_GRIPPERS = "zyx"  # R = Rx(yaw) Ry(pitch) Rz(roll), order "xyz" of roboticstoolbox
EULER_ZYZ = "ZYZ"  # R = Rz(phi) Ry(theta) Rz(psi)
# of |cos b|, or |sin b|: closer to zero the outer angles have lost six of their sixteen digits
SINGULAR = 1e-6


class RepresentationError(ChainError):
    """Rotations at which the chosen angles are not unique; the pose itself need not be singular."""


class Turns(NamedTuple):
    """A set of angles as turns about moving axes, 0 for x, 1 for y and 2 for z.

    Attributes:
        i: The axis of the first turn.
        j: The axis of the second.
        k: The axis that is neither of them.
        last: The axis of the third turn: i or k.
        fixed: Whether the name of the set says fixed axes, so that its angles come last to first.
    """

    i: int
    j: int
    k: int
    last: int
    fixed: bool

    @property
    def alike(self) -> bool:
        """Whether the first and the last axis are the same."""
        return self.i == self.last

    @property
    def sign(self) -> float:
        """Sign of the permutation (i, j, k)."""
        if (self.j - self.i) % 3 == 1:
            return 1.0
        return -1.0


def rotation_from_angles(angles: ArrayLike, axes: str = ROLL_PITCH_YAW) -> Array:
    """Rotations (..., 3, 3) of angles (..., 3) [rad] in the set `axes`. Raises ChainError."""
    turns, (a, b, c) = _turns(axes), _moving(angles, axes)
    return _turn(turns.i, a) @ _turn(turns.j, b) @ _turn(turns.last, c)


def angles_from_rotation(rotation: ArrayLike, axes: str = ROLL_PITCH_YAW) -> Array:
    """Angles (..., 3) [rad] of rotations (..., 3, 3) in the set `axes`.

    The outer angles are in [-pi, pi], and jump where one passes its end; the middle one is in
    [-pi/2, pi/2] for three different axes and in [0, pi] where the first and last are alike. Raises
    RepresentationError where its cosine, or its sine, is below 1e-6, and ChainError.
    """
    turns, R = _turns(axes), rotations("rotation", rotation)
    i, j, k, sign = turns.i, turns.j, turns.k, turns.sign
    if turns.alike:
        size = np.hypot(R[..., i, j], R[..., i, k])
        b = np.arctan2(size, R[..., i, i])
        a = np.arctan2(R[..., j, i], -sign * R[..., k, i])
        c = np.arctan2(R[..., i, j], sign * R[..., i, k])
    else:
        size = np.hypot(R[..., i, i], R[..., i, j])
        b = np.arctan2(sign * R[..., i, k], size)
        a = np.arctan2(-sign * R[..., j, k], R[..., k, k])
        c = np.arctan2(-sign * R[..., i, j], R[..., i, i])
    _check_regular(size, axes, turns.alike)

    angles = [a, b, c]
    if turns.fixed:
        angles.reverse()
    return np.stack(angles, axis=-1)


def angular_velocity_map(angles: ArrayLike, axes: str = ROLL_PITCH_YAW) -> Array:
    """Matrices E (..., 3, 3) with omega = E angle rates, in base axes, at angles (..., 3) [rad].

    Its columns are the three axes as they stand; its determinant is, up to sign, cos b for three
    different axes and sin b where the first and last are alike. Raises ChainError.
    """
    turns, (a, b, _) = _turns(axes), _moving(angles, axes)
    first = _turn(turns.i, a)
    unit = np.broadcast_to(np.eye(3)[turns.i], (*a.shape, 3))
    second = first @ _turn(turns.j, b)
    columns = [unit, first[..., turns.j], second[..., turns.last]]
    if turns.fixed:
        columns.reverse()
    return np.stack(columns, axis=-1)


def analytic_jacobian(chain: Chain, q: ArrayLike, axes: str = ROLL_PITCH_YAW) -> Array:
    """Jacobians (..., 6, n) of the tool's position above its angles, at q (..., n).

    The linear rows are those of the geometric Jacobian in the base frame, the others E^-1 times its
    angular rows, E being the `angular_velocity_map` of the set `axes`. Raises RepresentationError
    where the angles are not unique, to the bound of `angles_from_rotation`, and ChainError.
    """
    J = jacobian(chain, q)
    angles = angles_from_rotation(forward(chain, q)[..., :3, :3], axes)
    rates = np.linalg.solve(angular_velocity_map(angles, axes), J[..., 3:, :])
    return np.concatenate([J[..., :3, :], np.asarray(rates, dtype=np.float64)], axis=-2)


def _turns(axes: str) -> Turns:
    letters = axes.lower()
    one_case = axes in (letters, axes.upper())
    if not one_case or len(axes) != 3 or set(letters) - set("xyz") or letters[1] in letters[::2]:
        raise ChainError(
            f"axes takes three letters such as 'xyz' (fixed) or 'ZYZ' (moving), got {axes!r}"
        )

    # turns about fixed axes are those about moving ones in the opposite order
    fixed = axes.islower()
    if fixed:
        letters = letters[::-1]
    i, j, last = ("xyz".index(letter) for letter in letters)
    return Turns(i, j, 3 - i - j, last, fixed)


def _moving(angles: ArrayLike, axes: str) -> tuple[Array, Array, Array]:
    """Angles (...) each, of the turns about the moving axes in their order."""
    values = reals("angles", angles)
    if values.shape[-1:] != (3,):
        raise ChainError(f"angles takes shape (..., 3), got {values.shape}")
    a, b, c = np.moveaxis(values, -1, 0)
    if axes.islower():
        return c, b, a
    return a, b, c


def _turn(axis: int, angle: Array) -> Array:
    # not `elementary`, which snaps: derivatives of angles near a multiple of pi/2 are wanted here
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R = np.zeros((*angle.shape, 3, 3))
    R[..., axis, axis] = 1.0
    R[..., i, i] = np.cos(angle)
    R[..., j, j] = R[..., i, i]
    R[..., j, i] = np.sin(angle)
    R[..., i, j] = -R[..., j, i]
    return R


def _check_regular(size: Array, axes: str, alike: bool) -> None:
    singular = size < SINGULAR
    if not singular.any():
        return

    function, values = "cosine", "+-pi/2"
    if alike:
        function, values = "sine", "0 or pi"
    where = ""
    if size.ndim:
        first = np.argwhere(singular)[0].tolist()
        where = f" at index {tuple(first)}"
    raise RepresentationError(
        f"{axes} angles take a middle angle whose {function} is at least {SINGULAR:g}, "
        f"got {size[singular][0]:.1g}{where}: "
        f"at {values} only the sum or difference of the outer two is determined"
    )
