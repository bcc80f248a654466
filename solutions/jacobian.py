"""The geometric Jacobian of a chain.

What others call it: `jacobian(chain, q)` is roboticstoolbox's `jacob0` and Pinocchio's
LOCAL_WORLD_ALIGNED, frame "tool" is `jacobe` and LOCAL, point "origin" is Pinocchio's WORLD.
modern_robotics has the angular rows on top: its `JacobianSpace` is point "origin" and its
`JacobianBody` frame "tool", with the rows 3, 4, 5, 0, 1, 2.
"""

from typing import Literal, cast

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, ChainError, configuration, reals
from .program.emit import evaluate, plain
from .rotation import rotations

Frame = Literal["base", "tool"]
Axes = Frame | Array  # of rotations (..., 3, 3)
Point = Literal["origin"] | ArrayLike  # points (..., 3) in base coordinates


def jacobian(
    chain: Chain,
    q: ArrayLike,
    frame: Axes = "base",
    out: Array | None = None,
    *,
    point: Point | None = None,
) -> Array:
    """Jacobians (..., 6, n) at q (..., n): xi = J qdot, linear rows above angular.

    Column i is [z x (p - o); z] for a revolute and [z; 0] for a prismatic joint (S0, eq. 4.8 and
    4.10). The twist is that of the tool point, in axes of the base or of the tool `frame`. Entries
    are in m/rad and 1 (revolute), 1 and 0 (prismatic). With `out`, a C-contiguous float64 array of
    that shape, the result is written there.

    `frame` may also be rotations (..., 3, 3) whose columns are the wanted axes in base coordinates,
    and `point` another point that moves with the tool: coordinates (..., 3) in the base [m], or
    "origin", that of the base. Both broadcast with q. Raises ChainError.
    """
    if point is not None or not isinstance(frame, str):
        J = _elsewhere(chain, configuration(chain.n, q), frame, point)
        return J if out is None else _copied(J, out)

    if out is None and frame in ("base", "tool"):
        known = plain(chain, frame, q)
        if known is not None:
            return known
    values = configuration(chain.n, q)
    check_frame(frame)
    if out is not None:
        _check_out((*values.shape[:-1], 6, chain.n), out)
    return evaluate(chain, frame, values, out)


def in_axes(J: ArrayLike, rotation: ArrayLike) -> Array:
    """J (..., 6, n) in other axes: both blocks times R^T.

    The columns of `rotation` (..., 3, 3) are the new axes, given in the axes J is in; the point
    stays. Twists (..., 6) go as twists[..., None]. Raises ChainError.
    """
    columns, R = _six_rows(J), rotations("rotation", rotation)
    check_batch("rotation", R.shape[:-2], columns)
    return np.concatenate([R.mT @ columns[..., :3, :], R.mT @ columns[..., 3:, :]], axis=-2)


def at_point(J: ArrayLike, offset: ArrayLike) -> Array:
    """J (..., 6, n) of another point of the tool, `offset` (..., 3) [m] from it: v + w x offset.

    The offset is given in the axes J is in; the axes stay. Twists (..., 6) go as
    twists[..., None]. Raises ChainError.
    """
    columns, r = _six_rows(J), reals("offset", offset)
    if r.shape[-1:] != (3,):
        raise ChainError(f"offset takes shape (..., 3), got {r.shape}")
    check_batch("offset", r.shape[:-1], columns)
    moved = columns[..., :3, :] + np.cross(columns[..., 3:, :], r[..., None], axis=-2)
    return np.concatenate([moved, np.broadcast_to(columns[..., 3:, :], moved.shape)], axis=-2)


def last_frame_columns(transforms: ArrayLike, kinds: str) -> Array:
    """Jacobian (6, n) in axes of the last frame, from the transforms (n, 4, 4) of ^(i-1)T_n.

    With n, o, a the columns of the rotation and p the position of ^(i-1)T_n, a revolute column is
    [-n_x p_y + n_y p_x, -o_x p_y + o_y p_x, -a_x p_y + a_y p_x, n_z, o_z, a_z] and a prismatic one
    [n_z, o_z, a_z, 0, 0, 0] (S1, eq. 5.26, 5.27). Raises ChainError if there is not one transform
    for each joint.
    """
    T = np.asarray(transforms, dtype=np.float64)
    if T.shape != (len(kinds), 4, 4) or set(kinds) - {"R", "P"}:
        raise ChainError(
            f"transforms takes shape {(len(kinds), 4, 4)} for kinds {kinds!r}, got {T.shape}"
        )
    # rows of the rotation: (n_x, o_x, a_x) and so on
    x, y, z = np.moveaxis(T[:, :3, :3], 1, 0)
    p = T[:, :3, 3, None]
    revolute = np.concatenate([-x * p[:, 1] + y * p[:, 0], z], axis=1)
    prismatic = np.concatenate([z, np.zeros_like(z)], axis=1)
    turns = np.array([kind == "R" for kind in kinds])[:, None]
    return np.ascontiguousarray(np.where(turns, revolute, prismatic).T)


def check_frame(frame: object) -> None:
    """Raises ChainError for anything but the names "base" and "tool"."""
    if not isinstance(frame, str) or frame not in ("base", "tool"):
        raise ChainError(f"frame takes 'base' or 'tool', got {frame!r}")


def check_batch(
    name: str, batch: tuple[int, ...], J: Array, fits: str = "a batch that fits"
) -> None:
    """Raises ChainError for a batch that does not broadcast with that of matrices J (..., m, n)."""
    try:
        np.broadcast_shapes(batch, J.shape[:-2])
    except ValueError:
        raise ChainError(f"{name} takes {fits} {J.shape[:-2]}, got {batch}") from None


def _elsewhere(chain: Chain, q: Array, frame: Axes, point: Point | None) -> Array:
    if isinstance(frame, str):
        check_frame(frame)
    columns, T = evaluate(chain, "base", q), evaluate(chain, "pose", q)
    if point is not None:
        columns = at_point(columns, _place(point, columns) - T[..., :3, 3])

    if not isinstance(frame, str):
        R = rotations("frame", frame)
        check_batch("frame", R.shape[:-2], columns)
        return in_axes(columns, R)
    if frame == "tool":
        return in_axes(columns, T[..., :3, :3])
    return columns


def _place(point: Point, J: Array) -> Array:
    if isinstance(point, str):
        if point != "origin":
            raise ChainError(f"point takes 'origin' or coordinates (..., 3), got {point!r}")
        return np.zeros(3)
    place = reals("point", point)
    if place.shape[-1:] != (3,):
        raise ChainError(f"point takes 'origin' or coordinates (..., 3), got shape {place.shape}")
    check_batch("point", place.shape[:-1], J)
    return place


def _six_rows(J: ArrayLike) -> Array:
    columns = reals("J", J)
    if columns.ndim < 2 or columns.shape[-2] != 6:
        raise ChainError(f"J takes shape (..., 6, n), got {columns.shape}")
    return columns


def _check_out(shape: tuple[int, ...], out: object) -> None:
    array = cast("Array", out)
    if not isinstance(out, np.ndarray):
        found = f"a {type(out).__name__}"
    elif array.shape != shape or array.dtype != np.float64:
        found = f"{array.dtype} of shape {array.shape}"
    elif not array.flags.c_contiguous:
        found = "strides that are not C-contiguous"
    elif not array.flags.writeable:
        found = "a read-only one"
    else:
        return
    raise ChainError(
        f"out takes a writable, C-contiguous array, float64 of shape {shape}, got {found}"
    )


def _copied(J: Array, out: Array) -> Array:
    _check_out(J.shape, out)
    np.copyto(out, J)
    return out
