"""Joint rates by reading, for other robots and other axes than those of the Puma's sheet."""

import numpy as np
import pytest
from kinegrade.exercises.arm import arm_of
from kinegrade.exercises.calculations.readings import LINEAR, WHOLE, Speed, judged_rates, rates_for
from kinegrade.solutions.jacobian import in_axes
from kinegrade.solutions.robots import ROBOTS

PANDA = arm_of(ROBOTS["panda"], {"q": [0.3, -0.5, 0.4, -1.9, 0.6, 1.8, -0.2]})
PLANAR = arm_of(ROBOTS["planar_3r"], {"q": [0.3, 0.7, -1.1]})
ALONG_Y = Speed(7, WHOLE, axis=1).twist(0.4)
Y: tuple[int, ...] = (1,)
IN_PLANE = (0, 1, 5)


def judged(arm, value, twist, rows):
    return judged_rates(arm.J, arm.R, twist, np.round(value, 4), rows)


@pytest.mark.parametrize("rows", [WHOLE, LINEAR, Y])
def test_rates_reach_what_is_prescribed_and_have_no_part_that_moves_nothing_of_it(rows):
    rates = rates_for(PANDA.J, ALONG_Y, rows)
    block = PANDA.J[list(rows)]
    np.testing.assert_allclose(block @ rates, ALONG_Y[list(rows)], atol=1e-12)
    still = np.linalg.svd(block)[2][len(rows) :]
    np.testing.assert_allclose(still @ rates, 0, atol=1e-12)


def test_rates_of_as_many_joints_as_rows_are_the_only_ones():
    rates = rates_for(PLANAR.J, np.array([0.2, -0.1, 0, 0, 0, 0.5]), IN_PLANE)
    np.testing.assert_allclose(PLANAR.J @ rates, [0.2, -0.1, 0, 0, 0, 0.5], atol=1e-12)


@pytest.mark.parametrize("asked", [WHOLE, LINEAR, Y])
@pytest.mark.parametrize("answered", [WHOLE, LINEAR, Y])
def test_every_reading_is_told_from_every_other(asked, answered):
    names = {WHOLE: "the whole twist", LINEAR: "the linear velocity", Y: "the y component"}
    found = judged(PANDA, rates_for(PANDA.J, ALONG_Y, answered), ALONG_Y, asked)
    if asked == answered:
        assert (found.right, found.reading, found.share) == (None, "", None)
        return
    met, wanted = found.reading.split("; the sheet asks for ")
    assert met.startswith(f"This meets {names[answered]}")
    assert wanted.startswith(names[asked])
    assert met.endswith(", with least norm")
    assert wanted.endswith(", with least norm.")
    assert found.share == (0.5 if len(answered) > len(asked) else None)


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (WHOLE, "the whole twist along the y axis of the tool"),
        (LINEAR, "the linear velocity only, along the y axis of the tool"),
        (Y, "the y component only, along the y axis of the tool"),
    ],
)
def test_tool_axes_are_named_and_earn_nothing(rows, words):
    rates = rates_for(in_axes(PANDA.J, PANDA.R), ALONG_Y, rows)
    for asked in (WHOLE, LINEAR, Y):
        found = judged(PANDA, rates, ALONG_Y, asked)
        assert f"This meets {words}, with least norm; the sheet asks for" in found.reading
        assert found.share is None


def test_a_twist_of_several_components_has_no_axis_and_no_zeros_to_name():
    xi = np.array([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])
    linear = judged(PANDA, rates_for(PANDA.J, xi, LINEAR), xi, WHOLE)
    assert linear.reading == (
        "This meets the linear velocity only, with least norm; the sheet asks for the whole twist, with least norm."
    )
    tool = judged(PANDA, rates_for(in_axes(PANDA.J, PANDA.R), xi), xi, WHOLE)
    assert "the whole twist in the axes of the tool" in tool.reading


def test_rates_that_are_unique_are_right_by_the_velocity_they_give():
    xi = np.array([0.2, -0.1, 0, 0, 0, 0.5])
    rates = rates_for(PLANAR.J, xi, IN_PLANE)
    assert np.all(judged(PLANAR, rates, xi, IN_PLANE).right)
    assert judged(PLANAR, rates + 0.01, xi, IN_PLANE).right is None
    # the three linear rows of a planar arm have rank 2
    linear = judged(PLANAR, np.linalg.pinv(PLANAR.J[:3]) @ xi[:3], xi, IN_PLANE)
    assert linear.reading == (
        "This meets the linear velocity only, with least norm; the sheet asks for the components vx, vy, omega_z in "
        "base axes."
    )


@pytest.mark.parametrize("rows", [WHOLE, LINEAR, Y])
@pytest.mark.parametrize("n", [3, 6, 7])
def test_least_norm_is_asked_and_explained_where_there_are_more_joints_than_rows(n, rows):
    if len(rows) > n:
        return
    wish = Speed(n, rows, "u", axis=1)
    assert ("least norm" in wish.text) == ("least norm" in wish.solution) == (n > len(rows))
    assert ("square" in wish.solution) == (n == len(rows))
    assert "base $y$" in wish.text or "$v_y = u$" in wish.text
    assert (r"\mathbf J_y" in wish.solution) == (rows == Y)
    assert rf"\dot q_{n}^2" in wish.text or n == len(rows)
    if rows != Y:
        assert f"({', '.join(['0', 'u', '0', '0', '0', '0'][: len(rows)])})" in wish.solution
