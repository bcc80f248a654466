"""Where the tip of a planar arm is, its Jacobian there, and how fast it goes."""

from arms import ARM
from kinegrade.exercises import questions as ask
from kinegrade.exercises.answers import Numbers
from kinegrade.exercises.draws import posture, rates
from kinegrade.exercises.part import exercise, part


def draw(rng):
    """Lengths and a posture away from the stretched one, and joint rates."""
    return posture(ARM, rng) | {"qdot": rates(rng, 2)}


def from_the_axis(arm):
    """The tip where both angles are measured from the x axis."""
    q1, q2 = arm.q
    return arm.at([q1, q2 - q1]).p[:2]


@part(
    1,
    Numbers((2,), "m", 3),
    mistakes=[("The angle q2 is measured from link 1, not from the x axis.", from_the_axis)],
)
def p(arm):
    r"""The position $(x, y)$ of the tip.

    - At which angle to the x axis does link 2 lie?

    Add the two links, the second at the angle $q_1 + q_2$:
    $$\mathbf p = <p>$$
    """
    return arm.p[:2]


EXERCISE = exercise(
    "reach",
    title="The tip of a planar arm",
    source="week 1",
    robot=ARM,
    draw=draw,
    units={"qdot": ["rad/s", "rad/s"]},
    symbols={"qdot": r"\dot{\mathbf q}"},
    parts=[p, ask.jacobian(rows="task", points=2), ask.twist(rows="task", points=1)],
)
