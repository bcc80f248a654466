"""Known mistakes of any arm in marking: which parts they are known for, what they cost, in which order."""

import json
from typing import Any

import numpy as np
import pytest
from answers import EXERCISES, part_of, raws, variant_of
from kinegrade.exercises.calculations import columns
from kinegrade.exercises.exercise import references
from kinegrade.grader.diagnosis.pipeline import Solved
from kinegrade.grader.marking import arm_mistakes
from kinegrade.grader.marking.answer_key import AnswerKey
from kinegrade.grader.marking.mark import mark

VIEWS = [
    "articulated_derivatives_J",
    "articulated_derivatives_x",
    "find_the_mistake_J",
    "frames_T",
    "frames_J",
    "frames_tool",
    "frames_origin",
    "inverse_velocities_J",
    "last_frame_columns_J",
    "last_frame_columns_base",
    "planar_2r_J",
    "planar_2r_J_symbolic",
    "prismatic_columns_last",
    "prismatic_columns_J",
    "puma_velocities_J",
    "puma_velocities_twist",
    "rrt_T",
    "rrt_J",
    "rrt_J_symbolic",
    "rrt_det",
    "small_rotations_B",
    "small_rotations_Bdq",
    "statics_J",
    "statics_tau",
    "statics_tau_tool",
    "three_axis_p",
    "three_axis_z",
    "three_axis_A",
    "three_axis_J",
    "three_axis_dq",
]
OTHERS = ["frames_X", "desired_pose_du", "pseudoinverse_pinv", "three_axis_error", "rrt_dh"]


def key_of(variable, seed=0):
    exercise = exercise_of(variable)
    return AnswerKey(exercise, variant_of(exercise.slug, seed))


def exercise_of(variable):
    return next(x for slug, x in EXERCISES.items() if variable.startswith(f"{slug}_"))


def of_arm(key, variable) -> Any:
    part = part_of(key.exercise, variable)
    return key.of_arm(part, key.wanted(part))


def verdict_of(key, answers, variable):
    verdicts = mark(key.exercise, key.v, raws(answers), key=key)
    return next(verdict for verdict in verdicts if verdict.part == variable)


def told(verdict):
    return " ".join(finding.text for finding in verdict.findings)


def answer_of(key, variable, title):
    """What a known mistake makes of a part."""
    known = of_arm(key, variable)
    rules, answers = known.singles
    titles = [mistake.title for (mistake,) in rules]
    return answers[0][titles.index(title)]


@pytest.mark.parametrize("variable", VIEWS)
@pytest.mark.parametrize("seed", range(2))
def test_a_part_that_asks_for_what_the_arm_does_is_known_by_its_reference(variable, seed):
    known = of_arm(key_of(variable, seed), variable)
    assert known is not None
    assert len(known.singles[0]) > 40


@pytest.mark.parametrize("variable", OTHERS)
def test_a_part_that_asks_for_something_else_is_left_alone(variable):
    assert of_arm(key_of(variable), variable) is None


@pytest.mark.parametrize("variable", VIEWS)
def test_what_it_is_known_by_is_right_where_there_is_no_mistake(variable):
    known = of_arm(key_of(variable), variable)
    for truth, reference in zip(
        known.bank.truth(known.view.setting), known.references, strict=True
    ):
        np.testing.assert_allclose(known.view.of(truth)[0], reference, rtol=0, atol=1e-9)


CASES = [
    ("puma_velocities_J", "sign of alpha: 3", "Row 3: alpha seems to have the other sign", 0.75),
    ("puma_velocities_J", "order of the product", "multiplied in reverse order", 0.5),
    (
        "puma_velocities_twist",
        "lever from the base",
        "The lever arms seem to begin at the base",
        0.5,
    ),
    ("rrt_T", "length forgotten: d1", "It fits d1 = 0: that number seems to be forgotten.", 0.5),
    ("three_axis_J", "tool axes", "axes of the tool frame", 0.5),
]


@pytest.mark.parametrize(("variable", "title", "words", "share"), CASES)
def test_a_known_mistake_has_its_name_and_its_price(variable, title, words, share):
    key = key_of(variable)
    verdict = verdict_of(key, {variable: answer_of(key, variable, title)}, variable)
    assert words in told(verdict)
    assert verdict.points >= share * part_of(key.exercise, variable).points
    assert verdict.status == "partly"


