"""Arms that place a point: planar ones, spherical and cylindrical ones, and a SCARA."""

import math

from .limits import FULL_TURN, in_radians
from .robot import Factor, Robot

ELBOW = "elbow: arm straight or folded"

PLANAR = (
    Robot(
        name="planar_2r",
        title="Planar arm with two revolute joints",
        parameters={"l1": 1.0, "l2": 0.7},
        rows=(("q1", "0", "l1", "0"), ("q2", "0", "l2", "0")),
        limits=in_radians(FULL_TURN, FULL_TURN),
        source="S2, the planar 2R arm; lengths chosen here, limits one full turn chosen here",
        task_rows=(0, 1),
        factors=(Factor(ELBOW, "sin(q2)"),),
        constant="l1*l2",
    ),
    Robot(
        name="planar_3r",
        title="Planar arm with three revolute joints",
        parameters={"l1": 1.0, "l2": 0.8, "l3": 0.5},
        rows=(("q1", "0", "l1", "0"), ("q2", "0", "l2", "0"), ("q3", "0", "l3", "0")),
        limits=in_radians(FULL_TURN, (-150, 150), (-150, 150)),
        source="S2's planar arm with a hand added; lengths and limits chosen here",
        task_rows=(0, 1, 5),
        factors=(Factor(ELBOW, "sin(q2)"),),
        constant="l1*l2",
    ),
)
POSITIONING = (
    Robot(
        name="three_axis",
        title="Three-axis arm with a turning base, shoulder and elbow",
        parameters={"L": 3.0, "a2": 2.0, "a3": 2.0},
        rows=(
            (("Tz", "L"), ("Rz", "q1")),
            (("Rx", "pi/2"), ("Rz", "q2")),
            (("Ty", "a2"), ("Rz", "q3")),
        ),
        convention="frames",
        tool=(("Tx", "a3"),),
        limits=in_radians(FULL_TURN, (-120, 120), (-135, 135)),
        source=(
            "S0, section 4.3.1, with its lengths and its configuration; frames placed so that the "
            "printed points come out (figure 4.1 is missing); limits chosen here"
        ),
        factors=(
            Factor(ELBOW, "cos(q3)"),
            Factor("shoulder: tip on axis 1", "a3*cos(q2 + q3) - a2*sin(q2)"),
        ),
        constant="a2*a3",
        poses={"example": (0.0, -math.pi / 6, math.pi / 6)},
    ),
    Robot(
        name="rrt_spherical",
        title="Spherical arm RRT",
        parameters={"d1": 0.6},
        rows=(("q1", "d1", "0", "-pi/2"), ("q2", "0", "0", "pi/2"), ("0", "q3", "0", "0")),
        limits=(*in_radians(FULL_TURN, (-120, 120)), (0.2, 1.0)),
        source=(
            "S3, problem 5.4.1 (figure 5.2 is missing): q2 from the vertical; length and limits "
            "chosen here"
        ),
        factors=(
            Factor("stroke: hand at the shoulder", "q3", power=2),
            Factor("shoulder: hand on axis 1", "sin(q2)"),
        ),
        constant="-1",
    ),
    Robot(
        name="rrt_offset",
        title="Spherical arm RRT with shoulder offsets",
        parameters={"a1": 0.2, "d1": 0.5, "d2": 0.15},
        rows=(("q1", "d1", "a1", "-pi/2"), ("q2", "d2", "0", "pi/2"), ("0", "q3", "0", "0")),
        limits=(*in_radians(FULL_TURN, (-120, 120)), (0.2, 1.0)),
        source=(
            "S3, problem 5.4.1, with offsets a1 and d2 added; q2 from the vertical; lengths and "
            "limits chosen here"
        ),
        factors=(
            Factor("stroke: hand on axis 2", "q3"),
            Factor("shoulder: hand beside axis 1, at the distance |d2|", "a1 + q3*sin(q2)"),
        ),
        constant="-1",
    ),
    Robot(
        name="rrt_scara",
        title="SCARA-like arm RRT",
        parameters={"d1": 0.4, "a1": 0.35, "a2": 0.25},
        rows=(("q1", "d1", "a1", "0"), ("q2", "0", "a2", "pi"), ("0", "q3", "0", "0")),
        limits=(*in_radians(FULL_TURN, (-150, 150)), (0.05, 0.35)),
        source=(
            "S3, problem 5.4.1, with all axes vertical and the slide downwards; lengths and limits "
            "chosen here"
        ),
        factors=(Factor(ELBOW, "sin(q2)"),),
        constant="-a1*a2",
    ),
    Robot(
        name="rpp_cylindrical",
        title="Cylindrical arm RPP",
        parameters={"d1": 0.3},
        rows=(("q1", "d1", "0", "0"), ("0", "q2", "0", "-pi/2"), ("0", "q3", "0", "0")),
        limits=(*in_radians(FULL_TURN), (0.1, 0.6), (0.2, 0.8)),
        source=(
            "Spong, Hutchinson and Vidyasagar, the three-link cylindrical robot; length and limits "
            "chosen here"
        ),
        factors=(Factor("stroke: hand on axis 1", "q3"),),
    ),
    Robot(
        name="scara",
        title="SCARA",
        parameters={"a1": 0.325, "a2": 0.275, "d4": 0.05},
        rows=(
            ("q1", "0", "a1", "0"),
            ("q2", "0", "a2", "pi"),
            ("0", "q3", "0", "0"),
            ("q4", "d4", "0", "0"),
        ),
        limits=(*in_radians(FULL_TURN, (-150, 150)), (0.05, 0.25), *in_radians(FULL_TURN)),
        source=(
            "Spong, Hutchinson and Vidyasagar, the SCARA manipulator; lengths and limits chosen "
            "here"
        ),
        task_rows=(0, 1, 2, 5),
        factors=(Factor(ELBOW, "sin(q2)"),),
        constant="a1*a2",
    ),
)
