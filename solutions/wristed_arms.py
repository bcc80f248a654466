"""Arms with a wrist, six joints and more."""

import math

from .limits import FULL_TURN, in_radians
from .positioning_arms import ELBOW
from .robot import ALL, Factor, Robot

INCH = 0.0254  # [m]
WRIST = "wrist: axes 4 and 6 in line"

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
            *in_radians((-170, 170), (-170, 170)),
            (12 * INCH, 50 * INCH),
            *in_radians((-170, 170), (-90, 90), (-170, 170)),
        ),
        source=(
            "Stanford AIM-177, figure 2.3, with the lengths and limits of roboticstoolbox-python "
            "1.4.4; a3 displaces the hand along axis 2"
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
        limits=(
            *in_radians(FULL_TURN, (-120, 120)),
            (0.2, 0.8),
            *in_radians(FULL_TURN, (-100, 100), FULL_TURN),
        ),
        source=(
            "Spong, Hutchinson and Vidyasagar, the Stanford manipulator; lengths and limits chosen "
            "here"
        ),
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
        limits=in_radians((-170, 170), (0, 150), (-150, 150), (-120, 120), (-100, 100), FULL_TURN),
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
        limits=in_radians(
            (-160, 160), (-45, 225), (-225, 45), (-110, 170), (-100, 100), (-266, 266)
        ),
        source=(
            "S3, problem 5.4.2; Corke and Armstrong-Helouvry, ICRA 1994, as in the Robotics "
            "Toolbox, with its named configurations and S3's own; d1 is the pedestal of 26.45 in; "
            "limits from the toolbox's model of the Puma 560 after Wang and Chen, IEEE Trans. RA "
            "7(4), 1991"
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
            "Universal Robots, parameters for calculations of kinematics, as in "
            "roboticstoolbox-python 1.4.4 with its named configurations; limits from the maker's "
            "data sheet"
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
            "Franka Emika, robot and interface specifications: Denavit-Hartenberg parameters after "
            "Craig, limits; hand and named configuration of roboticstoolbox-python 1.4.4"
        ),
        task_rows=ALL,
        poses={"qr": (0.0, -0.3, 0.0, -2.2, 0.0, 2.0, math.pi / 4)},
    ),
)
