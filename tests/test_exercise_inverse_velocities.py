"""The singular Puma against numpy written out from the sheet, and answers that are not unique."""

import numpy as np
import pytest
from answers import EXERCISES, raws, variant_of
from kinegrade.exercises.calculations.columns import tool_axes
from kinegrade.exercises.catalogue.inverse_velocities import draw
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.mark import mark

EXERCISE = EXERCISES["inverse_velocities"]
SEEDS = range(9)
D1, A2, D3, A3, D4 = 0.67183, 0.4318, 0.15005, 0.0203, 0.4318
LOST, ELBOW = "inverse_velocities_lost", "inverse_velocities_elbow"


def jacobian(q):
    """Six columns from the rows of the table, d and a in metres, alpha in quarter turns."""
    poses = [np.eye(4)]
    rows = [(D1, 0, 1), (0, A2, 0), (D3, A3, -1), (D4, 0, 1), (0, 0, -1), (0, 0, 0)]
    for angle, (d, a, quarters) in zip(q, rows, strict=True):
        c, s, al = np.cos(angle), np.sin(angle), quarters * np.pi / 2
        ca, sa = np.cos(al), np.sin(al)
        link = [
            [c, -s * ca, s * sa, a * c],
            [s, c * ca, -c * sa, a * s],
            [0, sa, ca, d],
            [0, 0, 0, 1],
        ]
        poses.append(poses[-1] @ link)
    hand = poses[-1][:3, 3]
    return np.array([[*np.cross(T[:3, 2], hand - T[:3, 3]), *T[:3, 2]] for T in poses[:-1]]).T


def verdict_of(v, name, value):
    verdicts = {
        verdict.part: verdict
        for verdict in mark(EXERCISE, v, raws(references(EXERCISE, v) | {name: value}))
    }
    return verdicts[name]


def said(verdict):
    return " ".join([verdict.reading, *(finding.text for finding in verdict.findings)])


@pytest.mark.parametrize("seed", SEEDS)
def test_jacobian_and_ranks_are_those_of_the_printed_table(seed):
    v = variant_of("inverse_velocities", seed)
    got, J = references(EXERCISE, v), jacobian(v["q"])
    np.testing.assert_allclose(got["inverse_velocities_J"], J, atol=1e-12)
    blocks = (J, J[:3, :3], J[3:, 3:])
    ranks = [np.linalg.matrix_rank(np.round(block, 4), rtol=1e-3) for block in blocks]
    assert ranks == got["inverse_velocities_ranks"].tolist()
    for block, rank in zip(blocks, ranks, strict=True):
        sizes = np.linalg.svd(block, compute_uv=False)
        assert sizes[rank - 1] / sizes[0] > 0.04  # nobody can take it for zero
        assert rank == len(block) or sizes[rank] / sizes[0] < 1e-5


@pytest.mark.parametrize("seed", SEEDS)
def test_the_reason_is_the_vanishing_factor(seed):
    v = variant_of("inverse_velocities", seed)
    _, q2, q3, _, q5, _ = v["q"]
    elbow = A3 * np.sin(q3) + D4 * np.cos(q3)
    shoulder = A2 * np.cos(q2) + A3 * np.cos(q2 + q3) - D4 * np.sin(q2 + q3)
    zero = [abs(factor) < 1e-5 for factor in (np.sin(q5), elbow, shoulder)]
    assert sum(zero) == 1
    assert references(EXERCISE, v)["inverse_velocities_reason"] == "abc"[zero.index(True)]


def test_one_reason_alone_is_right():
    """Where the Puma's elbow is folded, the shoulder's factor is half a millimetre as well (seeds 6, 9, 19, 31)."""
    for seed in range(40):
        _, q2, q3, _, q5, _ = variant_of("inverse_velocities", seed)["q"]
        elbow = A3 * np.sin(q3) + D4 * np.cos(q3)
        shoulder = A2 * np.cos(q2) + A3 * np.cos(q2 + q3) - D4 * np.sin(q2 + q3)
        assert np.sort(np.abs([np.sin(q5), elbow, shoulder]))[1] >= 0.04


def test_all_reasons_are_drawn_and_both_kinds_of_twists():
    drawn = [references(EXERCISE, variant_of("inverse_velocities", seed)) for seed in range(40)]
    assert {answers["inverse_velocities_reason"] for answers in drawn} == set("abc")
    assert {answers["inverse_velocities_solutions"] for answers in drawn} == set("ac")


