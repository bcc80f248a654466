"""Five matrices of a planar arm: an exercise that every marker of notebooks can be given."""

import numpy as np
from kinegrade.exercises.answers import Numbers
from kinegrade.exercises.arm import Arm, Array
from kinegrade.exercises.draws import angles, length
from kinegrade.exercises.part import exercise, part
from kinegrade.solutions.robots import ROBOTS


def draw(rng: np.random.Generator) -> dict[str, object]:
    """Lengths and joints."""
    return {"l1": length(rng), "l2": length(rng), "q": angles(rng, 2)}


@part(1, Numbers((3, 3), "1", 4))
def R(arm: Arm) -> Array:
    r"""The rotation $\mathbf R$ of the tool"""
    return arm.R


@part(1, Numbers((4, 4), [["1", "1", "1", "m"]] * 3 + [["1"] * 4], 4))
def T(arm: Arm) -> Array:
    r"""The transform $\mathbf T$ to the tool"""
    return arm.T


@part(1, Numbers((6, 2), [["m/rad"] * 2] * 3 + [["1"] * 2] * 3, 4))
def J(arm: Arm) -> Array:
    r"""The Jacobian $\mathbf J$, linear rows above angular ones"""
    return arm.J


@part(1, Numbers((2, 2), "m^2", 4))
def G(J: Array) -> Array:
    r"""$\mathbf G = \mathbf J_v^T \mathbf J_v$ of the linear rows"""
    return J[:3].T @ J[:3]


@part(1, Numbers((3, 3), "m^2", 4))
def W(J: Array) -> Array:
    r"""$\mathbf W = \mathbf J_v \mathbf J_v^T$ of the linear rows"""
    return J[:3] @ J[:3].T


EXERCISE = exercise(
    "five_matrices",
    title="Five matrices",
    source="none",
    robot=ROBOTS["planar_2r"],
    draw=draw,
    parts=[R, T, J, G, W],
)
