"""Where the tip of a planar arm is, its Jacobian there, and how fast it goes."""

import numpy as np
from arms import UNITS, planar
from kinegrade.exercises.draws import angles, length, rates
from kinegrade.exercises.exercise import Exercise, Mistake, Numbers, Part, Step
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward


def draw(rng):
    """Two lengths, a posture away from the stretched one, and joint rates."""
    return {"l1": length(rng), "l2": length(rng), "q": angles(rng, 2, [(0, 1)]), "rates": rates(rng, 2)}


def tip(v, given):
    """The position of the tip [m], of shape (2,)."""
    return forward(planar(v), v["q"])[:2, 3]


def from_the_axis(v, given):
    """The tip where both angles are measured from the x axis."""
    return tip(v | {"q": [v["q"][0], v["q"][1] - v["q"][0]]}, given)


def J(v, given):
    """The rows of the Jacobian for v_x and v_y [m/rad], of shape (2, 2)."""
    return jacobian(planar(v), v["q"])[:2]


def velocity(v, given):
    """The velocity of the tip [m/s], of shape (2,)."""
    return given["reach_J"] @ np.array(v["rates"])


EXERCISE = Exercise(
    slug="reach",
    title="The tip of a planar arm",
    source="week 1",
    draw=draw,
    scale=lambda v: v["l1"] + v["l2"],
    units=UNITS | {"rates": ["rad/s", "rad/s"]},
    symbols={"rates": r"\dot{\mathbf q}"},
    statement=lambda v: r"Two links of lengths $l_1, l_2$ turn in the plane; $q_2$ is measured from link 1.",
    parts=(
        Part(
            "reach_p",
            "The position $(x, y)$ of the tip",
            1,
            Numbers((2,), "m", 3),
            tip,
            mistakes=(Mistake("q2 is measured from link 1, not from the x axis.", from_the_axis),),
            explain=lambda v, given: [Step("Add the two links:", r"\mathbf p", numbers=tip(v, given))],
        ),
        Part(
            "reach_J",
            r"The 2 × 2 block of $\mathbf J$ for $v_x, v_y$",
            2,
            Numbers((2, 2), "m/rad", 3),
            J,
            explain=lambda v, given: [Step("Differentiate the position:", r"\mathbf J", numbers=J(v, given))],
        ),
        Part(
            "reach_v",
            r"The velocity $(v_x, v_y)$ of the tip at $\dot{\mathbf q}$",
            1,
            Numbers((2,), "m/s", 3),
            velocity,
            needs=("reach_J",),
            explain=lambda v, given: [Step("Multiply:", r"\mathbf v", numbers=velocity(v, given))],
        ),
    ),
)
