"""One Newton step, a damped pseudoinverse and a whole solver (after CTU PKR HW07)."""

import numpy as np
from kinegrade.exercises.answers import Function, Numbers
from kinegrade.exercises.draws import posture
from kinegrade.exercises.part import part
from kinegrade.solutions.robots import ROBOTS

ARM = ROBOTS["planar_3r"]


def draw(rng):
    drawn = posture(ARM, rng)
    drawn["dx"] = [float(x) / 1000 for x in rng.integers(20, 80, 2) * rng.choice([-1, 1], 2)]
    drawn["wide"], drawn["square"] = (
        rng.normal(size=(2, 3)).round(3).tolist(),
        rng.normal(size=(3, 3)).round(3).tolist(),
    )
    return drawn | {"near": rng.uniform(-0.1, 0.1, 3).tolist(), "far": rng.uniform(0.3, 0.6, 3).tolist()}


@part(2, Numbers((3,), "rad", 5), mistakes=[("The transposed J is no inverse.", lambda J, dx: J.T @ dx)])
def dq(J, dx):
    r"""The first Newton step $\Delta\mathbf q = \mathbf J^+ \Delta\mathbf x$"""
    return np.linalg.pinv(J) @ dx


@part(1, Numbers((2,), "m", 6))
def error(arm, dq, dx):
    """How far the tip is off the target after that step"""
    return arm.at(arm.q + dq).p[:2] - arm.p[:2] - dx


def damped(A, lam):
    return A.T @ np.linalg.inv(A @ A.T + lam**2 * np.eye(len(A)))


@part(3, Function("(A, lam)", lambda v: {name: [(v[name], 0.1), (v[name], 0.3)] for name in ("wide", "square")}))
def inverse():
    r"""A function that returns $\mathbf A^T(\mathbf A \mathbf A^T + \lambda^2 \mathbf I)^{-1}$"""
    return damped
