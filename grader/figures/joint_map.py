# pyright: basic
"""What a map over two joints shows of a robot's singularities, and how its parts are named."""

from dataclasses import dataclass

from ...solutions.singularity import RegionalArm, Values


@dataclass(frozen=True, eq=False)
class JointMap:
    """The task block A of a Jacobian over a plane of two joints.

    Attributes:
        part: The arm whose block it is.
        free: Indices of the two joints that vary: the first to the right, the second upwards.
        spans: From where to where each of the two varies [rad or m].
        held: The configuration (n,) whose other joints stay as they are.
        sigma: The smallest singular value (samples, samples); rows go with the second joint.
        det: The determinant (samples, samples), None where the block is not square.
        curves: Name of each factor that is zero somewhere on the map, and its lines (k, 2) there.
    """

    part: RegionalArm
    free: tuple[int, int]
    spans: tuple[tuple[float, float], tuple[float, float]]
    held: Values
    sigma: Values
    det: Values | None
    curves: tuple[tuple[str, tuple[Values, ...]], ...]


def short(name: str) -> str:
    """A factor's name without what it means: "elbow" of "elbow: arm straight or folded"."""
    return name.partition(":")[0]


def sign_rule(found: JointMap) -> str:
    """The sentence on where the determinant changes sign on a map; empty if it never does."""
    on_map = {name for name, _ in found.curves}
    crossed, touched = [], []
    for factor in found.part.factors:
        if factor.name not in on_map:
            continue
        # An even power is zero on its curve and has the same sign on both sides.
        chosen = crossed if factor.power % 2 else touched
        chosen.append(short(factor.name))

    if not crossed:
        return ""
    rule = f"det A changes sign across {' and '.join(crossed)}"
    if touched:
        rule += f", but not across {' and '.join(touched)}"
    return f"{rule}."


def sigma_unit(part: RegionalArm) -> str:
    """The unit of the block's singular values."""
    if max(part.rows) > 2:
        return "(mixed units)"
    if "P" in part.chain.kinds:
        return "m/s per unit joint rate"
    return "m"
