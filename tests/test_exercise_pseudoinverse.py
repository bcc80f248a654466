"""The seven-joint arm: properties in place of values, and the wrong inverses by name."""

import re

import numpy as np
import pytest
from answers import EXERCISES, right_raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS

EXERCISE = EXERCISES["pseudoinverse"]
SEEDS = range(20)


def verdicts(v, **own):
    handed = {
        f"pseudoinverse_{name}": Raw(
            "text" if isinstance(x, str) else "num", x if isinstance(x, str) else np.array(x)
        )
        for name, x in own.items()
    }
    found = mark(EXERCISE, v, right_raws(EXERCISE, v) | handed)
    return {verdict.part.removeprefix("pseudoinverse_"): verdict for verdict in found}


def said(verdict):
    return " ".join([verdict.reading, *(finding.text for finding in verdict.findings)])


@pytest.mark.parametrize("seed", SEEDS)
def test_the_sheet_alone_is_enough(seed):
    """Only the printed J, twist and k are used, and the columns of K that the text names."""
    v = variant_of("pseudoinverse", seed)
    J, xi, k = np.array(v["J"]), np.array(v["xi"]), v["k"] - 1
    text = EXERCISE.statement(v)
    columns = [int(i) - 1 for i in re.findall(r"columns ([\d, ]+) of your", text)[0].split(", ")]
    assert f"joint $k$ is joint {v['k']}." in text
    K = J[:, columns]
    X, Y = np.linalg.pinv(J), np.linalg.pinv(K)
    holds = (np.allclose(K @ Y, np.eye(6)), np.allclose(Y @ K, np.eye(len(columns))))
    still = np.insert(np.linalg.solve(np.delete(J, k, axis=1), xi), k, 0.0)
    n = np.eye(7)[k] - X @ J[:, k]
    sides = {(True, False): "a", (False, True): "b", (True, True): "c", (False, False): "d"}[holds]
    own = {"pinv": X, "sides": sides, "least": X @ xi, "null": n / np.abs(n).max(), "still": still}
    rounded = {name: x if isinstance(x, str) else np.round(x, 4) for name, x in own.items()}
    for answers in (own, rounded):
        found = verdicts(v, **answers)
        assert [verdict.status for verdict in found.values()] == ["correct"] * 5 + ["not_graded"]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_printed_jacobian_is_that_of_the_drawn_posture_within_the_limits(seed):
    v = variant_of("pseudoinverse", seed)
    robot = ROBOTS["panda"]
    np.testing.assert_allclose(v["J"], jacobian(robot.chain(), v["q"]), atol=0.5001e-4)
    assert all(low < x < high for x, (low, high) in zip(v["q"], robot.limits, strict=True))
    assert np.linalg.svd(v["J"], compute_uv=False)[-1] >= 0.1


def test_every_letter_is_right_for_somebody():
    letters = {
        references(EXERCISE, variant_of("pseudoinverse", seed))["pseudoinverse_sides"]
        for seed in SEEDS
    }
    assert letters == {"a", "b", "c", "d"}


def test_a_right_inverse_that_is_not_the_pseudoinverse_is_named_and_earns_a_third():
    v = variant_of("pseudoinverse")
    J, k = np.array(v["J"]), v["k"] - 1
    X = np.insert(np.linalg.inv(np.delete(J, k, axis=1)), k, 0.0, axis=0)
    found = verdicts(v, pinv=X)["pinv"]
    assert (found.status, found.points) == ("partly", 1)
    assert "a right inverse" in said(found)
    assert not np.any(found.right)


def test_rates_from_another_right_inverse_give_the_twist_but_are_not_the_shortest():
    v = variant_of("pseudoinverse")
    answers = references(EXERCISE, v)
    found = verdicts(v, least=answers["pseudoinverse_still"])["least"]
    assert (found.status, found.points) == ("partly", 1)
    assert "there are shorter ones" in found.reading


def test_the_inverse_of_a_singular_product_is_recognised_by_its_size():
    v = variant_of("pseudoinverse")
    J = np.array(v["J"])
    left = np.linalg.solve(J.T @ J + 1e-13 * np.eye(7), J.T) + 1e12
    found = verdicts(v, pinv=left)["pinv"]
    assert found.points == 0
    assert "singular matrix" in said(found)


@pytest.mark.parametrize("factor", [1, -1, 0.2, 40.0, -1e3])
def test_any_multiple_of_a_motion_that_moves_nothing_is_right(factor):
    v = variant_of("pseudoinverse")
    n = references(EXERCISE, v)["pseudoinverse_null"]
    found = verdicts(v, null=np.round(factor * n, 4))
    assert found["null"].status == "correct"
    assert found["still"].status == "correct"


def test_a_motion_that_moves_the_hand_is_wrong_and_what_j_keeps_is_named():
    v = variant_of("pseudoinverse")
    answers = references(EXERCISE, v)
    J, n = np.array(v["J"]), answers["pseudoinverse_null"]
    kept = (np.linalg.pinv(J) @ J)[0]
    assert "keeps the part of the rates that moves the hand" in said(verdicts(v, null=kept)["null"])
    for wrong in (kept, np.zeros(7), n + 0.02 * kept):
        assert verdicts(v, null=wrong)["null"].points == 0


def test_the_shortest_rates_do_not_pass_for_those_with_joint_k_still():
    for seed in SEEDS:
        v = variant_of("pseudoinverse", seed)
        assert (
            verdicts(v, still=references(EXERCISE, v)["pseudoinverse_least"])["still"].points == 0
        )


def test_later_parts_follow_from_an_own_wrong_matrix():
    v = variant_of("pseudoinverse")
    J, xi = np.array(v["J"]), np.array(v["xi"])
    found = verdicts(v, pinv=J.T, least=J.T @ xi)
    assert [found[name].points for name in ("pinv", "least")] == [0, 1]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_identity_that_j_has_is_told_once(seed):
    v = variant_of("pseudoinverse", seed)
    _, sides, *_ = EXERCISE.parts
    told = " ".join(step.text for step in sides.explain(v, references(EXERCISE, v)))
    assert told.count("projection of rank 6") == 1
    assert told.count(" is a)") == 1
    assert (r"$\mathbf J$ itself" in told) == (len(v["columns"]) == 7)


def test_the_posture_is_not_printed():
    assert set(EXERCISE.units) == {"J", "xi", "k"}
    assert (EXERCISE.structure, EXERCISE.hidden) == (("columns",), ("q",))
