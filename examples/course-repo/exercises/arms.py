"""The arm of this course: two links that turn in a plane.

It defines no exercise, so exercises can share it.
"""

from kinegrade.solutions.any_robot import robot_from_table

ARM = robot_from_table(
    [("q1", "0", "l1", "0"), ("q2", "0", "l2", "0")],  # theta, d, a, alpha
    {"l1": 0.8, "l2": 0.6},
    title="Planar arm of the laboratory",
    task_rows=(0, 1),
)
