"""Columns by cross products: against the engine and against a moved arm, and what is named."""

import numpy as np
import pytest
from answers import EXERCISES, raws, right_raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.mark import mark
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
        np.testing.assert_allclose(
            J[:3, joint - 1], (moved(v, joint, h) - moved(v, joint, -h)) / (2 * h), atol=1e-8
        )


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
def test_a_product_in_reversed_order_is_named_and_costs_half(name):
    v = variant_of("cross_products", 0)
    verdict = verdict_of(v, name, -references(EXERCISE, v)[name])
    assert verdict.points == verdict.out_of / 2
    assert "order of the cross product is reversed" in verdict.findings[0].text


def test_a_prismatic_column_that_turns_costs_half():
    v = variant_of("cross_products", 0)
    z = references(EXERCISE, v)["cross_products_slide"][:3]
    verdict = verdict_of(v, "cross_products_slide", np.append(z, z))
    assert verdict.points == verdict.out_of / 2
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


def columns_at(v, *joints):
    """Axes as printed and the linear parts z x (p - p_i) of these joints."""
    w = [np.array(v[f"w{joint}"], dtype=float) for joint in joints]
    levers = [np.array(v["p"]) - v[f"p{joint}"] for joint in joints]
    linear = [
        np.cross(axis / np.linalg.norm(axis), lever) for axis, lever in zip(w, levers, strict=True)
    ]
    return np.array(w).T, np.array(linear).T


@pytest.mark.parametrize("seed", SEEDS)
def test_wrong_columns_of_the_slide_are_named_alone_and_in_the_jacobian(seed):
    v = variant_of("cross_products", seed)
    slides = v["kinds"].index("P") + 1
    w, linear = columns_at(v, slides)
    z, others = (
        w[:, 0] / np.linalg.norm(w),
        [columns_at(v, joint)[0][:, 0] for joint in (1, 2, 3) if joint != slides],
    )
    wrong = [
        (np.append(linear, z), "column of a revolute joint"),
        (np.append(linear, np.zeros(3)), "lever arm"),
        (np.append(z, z), "angular part"),
        (np.append(w, np.zeros(3)), "used as printed"),
        *(
            (np.append(other / np.linalg.norm(other), np.zeros(3)), "another joint")
            for other in others
        ),
    ]
    for column, words in wrong:
        alone = verdict_of(v, "cross_products_slide", column)
        assert (alone.points, words in alone.findings[0].text) == (alone.out_of / 2, True)
        J = references(EXERCISE, v)["cross_products_J"]
        J[:, slides - 1] = column
        together = verdict_of(v, "cross_products_J", J)
        assert together.points < together.out_of
        assert words in together.findings[0].text


@pytest.mark.parametrize("seed", SEEDS)
def test_columns_of_the_slide_among_the_revolute_ones_are_named(seed):
    v = variant_of("cross_products", seed)
    slides = v["kinds"].index("P") + 1
    for pair in ((1, 2), (1, 3), (2, 3)):
        verdict = verdict_of(v, "cross_products_linear", columns_at(v, *pair)[1])
        assert (verdict.status == "correct") == (slides not in pair)
        if slides in pair:
            assert "the joint that slides" in verdict.findings[0].text


def test_printed_directions_and_reversed_products_are_named_in_the_jacobian():
    v = variant_of("cross_products", 0)
    J = references(EXERCISE, v)["cross_products_J"]
    turning = [i for i, kind in enumerate(v["kinds"]) if kind == "R"]
    sizes = np.linalg.norm([v[f"w{i}"] for i in (1, 2, 3)], axis=1)
    rows = np.zeros((6, 3))
    rows[3:, turning] = J[3:, turning]
    backward = J.copy()
    backward[:3, turning] *= -1
    for wrong, words in (
        (J * sizes, "as printed"),
        (J + rows * (sizes - 1), "angular rows"),
        (backward, "reversed"),
    ):
        verdict = verdict_of(v, "cross_products_J", wrong)
        assert words in verdict.findings[0].text
