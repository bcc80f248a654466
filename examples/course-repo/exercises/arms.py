"""The arm of this course: two links that turn in a plane. It defines no exercise, so exercises can share it."""

from kinegrade.solutions.robots import ROBOTS

UNITS = {"l1": "m", "l2": "m", "q": ["rad", "rad"]}


def planar(v):
    """The student's arm as a chain, from the lengths l1 and l2 [m]."""
    return ROBOTS["planar_2r"].chain({"l1": v["l1"], "l2": v["l2"]})