@pytest.mark.parametrize("seed", SEEDS)
def test_no_rates_have_a_component_along_the_lost_direction(seed):
    v = variant_of("inverse_velocities", seed)
    got, J = references(EXERCISE, v), jacobian(v["q"])
    block = J[3:, 3:] if got["inverse_velocities_reason"] == "a" else J[:3, :3]
    assert np.abs(got[LOST] @ block).max() < 1e-5


@pytest.mark.parametrize("seed", SEEDS)
def test_the_lost_direction_counts_with_either_sign_and_any_length(seed):
    v = variant_of("inverse_velocities", seed)
    u = references(EXERCISE, v)[LOST]
    assert (
        verdict_of(v, LOST, -u).status
        == verdict_of(v, LOST, 3 * np.round(u, 4)).status
        == "correct"
    )
    J = jacobian(v["q"])
    block = J[3:, 3:] if references(EXERCISE, v)["inverse_velocities_reason"] == "a" else J[:3, :3]
    rates = verdict_of(v, LOST, -np.linalg.svd(block)[2][-1])
    assert rates.points == 0
    assert "joint rates that move nothing" in said(rates)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_twist_is_out_of_reach_exactly_when_something_is_left_over(seed):
    v = variant_of("inverse_velocities", seed)
    J, xi = jacobian(v["q"]), np.array(v["xi"])
    left = np.linalg.norm(J @ np.linalg.pinv(J, rcond=1e-3) @ xi - xi)
    assert left < 5e-4 or left > 0.3
    assert references(EXERCISE, v)["inverse_velocities_solutions"] == ("a" if left > 0.3 else "c")


@pytest.mark.parametrize("seed", SEEDS)
def test_both_elbow_angles_make_the_arm_block_singular(seed):
    v = variant_of("inverse_velocities", seed)
    angles = references(EXERCISE, v)[ELBOW].ravel()
    assert ((-np.pi < angles) & (angles <= np.pi)).all()
    np.testing.assert_allclose(v["a3"] * np.sin(angles) + v["d4"] * np.cos(angles), 0, atol=1e-12)


def test_the_elbow_of_the_puma_itself_is_where_it_is_known_to_be():
    v = variant_of("inverse_velocities") | {"a3": A3, "d4": D4}
    np.testing.assert_allclose(
        np.degrees(references(EXERCISE, v)[ELBOW].ravel()), [-87.308, 92.692], atol=5e-4
    )


@pytest.mark.parametrize(
    ("answer", "points", "words"),
    [
        (lambda a, _: [-a], 1, "another branch"),
        (lambda a, _: [np.pi - a], 1, "another branch"),
        (lambda a, _: [np.pi - a, -a], 2, ""),
        (lambda a, _: [2 * np.pi - a, np.pi - a], 2, ""),
        (lambda a, _: [a, a - np.pi], 0, "a sign"),
        (lambda *_: [np.pi / 2, -np.pi / 2], 0, "without a3"),
        (lambda a, _: [a - np.pi / 2, np.pi / 2 + a], 0, "the quotient"),
        (lambda a, _: [-a, np.pi - a, 0.3], 1, ""),
        (lambda *_: [0.3, 1.2], 0, ""),
    ],
)
def test_elbow_angles_are_counted_and_slips_named(answer, points, words):
    v = variant_of("inverse_velocities")
    verdict = verdict_of(v, ELBOW, np.array(answer(np.arctan2(v["d4"], v["a3"]), v)))
    assert verdict.points == points
    assert words in said(verdict)


def test_ranks_follow_from_a_jacobian_in_the_tool_frame():
    v = draw(np.random.default_rng(0))
    exercise = EXERCISE
    arm = exercise.arm(v)
    own = {"inverse_velocities_J": tool_axes(arm.frames, arm.kinds)}
    ranks = exercise.parts[1].solve(v, own)
    found = {
        x.part: x
        for x in mark(
            exercise, v, raws(references(exercise, v) | own | {exercise.parts[1].variable: ranks})
        )
    }
    assert found["inverse_velocities_J"].points == found["inverse_velocities_J"].out_of / 2
    assert found[exercise.parts[1].variable].points == 2
