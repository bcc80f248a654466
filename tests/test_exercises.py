"""Every exercise file: drawn well, solved, marked, told apart from nonsense. A new file is tested with no edit here."""

import json

import numpy as np
import pytest
from answers import EXERCISES, raws, right_raws, variant_of
from kinegrade.course.proof.nonsense import NONSENSE
from kinegrade.course.proof.validate import validate_file
from kinegrade.exercises.draws import angles, until
from kinegrade.exercises.exercise import ExerciseError, Numbers, references
from kinegrade.exercises.files.finding import exercise_files
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.markers import read
from kinegrade.grader.marking.answer_key import AnswerKey
from kinegrade.grader.marking.mark import mark

SEEDS = range(6)


def earned(exercise, v, answers):
    verdicts = mark(exercise, v, raws(answers))
    assert all(verdict.points is not None for verdict in verdicts), verdicts
    return sum(verdict.points for verdict in verdicts)


def test_an_exercise_is_valid(exercise):
    """Solved for full marks, nonsense for none, known mistakes named, printed and rendered: `kinegrade validate`."""
    validation = validate_file(exercise_files()[exercise.slug], len(SEEDS))
    assert validation.failures == ()
    assert validation.draws == len(SEEDS)


@pytest.mark.parametrize("kind", NONSENSE)
def test_nonsense_in_one_part_of_a_right_sheet_earns_nothing_there(exercise, kind):
    v = variant_of(exercise.slug, 3)
    key = AnswerKey(exercise, v)
    right = right_raws(exercise, v)
    for part in exercise.asked:
        spoiled = right | {
            part.variable: NONSENSE[kind](part.answer, key.reference[part.variable], v)
        }
        verdicts = {verdict.part: verdict.points for verdict in mark(exercise, v, spoiled, key=key)}
        assert not verdicts[part.variable]


def test_the_answers_of_another_variant_earn_next_to_nothing(exercise):
    v, other = variant_of(exercise.slug, 1), variant_of(exercise.slug, 2)
    numbers = [
        part for part in exercise.asked if isinstance(part.answer, Numbers) and part.answer.shape
    ]
    theirs = references(exercise, other)
    recorded = {part.variable: theirs[part.variable].tolist() for part in numbers}
    raw = {name: Raw("num", np.array(value)) for name, value in recorded.items()}
    verdicts = [
        verdict
        for verdict in mark(exercise, v, raw, {"other": recorded})
        if verdict.part in recorded
    ]
    wrong = [verdict for verdict in verdicts if verdict.status != "correct"]
    assert sum(verdict.points for verdict in verdicts) <= 0.2 * exercise.points
    assert not wrong or any(
        "other" in f.text and f.private for verdict in wrong for f in verdict.findings
    )


def test_150_students_get_150_different_variants(exercise):
    rng = np.random.default_rng(7)
    drawn = [json.dumps(exercise.draw(rng), sort_keys=True) for _ in range(150)]
    assert len(set(drawn)) >= 149  # what is left, a bumped attempt settles


def test_the_same_generator_draws_the_same_numbers(exercise):
    assert exercise.draw(np.random.default_rng(3)) == exercise.draw(np.random.default_rng(3))


def test_numbers_survive_json_and_are_printed_with_a_unit(exercise):
    v = exercise.draw(np.random.default_rng(4))
    assert json.loads(json.dumps(v)) == v
    for name, units in exercise.units.items():
        if name in v and isinstance(v[name], list):
            assert len(units) == len(v[name])


def test_every_part_is_explained_general_formula_before_numbers(exercise):
    v = variant_of(exercise.slug)
    answers = references(exercise, v)
    for part in exercise.asked:
        steps = list(part.explain(v, answers))
        assert steps, part.variable
        assert steps[0].text
        assert all(step.formula is None or step.numbers is None for step in steps)
        if isinstance(part.answer, Numbers) and part.answer.shape:
            assert any(step.numbers is not None for step in steps)


def test_every_exercise_says_what_it_teaches_and_hints(exercise):
    assert exercise.objectives
    assert exercise.source
    assert 5 <= exercise.minutes <= 120
    assert all(part.hints for part in exercise.asked)
    assert exercise.statement(variant_of(exercise.slug))


def test_no_hint_or_prompt_holds_an_answer(exercise):
    v = variant_of(exercise.slug)
    answers = references(exercise, v)
    said = exercise.statement(v) + "".join(
        part.prompt + "".join(part.hints) for part in exercise.asked
    )
    for part in exercise.asked:
        if isinstance(part.answer, Numbers) and part.answer.shape:
            values = np.abs(answers[part.variable]).ravel()
            generic = [x for x in values if 0.01 < x < 100 and abs(x - round(x, 2)) > 1e-6]
            assert not [x for x in generic if f"{x:.3f}" in said]


def test_drawings_have_captions_and_alternative_text(exercise):
    for drawing in exercise.drawings(variant_of(exercise.slug)):
        assert drawing.caption
        assert len(drawing.alt) > 20


@pytest.mark.parametrize("seed", SEEDS)
def test_the_three_axis_arm_stays_away_from_its_singular_postures(seed):
    exercise = EXERCISES["three_axis"]
    v = variant_of("three_axis", seed)
    assert np.linalg.svd(references(exercise, v)["three_axis_A"], compute_uv=False)[-1] > 0.02


