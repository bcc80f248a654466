"""Small rotations against numpy written out from the sheet, and the readings that are told apart."""

import numpy as np
import pytest
from answers import EXERCISES, raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.rotation import vector_rotation

EXERCISE = EXERCISES["small_rotations"]
SEEDS = range(8)
ANGLES = {"pi/2": np.pi / 2, "-pi/2": -np.pi / 2, "0": 0.0}


def table(v):
    """Cells as they are printed."""
    lines = EXERCISE.statement(v).splitlines()
    rows = [line for line in lines if line.startswith("| $") and r"\theta" not in line]
    return [
        [cell.strip(" $").replace("\\", "").replace("_", "") for cell in row.split("|")[2:-1]]
        for row in rows
    ]


def rotations(v, q):
    """Rotations of frames 0 to 4 from theta and alpha of the printed table."""
    reached = [np.eye(3)]
    for (theta, _, __, alpha), joint in zip(table(v), q, strict=True):
        t, a = (joint if theta.startswith("q") else ANGLES[theta]), ANGLES[alpha]
        turn = [[np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1]]
        tilt = [[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]]
        reached.append(reached[-1] @ turn @ tilt)
    return reached


def verdict_of(v, name, value):
    verdicts = {
        verdict.part: verdict
        for verdict in mark(EXERCISE, v, raws(references(EXERCISE, v) | {name: value}))
    }
    return verdicts[name]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_printed_rotations_are_those_of_the_printed_table(seed):
    v = variant_of("small_rotations", seed)
    q, dq = np.array(v["q"]), np.array(v["dq"])
    np.testing.assert_allclose(v["R1"], rotations(v, q)[-1], atol=6e-7)
    np.testing.assert_allclose(v["R2"], rotations(v, q + dq)[-1], atol=6e-7)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_rotation_vector_turns_the_first_frame_into_the_second(seed):
    v = variant_of("small_rotations", seed)
    dw = references(EXERCISE, v)["small_rotations_dw"]
    np.testing.assert_allclose(vector_rotation(dw) @ v["R1"], v["R2"], atol=3e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_columns_are_axes_and_zero_for_the_slide(seed):
    v = variant_of("small_rotations", seed)
    frames = rotations(v, v["q"])
    B = np.array([frames[0][:, 2], frames[1][:, 2], np.zeros(3), frames[3][:, 2]]).T
    got = references(EXERCISE, v)
    np.testing.assert_allclose(got["small_rotations_B"], B, atol=1e-12)
    np.testing.assert_allclose(got["small_rotations_Bdq"], B @ v["dq"], atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_factor_is_what_comes_out_when_it_is_tried(seed):
    v = variant_of("small_rotations", seed)
    got, q, dq = references(EXERCISE, v), np.array(v["q"]), np.array(v["dq"])

    def missed(step):
        R = rotations(v, q + step)[-1] @ rotations(v, q)[-1].T
        half = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
        dw = half * np.arcsin(np.linalg.norm(half)) / np.linalg.norm(half)
        return np.linalg.norm(dw - got["small_rotations_B"] @ step)

    options = [float(option) for option in EXERCISE.parts[-1].answer.options]
    ratio = missed(dq) / missed(dq / v["k"])
    nearest = int(np.argmin(np.abs(np.log(np.array(options) / ratio))))
    assert got["small_rotations_factor"] == "abcdefgh"[nearest]


@pytest.mark.parametrize("seed", SEEDS)
def test_half_the_differences_of_opposite_entries_are_good_enough(seed):
    v = variant_of("small_rotations", seed)
    R = np.array(v["R2"]) @ np.array(v["R1"]).T
    half = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    assert verdict_of(v, "small_rotations_dw", np.round(half, 4)).status == "correct"


@pytest.mark.parametrize("seed", SEEDS)
def test_the_way_back_and_first_order_are_told_apart_from_the_rotation_vector(seed):
    v = variant_of("small_rotations", seed)
    got = references(EXERCISE, v)
    back = verdict_of(v, "small_rotations_dw", -got["small_rotations_dw"])
    assert (back.points, "R1 R2^T" in back.reading) == (1.5, True)
    first = verdict_of(v, "small_rotations_dw", got["small_rotations_Bdq"])
    assert (first.points, "This is B dq" in first.findings[0].text) == (1.5, True)
    exact = verdict_of(v, "small_rotations_Bdq", got["small_rotations_dw"])
    assert (exact.points, "This is dw" in exact.findings[0].text) == (exact.out_of / 2, True)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_missing_half_and_the_way_back_in_tool_axes_are_named(seed):
    v = variant_of("small_rotations", seed)
    R1, R2 = np.array(v["R1"]), np.array(v["R2"])

    def differences(R):
        return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])

    wrong = [
        (differences(R2 @ R1.T), "twice too long"),
        (2 * references(EXERCISE, v)["small_rotations_dw"], "twice too long"),
        (0.5 * differences(R2.T @ R1), "R2^T R1"),
    ]
    for value, words in wrong:
        verdict = verdict_of(v, "small_rotations_dw", np.round(value, 4))
        assert (verdict.points, words in verdict.findings[0].text) == (1.5, True)


def test_questions_end_as_questions_and_name_no_source():
    v = variant_of("small_rotations", 0)
    got = references(EXERCISE, v)
    assert EXERCISE.asked[-1].prompt.endswith("?")
    steps = (step for part in EXERCISE.asked if part.explain for step in part.explain(v, got))
    said = EXERCISE.statement(v) + "".join(step.text for step in steps)
    assert "S0" not in said
