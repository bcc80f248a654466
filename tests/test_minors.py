"""Minors of arms with a joint to spare: they make the self-motion, and where all vanish the arm is singular."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from kinegrade.solutions.any_robot import robot_from_chain
from kinegrade.solutions.determinant import DeterminantError
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.minors import minors, self_motion
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.singularity import SingularityError, sigma_min

PANDA = ROBOTS["panda"]
CHAIN = PANDA.chain()
A4, A7, D3, D5 = (PANDA.parameters[name] for name in ("a4", "a7", "d3", "d5"))


def relative_sigma(q):
    J = jacobian(CHAIN, np.array(q))
    return sigma_min(J) / np.linalg.norm(J, 2)


def test_panda_elbow_is_singular_where_q5_is_straight_and_shoulder_elbow_and_wrist_are_in_line():
    """sin q5 = 0 and a4 (a4 s4 - (d3 + d5) c4) = d3 d5 s4."""
    q4 = np.arctan2(-A4 * (D3 + D5), D3 * D5 - A4**2)
    assert A4 * (A4 * np.sin(q4) - (D3 + D5) * np.cos(q4)) == pytest.approx(D3 * D5 * np.sin(q4))
    for q in np.random.default_rng(1).uniform(-2, 2, (20, 7)):
        for q5 in (0.0, np.pi):
            assert relative_sigma([*q[:3], q4, q5, *q[5:]]) < 1e-12
        assert relative_sigma([*q[:3], q4, 0.3, *q[5:]]) > 1e-6
        assert relative_sigma([*q[:3], q4 + 0.3, 0.0, *q[5:]]) > 1e-6


def test_panda_is_singular_stretched_where_axis_6_meets_the_line_of_the_arm():
    """q4 = 0 and (d3 + d5) s6 = -a7."""
    for sine in (np.arcsin(-A7 / (D3 + D5)), np.pi - np.arcsin(-A7 / (D3 + D5))):
        for q in np.random.default_rng(2).uniform(-2, 2, (20, 7)):
            assert relative_sigma([*q[:3], 0.0, q[4], sine, q[6]]) < 1e-12
            assert relative_sigma([*q[:3], 0.3, q[4], sine, q[6]]) > 1e-7


def test_panda_wrist_is_singular_where_q5_is_right_and_axes_5_to_7_cannot_help():
    """cos q5 = 0 and the factor of the minor without joint 6 vanishes: found for each q4."""
    (factor,) = [e for name, e, _ in minors(PANDA)[5].factors if "q6" in name]
    lengths = {sp.Symbol(name, real=True): x for name, x in PANDA.parameters.items()}
    left = factor.subs(lengths)
    value = sp.lambdify([sp.Symbol("q4", real=True), sp.Symbol("q6", real=True)], left)
    for q in np.random.default_rng(3).uniform(-2, 2, (20, 7)):
        at = np.array([value(q[3], q6) for q6 in (0.0, np.pi / 2, np.pi)])
        constant, sine = (at[0] + at[2]) / 2, at[1] - (at[0] + at[2]) / 2
        if abs(constant / sine) > 0.95:
            continue
        q6 = np.arcsin(-constant / sine)
        for q5 in (np.pi / 2, -np.pi / 2):
            assert relative_sigma([*q[:4], q5, q6, q[6]]) < 1e-12
        assert relative_sigma([*q[:4], 0.7, q6, q[6]]) > 1e-7


def test_panda_shoulder_is_singular_where_axes_1_and_3_are_one_and_the_other_six_are():
    """q2 = 0 or pi, and the minor without joint 1 vanishes, which is no matter of q1, q2 and q7 then."""
    rng = np.random.default_rng(4)
    met = 0
    for q in rng.uniform(-2, 2, (40, 7)):
        q[1] = 0.0

        def first_minor(q6, q=q):
            return self_motion(jacobian(CHAIN, np.array([*q[:5], q6, q[6]])))[0]

        line = np.linspace(-3, 3, 60)
        values = np.array([first_minor(x) for x in line])
        for i in np.flatnonzero(values[1:] * values[:-1] < 0)[:1]:
            low, high = line[i], line[i + 1]
            for _ in range(60):
                middle = (low + high) / 2
                if first_minor(middle) * first_minor(low) > 0:
                    low = middle
                else:
                    high = middle
            met += 1
            assert relative_sigma([*q[:5], low, q[6]]) < 1e-10
    assert met > 10
    for index in (1, 3, 4, 5, 6):
        assert any(str(e) == "sin(q2)" for _, e, _ in minors(PANDA)[index].factors)


def test_the_minors_of_the_panda_are_those_of_the_engine():
    found = minors(PANDA)
    joints = sp.symbols("q1:8", real=True)
    for q in np.random.default_rng(5).uniform(-2, 2, (3, 7)):
        rates = self_motion(jacobian(CHAIN, q))
        values = {sp.Symbol(n, real=True): v for n, v in PANDA.parameters.items()}
        values |= dict(zip(joints, q.tolist(), strict=True))
        for i, minor in enumerate(found):
            assert (-1) ** i * float(minor.expression.subs(values)) == pytest.approx(
                rates[i], rel=1e-9, abs=1e-13
            )


def test_the_tool_stands_still_and_the_squares_add_to_the_determinant_of_the_square():
    for seed in range(50):
        rng = np.random.default_rng(seed)
        chain = random_chain("".join(rng.choice(["R", "R", "P"], 5)) + "RR", rng)
        J = jacobian(chain, rng.uniform(-2, 2, (3, 7)))
        rates = self_motion(J)
        np.testing.assert_allclose((J @ rates[..., None])[..., 0], 0.0, atol=1e-12)
        np.testing.assert_allclose(
            (rates**2).sum(axis=-1), np.linalg.det(J @ J.mT), rtol=1e-8, atol=1e-15
        )


def test_a_planar_arm_that_prescribes_two_rows_is_singular_where_it_is_straight():
    arm = replace(ROBOTS["planar_3r"], task_rows=(0, 1), factors=())
    first, *_ = minors(arm)
    assert [str(e) for _, e, _ in first.factors] == ["sin(q3)"]
    for q, singular in (
        ([0.3, 0.0, 0.0], True),
        ([0.3, np.pi, 0.0], True),
        ([0.3, 0.1, 0.0], False),
    ):
        J = jacobian(arm.chain(), np.array(q))[:2]
        assert (np.abs(self_motion(J)).max() < 1e-12) == singular


def test_other_arms_are_refused():
    with pytest.raises(DeterminantError, match="one joint more than task rows, got puma560"):
        minors(ROBOTS["puma560"])
    with pytest.raises(SingularityError, match="one column more than rows"):
        self_motion(np.eye(6))
    oblique = robot_from_chain(random_chain("R" * 7, np.random.default_rng(0)), named=True)
    with pytest.raises(DeterminantError, match="self_motion has their values"):
        minors(oblique)
