"""The planar arm: formulas against transforms and differences, what the source prints, follow-through."""

import numpy as np
import pytest
from answers import EXERCISES, raws, right_raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.mark import mark
from kinegrade.grader.wire import Raw
from kinegrade.solutions.expression_array import expression_array
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward

EXERCISE = EXERCISES["planar_2r"]
SEEDS = range(12)
PRINTED = ["l1*cos(q1) + l2*cos(q1 + q2)", "l1*sin(q1) + l2*sin(q1 + q2)", "q1 + q2"]
PRINTED_J = [
    ["-l1*sin(q1) - l2*sin(q1 + q2)", "-l2*sin(q1 + q2)"],
    ["l1*cos(q1) + l2*cos(q1 + q2)", "l2*cos(q1 + q2)"],
    ["1", "1"],
]


def own_numbers(v, q):
    return {name: v[name] for name in ("l1", "l2", "beta")} | {"q1": q[0], "q2": q[1]}


def verdicts_of(v, answers):
    right = right_raws(EXERCISE, v)
    return {verdict.part: verdict for verdict in mark(EXERCISE, v, right | raws(answers))}


@pytest.mark.parametrize("seed", SEEDS)
def test_formulas_and_transforms_tell_the_same_pose_and_jacobian(seed):
    v = variant_of("planar_2r", seed)
    got = references(EXERCISE, v)
    T, J, values = got["planar_2r_T"][-1], got["planar_2r_J"], own_numbers(v, v["q"])
    x, y, theta = got["planar_2r_pose"].at(values)
    np.testing.assert_allclose([x, y, np.cos(theta), np.sin(theta)], [*T[:2, 3], *T[:2, 0]], atol=1e-12)
    np.testing.assert_allclose(got["planar_2r_J_symbolic"].at(values), J[[0, 1, 5]], atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_jacobian_agrees_with_differences_of_the_pose(seed):
    v = variant_of("planar_2r", seed)
    got = references(EXERCISE, v)
    pose, h = got["planar_2r_pose"], 1e-6
    steps = [np.array(v["q"]) + h * np.array(step) for step in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    a, b, c, d = (pose.at(own_numbers(v, q)) for q in steps)
    np.testing.assert_allclose(got["planar_2r_J"][[0, 1, 5]], np.array([a - b, c - d]).T / (2 * h), atol=1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_drawn_arm_is_the_arm_of_the_question(seed):
    v = variant_of("planar_2r", seed)
    got = references(EXERCISE, v)
    chain = EXERCISE.drawings(v)[1].chain
    np.testing.assert_allclose(jacobian(chain, v["q"]), got["planar_2r_J"], atol=1e-12)
    np.testing.assert_allclose(forward(chain, v["q"])[:3, 3], got["planar_2r_T"][-1, :3, 3], atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_arm_is_bent(seed):
    v = variant_of("planar_2r", seed)
    T = references(EXERCISE, v)["planar_2r_T"]
    assert abs(np.sin(v["q"][1])) > 0.3
    assert abs((np.linalg.inv(T[0]) @ T[1])[1, 0]) > 0.3


@pytest.mark.parametrize("seed", SEEDS)
def test_what_the_source_prints_earns_nothing(seed):
    verdicts = verdicts_of(
        variant_of("planar_2r", seed), {"planar_2r_pose": PRINTED, "planar_2r_J_symbolic": [["0", "0"]] * 3}
    )
    assert verdicts["planar_2r_pose"].points == 0
    assert any("positive senses" in finding.text for finding in verdicts["planar_2r_pose"].findings)
    alone = verdicts_of(variant_of("planar_2r", seed), {"planar_2r_J_symbolic": PRINTED_J})
    assert alone["planar_2r_J_symbolic"].points == 0


def test_a_product_in_the_wrong_order_is_not_paid_for_its_rotation():
    v = variant_of("planar_2r", 0)
    T1, T2 = references(EXERCISE, v)["planar_2r_T"]
    verdict = verdicts_of(v, {"planar_2r_T": np.array([T1, np.linalg.inv(T1) @ T2 @ T1])})["planar_2r_T"]
    assert verdict.points == verdict.out_of / 2
    assert "wrong order" in verdict.findings[0].text


def test_derivatives_of_a_wrong_pose_are_followed_through():
    v = variant_of("planar_2r", 0)
    part = EXERCISE.asked[0]
    wrong = {"planar_2r_pose": part.mistakes[0].solve(v, {})}
    given = {"planar_2r_pose": formulas(wrong["planar_2r_pose"])}
    J = EXERCISE.asked[1].solve(v, given)
    verdicts = verdicts_of(v, wrong | {"planar_2r_J_symbolic": [[str(x) for x in row] for row in J.tolist()]})
    assert verdicts["planar_2r_pose"].status != "correct"
    assert verdicts["planar_2r_J_symbolic"].points == EXERCISE.asked[1].points


def formulas(texts):
    return expression_array(texts, ("l1", "l2", "beta", "q1", "q2"))


def test_nothing_follows_from_a_pose_that_is_made_easy():
    v = variant_of("planar_2r", 0)
    theta = str(references(EXERCISE, v)["planar_2r_pose"].entries[2])
    J = references(EXERCISE, v)["planar_2r_J_symbolic"].text()[2]
    easy = {"planar_2r_pose": ["0", "0", theta], "planar_2r_J_symbolic": [["0", "0"], ["0", "0"], J]}
    verdicts = verdicts_of(v, easy)
    assert verdicts["planar_2r_pose"].status == "partly"
    assert verdicts["planar_2r_J_symbolic"].points == 0


def test_numbers_put_into_the_formulas_earn_nothing():
    v = variant_of("planar_2r", 0)
    pose = references(EXERCISE, v)["planar_2r_pose"].at(own_numbers(v, v["q"]))
    verdicts = verdicts_of(v, {"planar_2r_pose": Raw("num", pose)})
    assert verdicts["planar_2r_pose"].points == 0


@pytest.mark.parametrize(
    ("signs", "words"),
    [
        (lambda _: [[-1, -1], [1, 1], [1, 1]], "derivative of the cosine"),
        (lambda J: [[int(entry) for entry in J[2]]] * 3, "chain rule"),
    ],
)
def test_wrong_signs_in_the_derivatives_are_named(signs, words):
    for seed in SEEDS:
        v = variant_of("planar_2r", seed)
        J = references(EXERCISE, v)["planar_2r_J_symbolic"].text()
        wrong = [[f"{s}*({entry})" for s, entry in zip(*rows, strict=True)] for rows in zip(signs(J), J, strict=True)]
        (finding,) = verdicts_of(v, {"planar_2r_J_symbolic": wrong})["planar_2r_J_symbolic"].findings
        assert words in finding.text or finding.text == "Every sign is reversed."