def test_the_three_axis_example_of_s0_comes_out_as_printed():
    v = {"L": 3, "a2": 2, "a3": 2, "q": [0, -np.pi / 6, np.pi / 6]}
    got = references(EXERCISES["three_axis"], v)
    r = np.sqrt(3)
    J = [[0, -r, 0], [3, 0, 0], [0, 3, 2], [0, 0, 0], [0, -1, -1], [1, 0, 0]]
    np.testing.assert_allclose(
        got["three_axis_p"],
        np.array([[0, 0, 3], [0, 0, 3], [1, 0, 3 + r], [3, 0, 3 + r]]).T,
        atol=1e-12,
    )
    np.testing.assert_allclose(
        got["three_axis_z"], np.array([[0, 0, 1], [0, -1, 0], [0, -1, 0]]).T, atol=1e-12
    )
    np.testing.assert_allclose(got["three_axis_A"], J[:3], atol=1e-12)
    np.testing.assert_allclose(got["three_axis_B"], J[3:], atol=1e-12)
    np.testing.assert_allclose(got["three_axis_J"], J, atol=1e-12)


S3 = {
    "q": [0.1, 0.5, 0.1, 0.8, 0.1, 0.2],
    "qdot_b": [1, 1.4, 1.7, 0.2, 0.3, 0.1],
    "vx_c": 2.0,
    "wording": "orientation held (omega = 0)",
    "family": "near wrist-singular",
}


def test_the_puma_problem_of_s3_comes_out_as_known():
    got = references(EXERCISES["puma_velocities"], S3)
    twist = [-1.2888508, 0.0233280, -0.1733645, 0.3338177, -3.2993304, 1.3647759]
    rates = [-1.3146195, -2.6644359, -1.7822710, -25.5529862, 3.6305368, 26.7717356]
    np.testing.assert_allclose(got["puma_velocities_twist"], twist, atol=1e-7)
    np.testing.assert_allclose(got["puma_velocities_qdot"], rates, atol=1e-6)


@pytest.mark.parametrize(
    ("rates", "words"),
    [
        (
            [-1.3146195, -2.6644359, -1.7822710, 0, 0, 0],
            "the linear velocity only, with least norm",
        ),
        (
            [11.034, 2.587, -1.651, 0, 0, 0],
            "the linear velocity only, along the x axis of the tool",
        ),
    ],
)
def test_another_reading_of_s3_question_c_is_named(rates, words):
    exercise = EXERCISES["puma_velocities"]
    answers = references(exercise, S3) | {"puma_velocities_qdot": np.array(rates)}
    verdict = mark(exercise, S3, raws(answers))[-1]
    assert words in verdict.reading
    assert verdict.status in ("incorrect", "partly")


def test_a_right_sheet_of_the_rrt_arm_may_give_its_table_in_numbers():
    exercise = EXERCISES["rrt"]
    for seed in SEEDS:
        v = variant_of("rrt", seed)
        answers = references(exercise, v)
        values = {
            **{k: x for k, x in v.items() if k != "q"},
            "q1": v["q"][0],
            "q2": v["q"][1],
            "q3": v["q"][2],
        }
        table = np.array(
            [[cell.at(values) for cell in row] for row in answers["rrt_dh"].rows], dtype=float
        )
        assert earned(exercise, v, answers | {"rrt_dh": table}) == exercise.points


def test_a_wrong_table_of_the_rrt_arm_is_followed_through():
    exercise = EXERCISES["rrt"]
    v = variant_of("rrt", 0)
    part = exercise.parts[0]
    cells = [[str(cell) for cell in row] for row in references(exercise, v)["rrt_dh"].rows]
    cells[0][3], cells[1][3] = cells[1][3], cells[0][3]
    table = read(part.answer, raw_table(cells), v)
    given = {"rrt_dh": table}
    for later in exercise.parts[1:3]:
        given[later.variable] = later.solve(v, given)
    dh, T, J = mark(exercise, v, raws(given))[:3]
    assert dh.status == "partly"
    assert (T.status, T.points, J.status, J.points) == ("follows", 3, "follows", 4)
    assert any("follows from your own rrt_dh" in finding.text for finding in T.findings)


def test_a_table_that_makes_the_rest_trivial_is_not_followed_through():
    exercise = EXERCISES["rrt"]
    v = variant_of("rrt", 0)
    given = {
        "rrt_dh": read(
            exercise.parts[0].answer,
            raw_table([["q1", 0, 0, 0], ["q2", 0, 0, 0], [0, "q3", 0, 0]]),
            v,
        )
    }
    for later in exercise.parts[1:3]:
        given[later.variable] = later.solve(v, given)
    _, T, J = mark(exercise, v, raws(given))[:3]
    assert (T.status, J.status) == ("incorrect", "incorrect")
    assert T.points == J.points == 0


def raw_table(cells):
    return Raw("text", [[str(cell) for cell in row] for row in cells])


def test_angles_keep_clear_of_right_angles_alone_and_in_sums():
    rng = np.random.default_rng(0)
    for _ in range(50):
        degrees = np.degrees(angles(rng, 3, [(1, 2)]))
        for angle in (*degrees, degrees[1] + degrees[2]):
            assert 9.9 <= angle % 90 <= 80.1


def test_a_draw_that_is_never_accepted_says_so():
    with pytest.raises(ExerciseError, match="leave too little room"):
        until(lambda: 1, lambda _: False)
