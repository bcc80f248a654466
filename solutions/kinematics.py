"""Forward kinematics of a chain."""

from numpy.typing import ArrayLike

from .chain import Array, Chain, configuration
from .program.emit import evaluate, plain


def forward(chain: Chain, q: ArrayLike) -> Array:
    """Tool transforms T(q) in base coordinates, shape (..., 4, 4), at q (..., n) [rad, m].

    Raises ChainError if q is not real, finite and of that shape.
    """
    known = plain(chain, "pose", q)
    if known is not None:
        return known
    return evaluate(chain, "pose", configuration(chain.n, q))


def frames(chain: Chain, q: ArrayLike) -> Array:
    """Frames in base coordinates, shape (..., n + 1, 4, 4), at q (..., n) [rad, m].

    Frame i - 1 is the one before E_i: its z is the axis of joint i, its origin a point on it. The
    last is the tool. Raises ChainError if q is not real, finite and of that shape.
    """
    known = plain(chain, "frames", q)
    if known is not None:
        return known
    return evaluate(chain, "frames", configuration(chain.n, q))
