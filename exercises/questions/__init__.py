"""Ready-made questions for any robot of the catalogue, a table or a URDF: `ask.jacobian()` in the list of parts.

Each brings its prompt, units, tolerance, hints, worked solution and known mistakes, and takes what stands before it on
the sheet: a Jacobian is built from the student's transforms where these are asked, torques from the student's J.
`name` and `points` may be given; so may the names of what it takes, such as `ask.twist(J="J_tool", qdot="rates")`.
"""

from .block import determinant, ellipsoid, manipulability, singular
from .frames import dh_table, transforms
from .statics import torques
from .velocities import jacobian, rates, twist

__all__ = [
    "determinant",
    "dh_table",
    "ellipsoid",
    "jacobian",
    "manipulability",
    "rates",
    "singular",
    "torques",
    "transforms",
    "twist",
]
