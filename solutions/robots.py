"""The arms of the literature, as data."""

import math

from .robot import Factor, Motion, Robot, RobotError, unknown

__all__ = ["ROBOTS", "Factor", "Motion", "Robot", "RobotError", "robot"]

DEGREE = math.pi / 180
TURN = (-180, 180)
INCH = 0.0254
ALL = (0, 1, 2, 3, 4, 5)

ELBOW = "elbow: arm straight or folded"
WRIST = "wrist: axes 4 and 6 in line"


def robot(name: str) -> Robot:
    """Robot of that name; RobotError lists the valid ones."""
    if name not in ROBOTS:
        raise RobotError(unknown("robot", name, ROBOTS))
    return ROBOTS[name]


def _degrees(*limits: tuple[float, float]) -> tuple[tuple[float, float], ...]:
    return tuple((low * DEGREE, high * DEGREE) for low, high in limits)


PLANAR = (
    Robot(
        name="planar_2r",
        title="Planar arm with two revolute joints",
        parameters={"l1": 1.0, "l2": 0.7},
        rows=(("q1", "0", "l1", "0"), ("q2", "0", "l2", "0")),
        limits=_degrees(TURN, TURN),
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
        limits=_degrees(TURN, (-150, 150), (-150, 150)),
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
        limits=_degrees(TURN, (-120, 120), (-135, 135)),
        source=(
            "S0, section 4.3.1, with its lengths and its configuration; frames placed so that the printed points come "
            "out (figure 4.1 is missing); limits chosen here"
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
        limits=(*_degrees(TURN, (-120, 120)), (0.2, 1.0)),
        source="S3, problem 5.4.1 (figure 5.2 is missing): q2 from the vertical; length and limits chosen here",
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
        limits=(*_degrees(TURN, (-120, 120)), (0.2, 1.0)),
        source="S3, problem 5.4.1, with offsets a1 and d2 added; q2 from the vertical; lengths and limits chosen here",
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
        limits=(*_degrees(TURN, (-150, 150)), (0.05, 0.35)),
        source="S3, problem 5.4.1, with all axes vertical and the slide downwards; lengths and limits chosen here",
        factors=(Factor(ELBOW, "sin(q2)"),),
        constant="-a1*a2",
    ),
    Robot(
        name="rpp_cylindrical",
        title="Cylindrical arm RPP",
        parameters={"d1": 0.3},
        rows=(("q1", "d1", "0", "0"), ("0", "q2", "0", "-pi/2"), ("0", "q3", "0", "0")),
        limits=(*_degrees(TURN), (0.1, 0.6), (0.2, 0.8)),
        source="Spong, Hutchinson and Vidyasagar, the three-link cylindrical robot; length and limits chosen here",
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
        limits=(*_degrees(TURN, (-150, 150)), (0.05, 0.25), *_degrees(TURN)),
        source="Spong, Hutchinson and Vidyasagar, the SCARA manipulator; lengths and limits chosen here",
        task_rows=(0, 1, 2, 5),
        factors=(Factor(ELBOW, "sin(q2)"),),
        constant="a1*a2",
    ),
)
STANFORD = (
    Factor("stroke: wrist centre on axis 2", "q3", power=2),
    Factor("shoulder: slide parallel to axis 1", "sin(q2)"),
    Factor(WRIST, "sin(q5)"),
)
WRISTED = (
    Robot(
        name="stanford",
        title="Stanford arm",
        parameters={"d1": 0.412, "d2": 0.154, "a3": 0.0203, "d6": 0.263},
        rows=(
            ("q1", "d1", "0", "-pi/2"),
            ("q2", "d2", "0", "pi/2"),
            ("-pi/2", "q3", "a3", "0"),
            ("q4", "0", "0", "-pi/2"),
            ("q5", "0", "0", "pi/2"),
            ("q6", "d6", "0", "0"),
        ),
        limits=(
            *_degrees((-170, 170), (-170, 170)),
            (12 * INCH, 50 * INCH),
            *_degrees((-170, 170), (-90, 90), (-170, 170)),
        ),
        source=(
            "Stanford AIM-177, figure 2.3, with the lengths and limits of roboticstoolbox-python 1.4.4; a3 displaces "
            "the hand along axis 2"
        ),
        task_rows=ALL,
        factors=STANFORD,
    ),
    Robot(
        name="stanford_spong",
        title="Stanford arm of the textbook",
        parameters={"d2": 0.1, "d6": 0.2},
        rows=(
            ("q1", "0", "0", "-pi/2"),
            ("q2", "d2", "0", "pi/2"),
            ("0", "q3", "0", "0"),
            ("q4", "0", "0", "-pi/2"),
            ("q5", "0", "0", "pi/2"),
            ("q6", "d6", "0", "0"),
        ),
        limits=(*_degrees(TURN, (-120, 120)), (0.2, 0.8), *_degrees(TURN, (-100, 100), TURN)),
        source="Spong, Hutchinson and Vidyasagar, the Stanford manipulator; lengths and limits chosen here",
        task_rows=ALL,
        factors=STANFORD,
    ),
    Robot(
        name="articulated_6r",
        title="Articulated arm 6R",
        parameters={"a2": 0.15, "a3": 0.15, "a4": 0.06},
        rows=(
            ("q1", "0", "0", "pi/2"),
            ("q2", "0", "a2", "0"),
            ("q3", "0", "a3", "0"),
            ("q4", "0", "a4", "-pi/2"),
            ("q5", "0", "0", "pi/2"),
            ("q6", "0", "0", "0"),
        ),
        limits=_degrees((-170, 170), (0, 150), (-150, 150), (-120, 120), (-100, 100), TURN),
        source="S1, the arm of Example 2.25; lengths and limits chosen here",
        task_rows=ALL,
        factors=(
            Factor("wrist: axis 6 parallel to axes 2, 3 and 4", "sin(q5)"),
            Factor(ELBOW, "sin(q3)"),
            Factor(
                "shoulder: hand on axis 1", "a2*cos(q2) + a3*cos(q2 + q3) + a4*cos(q2 + q3 + q4)"
            ),
        ),
        constant="a2*a3",
    ),
    Robot(
        name="puma560",
        title="Puma 560",
        parameters={"d1": 26.45 * INCH, "a2": 0.4318, "a3": 0.0203, "d3": 0.15005, "d4": 0.4318},
        rows=(
            ("q1", "d1", "0", "pi/2"),
            ("q2", "0", "a2", "0"),
            ("q3", "d3", "a3", "-pi/2"),
            ("q4", "d4", "0", "pi/2"),
            ("q5", "0", "0", "-pi/2"),
            ("q6", "0", "0", "0"),
        ),
        limits=_degrees((-160, 160), (-45, 225), (-225, 45), (-110, 170), (-100, 100), (-266, 266)),
        source=(
            "S3, problem 5.4.2; Corke and Armstrong-Helouvry, ICRA 1994, as in the Robotics Toolbox, with its named "
            "configurations and S3's own; d1 is the pedestal of 26.45 in; limits from the toolbox's model of the Puma "
            "560 after Wang and Chen, IEEE Trans. RA 7(4), 1991"
        ),
        task_rows=ALL,
        factors=(
            Factor(WRIST, "sin(q5)"),
            Factor(ELBOW, "a3*sin(q3) + d4*cos(q3)"),
            Factor(
                "shoulder: wrist centre beside axis 1, at the distance |d3|",
                "a2*cos(q2) + a3*cos(q2 + q3) - d4*sin(q2 + q3)",
            ),
        ),
        constant="a2",
        poses={
            "qz": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
            "qr": (0.0, math.pi / 2, -math.pi / 2, 0.0, 0.0, 0.0),
            "qs": (0.0, 0.0, -math.pi / 2, 0.0, 0.0, 0.0),
            "qn": (0.0, math.pi / 4, math.pi, 0.0, math.pi / 4, 0.0),
            "example": (0.1, 0.5, 0.1, 0.8, 0.1, 0.2),
        },
    ),
    Robot(
        name="ur5",
        title="Universal Robots UR5",
        parameters={
            "d1": 0.089459,
            "a2": -0.425,
            "a3": -0.39225,
            "d4": 0.10915,
            "d5": 0.09465,
            "d6": 0.0823,
        },
        rows=(
            ("q1", "d1", "0", "pi/2"),
            ("q2", "0", "a2", "0"),
            ("q3", "0", "a3", "0"),
            ("q4", "d4", "0", "pi/2"),
            ("q5", "d5", "0", "-pi/2"),
            ("q6", "d6", "0", "0"),
        ),
        limits=((-2 * math.pi, 2 * math.pi),) * 6,
        source=(
            "Universal Robots, parameters for calculations of kinematics, as in roboticstoolbox-python 1.4.4 with its "
            "named configurations; limits from the maker's data sheet"
        ),
        task_rows=ALL,
        factors=(
            Factor("wrist: axis 6 parallel to axes 2, 3 and 4", "sin(q5)"),
            Factor(ELBOW, "sin(q3)"),
            Factor(
                "shoulder: axes 5 and 6 meet beside axis 1, at the distance |d4|",
                "a2*cos(q2) + a3*cos(q2 + q3) + d5*sin(q2 + q3 + q4)",
            ),
        ),
        constant="a2*a3",
        poses={
            "qz": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
            "qr": (math.pi, 0.0, 0.0, 0.0, math.pi / 2, 0.0),
        },
    ),
    Robot(
        name="panda",
        title="Franka Emika Panda",
        parameters={
            "d1": 0.333,
            "d3": 0.316,
            "a4": 0.0825,
            "d5": 0.384,
            "a7": 0.088,
            "d7": 0.107,
            "h": 0.103,
        },
        rows=(
            ("q1", "d1", "0", "0"),
            ("q2", "0", "0", "-pi/2"),
            ("q3", "d3", "0", "pi/2"),
            ("q4", "0", "a4", "pi/2"),
            ("q5", "d5", "-a4", "-pi/2"),
            ("q6", "0", "0", "pi/2"),
            ("q7", "d7", "a7", "pi/2"),
        ),
        convention="modified",
        tool=(("Tz", "h"), ("Rz", "-pi/4")),
        limits=(
            (-2.8973, 2.8973),
            (-1.7628, 1.7628),
            (-2.8973, 2.8973),
            (-3.0718, -0.0698),
            (-2.8973, 2.8973),
            (-0.0175, 3.7525),
            (-2.8973, 2.8973),
        ),
        source=(
            "Franka Emika, robot and interface specifications: Denavit-Hartenberg parameters after Craig, limits; hand "
            "and named configuration of roboticstoolbox-python 1.4.4"
        ),
        task_rows=ALL,
        poses={"qr": (0.0, -0.3, 0.0, -2.2, 0.0, 2.0, math.pi / 4)},
    ),
)
ROBOTS: dict[str, Robot] = {arm.name: arm for arm in (*PLANAR, *POSITIONING, *WRISTED)}
