"""Columns by cross products: against the engine and against a moved arm, and what is named."""

import numpy as np
import pytest
from answers import EXERCISES, raws, right_raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.mark import mark
from kinegrade.solutions.jacobian import jacobian

EXERCISE = EXERCISES["cross_products"]
SEEDS = range(12)


def turned(axis, angle, vector):
    """Rodrigues' formula, written out."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return vector + s * K @ vector + (1 - c) * K @ K @ vector


def moved(v, joint, amount):
    """The tool point when one joint moves."""
    w, p = np.array(v[f"w{joint}"], dtype=float), np.array(v["p"])
    z, start = w / np.sqrt(w @ w), np.array(v[f"p{joint}"])
    return start + turned(z, amount, p - start) if v["kinds"][joint - 1] == "R" else p + amount * z


def verdict_of(v, name, value):
    verdicts = mark(EXERCISE, v, right_raws(EXERCISE, v) | raws({name: value}))
    return next(verdict for verdict in verdicts if verdict.part == name)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_linear_rows_agree_with_an_arm_that_is_moved_a_little(seed):
    v = variant_of("cross_products", seed)
    J, h = references(EXERCISE, v)["cross_products_J"], 1e-6
    for joint in (1, 2, 3):
        np.testing.assert_allclose(J[:3, joint - 1], (moved(v, joint, h) - moved(v, joint, -h)) / (2 * h), atol=1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_jacobian_is_that_of_the_drawn_arm(seed):
    v = variant_of("cross_products", seed)
    (drawing,) = EXERCISE.drawings(v)
    np.testing.assert_allclose(
        jacobian(drawing.chain, drawing.q), references(EXERCISE, v)["cross_products_J"], atol=1e-12
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_the_velocity_is_that_of_a_point_that_turns(seed):
    v = variant_of("cross_products", seed)
    omega, r, h = np.array(v["omega"]), np.array(v["r"]), 1e-6
    rate = np.linalg.norm(omega)
    ahead, behind = (turned(omega / rate, rate * t, r) for t in (h, -h))
    got = references(EXERCISE, v)["cross_products_velocity"]
    np.testing.assert_allclose(got, (ahead - behind) / (2 * h), atol=1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_axes_have_whole_lengths_and_are_no_coordinate_axes(seed):
    v = variant_of("cross_products", seed)
    for name in ("w1", "w2", "w3"):
        assert float(np.linalg.norm(v[name])).is_integer()
        assert all(v[name])


@pytest.mark.parametrize("name", ["cross_products_velocity", "cross_products_linear"])
def test_a_product_in_reversed_order_is_named_and_earns_nothing(name):
    v = variant_of("cross_products", 0)
    verdict = verdict_of(v, name, -references(EXERCISE, v)[name])
    assert verdict.points == 0
    assert "order of the cross product is reversed" in verdict.findings[0].text


def test_a_prismatic_column_that_turns_earns_nothing():
    v = variant_of("cross_products", 0)
    z = references(EXERCISE, v)["cross_products_slide"][:3]
    verdict = verdict_of(v, "cross_products_slide", np.append(z, z))
    assert verdict.points == 0
    assert "angular part" in verdict.findings[0].text


def test_a_jacobian_of_wrong_levers_is_followed_through():
    v = variant_of("cross_products", 0)
    linear, J = EXERCISE.asked[1], EXERCISE.asked[3]
    wrong = {"cross_products_linear": linear.mistakes[1].solve(v, {})}
    given = {**wrong, "cross_products_slide": references(EXERCISE, v)["cross_products_slide"]}
    raw = right_raws(EXERCISE, v) | raws(wrong | {"cross_products_J": J.solve(v, given)})
    verdicts = {verdict.part: verdict for verdict in mark(EXERCISE, v, raw)}
    assert verdicts["cross_products_linear"].status != "correct"
    assert verdicts["cross_products_J"].points == J.points
