"""One Newton step, a damped pseudoinverse and a whole solver (after CTU PKR HW07)."""

import numpy as np
from kinegrade.exercises import questions as ask
from kinegrade.exercises.answers import Function, Numbers
from kinegrade.exercises.draws import posture
from kinegrade.exercises.exercise import Outcome
from kinegrade.exercises.part import exercise, part
from kinegrade.solutions.robots import ROBOTS

ARM = ROBOTS["planar_3r"]


def draw(rng):
    v = posture(ARM, rng) | {"dx": [float(x) / 1000 for x in rng.integers(20, 80, 2)]}
    v["matrices"] = [
        rng.uniform(-1, 1, shape).round(2).tolist() for shape in ((2, 3), (3, 6), (3, 3))
    ]
    return v | {
        "links": [[0.5, 0.4, 0.3], [0.6, 0.2, 0.4]],
        "starts": rng.uniform(0.3, 0.9, (2, 3)).round(3).tolist(),
    }


@part(
    2,
    Numbers((3,), "rad", 5),
    mistakes=[("The transposed J is no inverse.", lambda J, dx: J.T @ dx)],
)
def dq(J, dx):
    r"""The first Newton step $\Delta\mathbf q = \mathbf J^+ \Delta\mathbf x$"""
    return np.linalg.pinv(J) @ dx


@part(1, Numbers((2,), "m", 6))
def error(arm, dq, dx):
    """How far the tip is off the target after that step"""
    return (arm.at(arm.q + dq).p - arm.p)[:2] - dx


@part(
    3,
    Function(
        "(A, lam)",
        lambda v: {f"matrix {i}": [(A, 0.1), (A, 0.3)] for i, A in enumerate(v["matrices"])},
    ),
)
def damped():
    r"""A function that returns $\mathbf A^T(\mathbf A \mathbf A^T + \lambda^2 \mathbf I)^{-1}$"""

    def solution(A, lam):
        return A.T @ np.linalg.inv(A @ A.T + lam**2 * np.eye(len(A)))

    return solution


def tip(links, q):
    angles = np.cumsum(q)
    return np.array([np.dot(links, np.cos(angles)), np.dot(links, np.sin(angles))])


def targets(v):
    arms = zip(v["links"], v["starts"], strict=True)
    return {
        f"arm {i}": [(links, tip(links, [0.4, 0.9, 0.2]).tolist(), q)]
        for i, (links, q) in enumerate(arms)
    }


def judged(v, value):
    found = value.by_group(targets(v))
    return Outcome(right=[reaches(call, *found[group]) for group, (call,) in targets(v).items()])


def reaches(call, q):
    links, x, _ = call
    return (
        not isinstance(q, str)
        and q.shape == (3,)
        and bool(np.linalg.norm(tip(links, q) - x) < 1e-4)
    )


@part(4, Function("(links, x, q0)", targets), check=judged)
def solve():
    """A function that returns angles at which the tip of an arm with these links is within 0.1 mm of x, from q0 on"""

    def solution(links, x, q0):
        q = np.array(q0)
        for _ in range(200):
            angles = np.cumsum(q)
            along = np.array([links * np.cos(angles), links * np.sin(angles)])
            J = np.array([-along[1], along[0]])[:, ::-1].cumsum(axis=1)[:, ::-1]
            q = q + J.T @ np.linalg.solve(J @ J.T + 0.01 * np.eye(2), x - along.sum(axis=1))
        return q

    return solution


EXERCISE = exercise(
    "newton_ik",
    title="Inverse kinematics by Newton steps",
    source="CTU PKR HW07",
    robot=ARM,
    draw=draw,
    units={"dx": ["m"] * 2},
    hidden=("matrices", "links", "starts"),
    symbols={"dx": r"\Delta\mathbf x"},
    parts=[ask.jacobian(rows=(0, 1), points=2), dq, error, damped, solve],
)
