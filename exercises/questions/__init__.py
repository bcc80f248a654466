"""Ready-made questions for any robot, table or URDF: `ask.jacobian()` in the list of parts.

Each brings its prompt, units, tolerance, hints, worked solution and known mistakes, and takes what
stands before it on the sheet: a Jacobian is built from the student's transforms where these are
asked, torques from the student's J. `name` and `points` may be given; so may the names of what it
takes, such as `ask.twist(J="J_tool", qdot="rates")`.
"""

from .block import determinant, manipulability_formula, singular
from .ellipsoids import ellipsoid, ellipsoid_axis, manipulability
from .frames import dh_table, pose, transforms
from .jacobians import jacobian
from .other_frames import to_base_origin, to_tool_axes
from .statics import torques, wrench_in_base_axes
from .velocities import rates, twist

__all__ = [
    "determinant",
    "dh_table",
    "ellipsoid",
    "ellipsoid_axis",
    "jacobian",
    "manipulability",
    "manipulability_formula",
    "pose",
    "rates",
    "singular",
    "to_base_origin",
    "to_tool_axes",
    "torques",
    "transforms",
    "twist",
    "wrench_in_base_axes",
]
