"""Properties that make an answer right where it is not unique, and what must not pass for them."""

import numpy as np
import pytest
from kinegrade.exercises.properties import (
    is_pseudoinverse,
    is_right_inverse,
    list_share,
    meets,
    parallel,
    proportional,
)
from kinegrade.solutions.expression_array import expression_array

RNG = np.random.default_rng(3)
J = RNG.uniform(-1, 1, (3, 5))
PINV = np.linalg.pinv(J)
NULL = np.linalg.svd(J)[2][3:].T


def test_the_pseudoinverse_is_one_of_many_right_inverses():
    other = PINV + NULL @ RNG.uniform(-1, 1, (2, 3))
    assert is_pseudoinverse(J, PINV, 1e-9)
    assert is_right_inverse(J, PINV, 1e-9)
    assert is_right_inverse(J, other, 1e-9)
    assert not is_pseudoinverse(J, other, 1e-3)


@pytest.mark.parametrize("X", [np.zeros((5, 3)), J.T, -PINV, np.ones((5, 3))])
def test_what_is_no_inverse_is_none(X):
    assert not is_right_inverse(J, X, 1e-3)
    assert not is_pseudoinverse(J, X, 1e-3)


def test_a_direction_has_no_length_and_no_sign_unless_asked():
    u = np.array([0.36, 0.48, 0.8])
    assert parallel(-3 * u, u, 1e-9)
    assert not parallel(-3 * u, u, 1e-9, sign=True)
    assert parallel(u + np.array([0, 1e-4, 0]), u, 1e-3)
    assert not parallel(u + np.array([0, 0.1, 0]), u, 1e-3)
    assert not parallel(np.zeros(3), u, 1e-3)


def test_rates_meet_a_target_row_by_row():
    rates = PINV @ [1, 0, 0]
    assert meets(J, rates, [1, 0, 0], 1e-9)
    assert meets(J, rates + NULL[:, 0], [1, 0, 0], 1e-9)
    assert not meets(J, rates, [1, 0, 0.1], [1e-3, 1e-3, 1e-3])


@pytest.mark.parametrize(
    ("text", "same"), [("-2*l1*s(q2)", True), ("l1*s(q2)^2", False), ("0", False), ("l1", False)]
)
def test_a_determinant_may_be_asked_up_to_a_constant(text, same):
    names = ("l1", "q2")
    reference = expression_array("l1*sin(q2)", names)
    assert (
        proportional(expression_array(text.replace("s(", "sin("), names), reference, names) is same
    )


def test_a_list_earns_what_it_hits_less_what_is_wrong():
    right, share = list_share([[1.0, 2.0], [0.0, 0.0]], [[1.0 + 2 * np.pi, 2.0], [3.0, 3.0]], 1e-6)
    assert right.tolist() == [[True, True], [False, False]]
    assert share == 0
    assert list_share([[1.0, 2.0]], [[1.0, 2.0], [3.0, 3.0]], 1e-6)[1] == 1 / 2
    assert list_share([[0.5, 0.0]], [[1.0, 2.0]], 1e-6, holds=lambda row: row[1] == 0)[0].all()
