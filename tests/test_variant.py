"""Personal numbers: seeded by HMAC, never shared by two students, with a fingerprint of the answers."""

import hashlib
import hmac
import json
import re
from dataclasses import replace

import numpy as np
import pytest
from answers import EXERCISES, variant_of, wrong
from courses import SECRET, exercise_of, lever
from kinegrade.course.variants.variant import (
    Record,
    canonical,
    digest,
    draw_record,
    fingerprint,
    generator,
    moved_parts,
)
from kinegrade.exercises.exercise import (
    Configurations,
    ExerciseError,
    Manual,
    Numbers,
    Part,
    references,
)
from kinegrade.solutions.errors import KinegradeError
from kinegrade.solutions.table import read_table


def test_the_seed_is_the_hmac_of_sheet_exercise_student_and_attempt_under_the_secret():
    seed = hmac.new(b"key", b"one\0rrt\0ada\x000", hashlib.sha256).digest()
    expected = np.random.Generator(np.random.PCG64(int.from_bytes(seed, "big"))).random(4)
    np.testing.assert_array_equal(generator("key", "one", "rrt", "ada", 0).random(4), expected)


@pytest.mark.parametrize(
    "other",
    [
        ("other", "one", "rrt", "ada", 0),
        ("key", "two", "rrt", "ada", 0),
        ("key", "one", "dh", "ada", 0),
        ("key", "one", "rrt", "ben", 0),
        ("key", "one", "rrt", "ada", 1),
        ("key", "oner", "rt", "ada", 0),
    ],
)
def test_secret_sheet_exercise_student_and_attempt_each_change_the_numbers(other):
    assert generator("key", "one", "rrt", "ada", 0).random() != generator(*other).random()


def test_the_same_secret_draws_the_same_record(exercise):
    assert draw_record(SECRET, "one", "ada", exercise, ()) == draw_record(
        SECRET, "one", "ada", exercise, ()
    )


def test_no_two_of_150_students_get_the_same_numbers(exercise, monkeypatch):
    monkeypatch.setattr(
        "kinegrade.course.variants.variant.fingerprint", lambda *_: {}
    )  # numbers alone matter here
    monkeypatch.setattr("kinegrade.course.variants.variant.objections", lambda _: iter(()))
    taken = set()
    for i in range(150):
        taken.add(canonical(draw_record(SECRET, "one", f"s{i}", exercise, taken).numbers))
    assert len(taken) == 150


def narrow(tmp_path, variants):
    return replace(
        lever(tmp_path), draw=lambda rng: {"L": float(rng.integers(1, variants + 1)), "q": [0.5]}
    )


def test_no_two_of_150_students_get_the_same_numbers_where_there_are_only_155(tmp_path):
    exercise, taken, attempts = narrow(tmp_path, 155), set(), 0
    for i in range(150):
        record = draw_record(SECRET, "one", f"s{i}", exercise, taken)
        assert canonical(record.numbers) not in taken
        taken.add(canonical(record.numbers))
        attempts += record.attempt
    assert attempts > 150  # numbers were refused, often


def test_a_record_says_which_attempt_drew_it(tmp_path):
    exercise = lever(tmp_path)
    first = draw_record(SECRET, "one", "ada", exercise, ())
    second = draw_record(SECRET, "one", "ada", exercise, {canonical(first.numbers)})
    assert (first.attempt, second.attempt) == (0, 1)
    drawn = exercise.draw(generator(SECRET, "one", "lever", "ada", second.attempt))
    assert second.numbers == drawn != first.numbers


def test_a_class_larger_than_the_variants_is_told_so(tmp_path):
    exercise = narrow(tmp_path, 2)
    with pytest.raises(
        ExerciseError, match="exercise lever: 1000 draws gave no new numbers; draw from a wider set"
    ):
        draw_record(
            SECRET,
            "one",
            "ada",
            exercise,
            {canonical({"L": length, "q": [0.5]}) for length in (1.0, 2.0)},
        )


def test_equal_numbers_have_one_text_and_others_another():
    assert (
        canonical({"b": [1.5, 2], "a": 0.1})
        == canonical({"a": 0.1, "b": [1.5, 2]})
        == '{"a":0.1,"b":[1.5,2]}'
    )
    assert canonical({"a": 0.1}) != canonical({"a": 0.10000000000000002})


def test_a_fingerprint_is_plain_numbers_of_every_part(exercise):
    """But of those that are marked by hand, from which nothing is computed."""
    v = variant_of(exercise.slug)
    taken = fingerprint(exercise, v)
    computed = {
        part.variable: part for part in exercise.parts if not isinstance(part.answer, Manual)
    }
    assert list(taken) == list(computed)
    assert json.loads(json.dumps(taken)) == taken
    assert not re.search(r"-0\.0[,\]]", json.dumps(taken))  # minus zero
    answers = references(exercise, v)
    for name, part in computed.items():
        picture = part.answer.pictured(answers[name], v)
        assert np.size(picture)
        np.testing.assert_allclose(taken[name], picture, rtol=0, atol=6e-10)
        if isinstance(part.answer, Numbers | Configurations):
            np.testing.assert_allclose(taken[name], answers[name], rtol=0, atol=6e-10)


