"""Single calls at the speed of compiled code, where numba is installed (`kinegrade[fast]`)."""

from importlib.util import find_spec

from .chain import Chain
from .program.emit import COMPILES


def fast(chain: Chain) -> Chain:
    """The same chain, whose Jacobians, poses and frames of one configuration numba compiles.

    That takes about two seconds for the first call of each kind, and a tenth of a second in later
    processes: the compiled code is kept in ~/.cache/kinegrade. Results are the same to the last
    digit, and batches as fast as ever. Where numba is not installed nothing changes: see `is_fast`.
    """
    if find_spec("numba") is not None and COMPILES not in chain.compiled:
        chain.compiled.clear()
        chain.compiled[COMPILES] = True
    return chain


def is_fast(chain: Chain) -> bool:
    """Whether numba compiles the chain's programs."""
    return COMPILES in chain.compiled
