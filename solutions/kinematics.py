"""Forward kinematics of a chain."""

from numpy.typing import ArrayLike

from .chain import OWN_MOTIONS, Array, Chain, configuration, elementary
from .program.emit import evaluate, plain


def forward(chain: Chain, q: ArrayLike) -> Array:
    """Tool transforms T(q) in base coordinates, shape (..., 4, 4), at q (..., n) [rad, m].

    Raises ChainError if q is not real, finite and of that shape.
    """
    known = plain(chain, "pose", q)
    if known is not None:
        return known
    return evaluate(chain, "pose", configuration(chain.n, q))


def multiplied(chain: Chain, q: ArrayLike) -> Array:
    """The same transforms (..., 4, 4) by multiplying link by link.

    A chain that is seen once is not worth a program. Raises ChainError as `forward` does.
    """
    values = configuration(chain.n, q)
    pose = chain.fixed[0]
    for joint, kind in enumerate(chain.kinds):
        own = elementary(OWN_MOTIONS[kind], values[..., joint])
        pose = pose @ own @ chain.fixed[joint + 1]
    return pose


def frames(chain: Chain, q: ArrayLike) -> Array:
    """Frames in base coordinates, shape (..., n + 1, 4, 4), at q (..., n) [rad, m].

    Frame i - 1 is the one before E_i: its z is the axis of joint i, its origin a point on it. The
    last is the tool. Raises ChainError if q is not real, finite and of that shape.
    """
    known = plain(chain, "frames", q)
    if known is not None:
        return known
    return evaluate(chain, "frames", configuration(chain.n, q))