def test_a_wrong_answer_in_place_of_the_reference_has_another_fingerprint(exercise):
    v = variant_of(exercise.slug)
    recorded = Record("ada", "one", exercise.slug, 0, v, fingerprint(exercise, v))
    answers = references(exercise, v)
    for part in exercise.parts:
        other = edited(
            exercise, part.variable, lambda *_, part=part: wrong(part, answers[part.variable], v)
        )
        try:
            moved = moved_parts(recorded, other)
        except (KinegradeError, ArithmeticError, np.linalg.LinAlgError):
            continue  # a later part makes nothing of it
        assert (part.variable in moved) is not isinstance(part.answer, Manual)


def test_nothing_moves_while_nothing_changes(exercise):
    record = draw_record(SECRET, "one", "ada", exercise, ())
    assert moved_parts(record, exercise) == []
    stored = replace(
        record, **{k: json.loads(json.dumps(getattr(record, k))) for k in ("numbers", "answers")}
    )
    assert moved_parts(stored, exercise) == []


def edited(exercise, variable, solve):
    parts = [
        replace(part, solve=solve) if part.variable == variable else part for part in exercise.parts
    ]
    return replace(exercise, parts=tuple(parts))


def test_the_parts_that_an_edit_moves_are_named(tmp_path):
    exercise = lever(tmp_path)
    record = draw_record(SECRET, "one", "ada", exercise, ())
    mirrored = edited(exercise, "lever_J", lambda _, given: given["lever_p"][::-1])
    assert moved_parts(record, mirrored) == ["lever_J"]
    longer = edited(exercise, "lever_p", lambda v, _: np.array([v["L"], 0.0]))
    assert moved_parts(record, longer) == ["lever_p", "lever_J"]


@pytest.mark.parametrize(("change", "moved"), [(2e-9, []), (2e-8, ["lever_p", "lever_J"])])
def test_a_change_below_1e_minus_8_moves_nothing(tmp_path, change, moved):
    exercise = lever(tmp_path)
    record = draw_record(SECRET, "one", "ada", exercise, ())
    solve = exercise.parts[0].solve
    assert (
        moved_parts(record, edited(exercise, "lever_p", lambda v, given: solve(v, given) + change))
        == moved
    )


def test_a_part_that_came_went_or_changed_its_shape_has_moved(tmp_path):
    exercise = lever(tmp_path)
    record = draw_record(SECRET, "one", "ada", exercise, ())
    new = Part("lever_w", "New", 1, Numbers((1,)), lambda *_: np.ones(1))
    assert moved_parts(record, replace(exercise, parts=(*exercise.parts, new))) == ["lever_w"]
    assert moved_parts(record, replace(exercise, parts=exercise.parts[:1])) == ["lever_J"]
    taller = replace(exercise.parts[1], answer=Numbers((2, 1)), solve=lambda *_: np.ones((2, 1)))
    assert moved_parts(record, replace(exercise, parts=(exercise.parts[0], taller))) == ["lever_J"]


def test_a_reference_table_that_changes_has_moved():
    exercise = EXERCISES["rrt"]
    record = draw_record(SECRET, "one", "ada", exercise, ())
    dh = exercise.parts[0].solve

    def flipped(v, given):
        rows = dh(v, given).rows
        cells = [[str(cell) for cell in row] for row in rows]
        cells[0][3] = f"-({cells[0][3]})"
        return read_table(
            cells, sorted({name for row in rows for cell in row for name in cell.names})
        )

    assert "rrt_dh" in moved_parts(record, edited(exercise, "rrt_dh", flipped))


def test_a_digest_is_short_and_tells_bytes_apart():
    assert digest(b"a") == hashlib.sha256(b"a").hexdigest()[:32] != digest(b"b")


def test_a_record_is_data():
    assert Record("ada", "one", "rrt", 0, {}, {}) == Record("ada", "one", "rrt", 0, {}, {})


def test_a_pinned_choice_of_form_is_the_same_for_the_whole_class(tmp_path):
    exercise = EXERCISES["puma_velocities"]
    pins = {"wording": "orientation free, least norm", "family": "elbow up"}
    records = [draw_record(SECRET, "one", f"s{i}", exercise, (), pins) for i in range(4)]
    assert all(record.numbers[name] == value for record in records for name, value in pins.items())
    assert len({canonical(record.numbers) for record in records}) == 4


def test_what_is_pinned_and_never_drawn_is_told_with_what_was():
    exercise = exercise_of(
        Part("t_x", "x?", 1, Numbers(()), lambda v, _: v["x"]),
        draw=lambda rng: {"x": float(rng.uniform(1, 2)), "form": int(rng.integers(2))},
    )
    with pytest.raises(ExerciseError, match="draws of t never gave what is pinned: form was 0, 1"):
        draw_record(SECRET, "one", "ada", exercise, (), {"form": 5})