def test_what_looks_like_a_slip_costs_no_more_than_one():
    key = key_of("puma_velocities_J")
    part = part_of(key.exercise, "puma_velocities_J")
    answer = answer_of(key, part.variable, "revolute taken as prismatic: 6")
    reversed_column = key.reference[part.variable].copy()
    reversed_column[:, 2] *= -1
    assert verdict_of(key, {part.variable: answer}, part.variable).points >= 0.5 * part.points
    assert (
        verdict_of(key, {part.variable: reversed_column}, part.variable).points
        >= 0.75 * part.points
    )


def test_a_formula_with_a_known_mistake_has_its_name():
    key = key_of("rrt_J_symbolic", 3)
    part = part_of(key.exercise, "rrt_J_symbolic")
    right = key.reference[part.variable].text()
    negated = [[f"-({cell})" for cell in row[:2]] + [row[2]] for row in right[:3]] + right[3:]
    verdict = verdict_of(key, {part.variable: negated}, part.variable)
    assert "The order of the cross product is reversed" in told(verdict)


def test_an_own_mistake_of_the_exercise_goes_first():
    key = key_of("find_the_mistake_J")
    part = part_of(key.exercise, "find_the_mistake_J")
    (named, mistaken), *_ = key.mistaken(part, key.wanted(part))
    assert named.sentence in told(verdict_of(key, {part.variable: mistaken.value}, part.variable))


def test_transform_and_jacobian_together_tell_what_one_alone_cannot():
    key = key_of("three_axis_p")
    narrowed = 0
    for title in [mistake.title for (mistake,) in of_arm(key, "three_axis_z").singles[0]]:
        answers = {name: answer_of(key, name, title) for name in ("three_axis_p", "three_axis_z")}
        alone = told(verdict_of(key, {"three_axis_z": answers["three_axis_z"]}, "three_axis_z"))
        together = told(verdict_of(key, answers, "three_axis_z"))
        narrowed += alone.startswith("Either") and "Either" not in together and bool(together)
    assert narrowed


def test_two_mistakes_are_hinted_at_and_leave_no_points_of_their_own():
    key = key_of("puma_velocities_J")
    known = of_arm(key, "puma_velocities_J")
    rules, (answers,) = known.pairs
    titles = [{one.title, other.title} for one, other in rules]
    answer = answers[titles.index({"sign of alpha: 1", "lever from the base"})]
    verdict = verdict_of(key, {"puma_velocities_J": answer}, "puma_velocities_J")
    assert "It is consistent with two mistakes" in told(verdict)
    assert verdict.points <= 0.2 * 4


def test_nothing_is_computed_before_a_wrong_answer_is_met(monkeypatch):
    monkeypatch.setattr(Solved, "J", None)
    key = key_of("puma_velocities_J")
    right = references(key.exercise, key.v)
    answers = {name: right[name] for name in ("puma_velocities_J", "puma_velocities_twist")}
    assert verdict_of(key, answers, "puma_velocities_J").status == "correct"


def test_a_failure_of_ours_leaves_the_answer_without_a_name(monkeypatch, caplog):
    def fails(_):
        raise ZeroDivisionError

    monkeypatch.setattr(arm_mistakes, "steps_of", fails)
    key = key_of("puma_velocities_J")
    verdict = verdict_of(key, {"puma_velocities_J": np.full((6, 6), 0.3)}, "puma_velocities_J")
    assert verdict.status == "incorrect"
    assert "known mistakes of any arm fail for puma_velocities_J" in caplog.text


@pytest.mark.parametrize(
    "variable", ["puma_velocities_J", "rrt_T", "three_axis_A", "three_axis_z", "frames_J"]
)
def test_a_neighbours_answer_has_no_name(variable):
    for seed in range(12):
        key, other = key_of(variable, seed), key_of(variable, seed + 50)
        part = part_of(key.exercise, variable)
        assert key.of_arm(part, key.wanted(part)) is not None
        verdict = verdict_of(key, {variable: other.reference[variable]}, variable)
        assert not told(verdict), json.dumps(key.v)


@pytest.mark.parametrize(
    ("variable", "way", "sentence"),
    [
        ("puma_velocities_J", columns.tool_axes, columns.TOOL_AXES),
        ("puma_velocities_J", columns.late, columns.LATE),
        ("inverse_velocities_J", columns.tool_axes, columns.TOOL_AXES),
    ],
)
@pytest.mark.parametrize("seed", range(20))
def test_what_an_exercise_need_not_know_is_named_on_every_draw(variable, way, sentence, seed):
    key = key_of(variable, seed)
    arm = key.exercise.arm(key.v)
    verdict = verdict_of(key, {variable: way(arm.frames, arm.kinds)}, variable)
    assert told(verdict) == sentence
