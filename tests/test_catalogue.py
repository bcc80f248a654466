"""Exercise files are found and loaded from anywhere, and a broken one says what is wrong with it."""

import pytest
from kinegrade.exercises.exercise import ExerciseError
from kinegrade.exercises.files.finding import exercise_files, find, load

GOOD = """
import numpy as np
from kinegrade.exercises.exercise import Exercise, Numbers, Part

EXERCISE = Exercise(
    slug="own", title="Own", source="a lecture", draw=lambda rng: {"a": round(float(rng.uniform(1, 2)), 2)},
    statement=lambda v: "A square.", units={"a": "m"}, scale=lambda v: v["a"],
    parts=(Part("own_area", "Its area", 1, Numbers((1,), "m^2"), lambda v, given: np.array([v["a"] ** 2])),),
)
"""


def written(folder, name, text):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_our_exercises_are_found_and_the_contract_is_not_one():
    found = exercise_files()
    assert {"three_axis", "rrt", "puma_velocities"} <= set(found)
    assert not {"exercise", "catalogue", "draws", "drawing"} & set(found)


def test_a_courses_own_file_is_found_and_loaded_with_no_other_edit(tmp_path):
    written(tmp_path, "own.py", GOOD)
    assert find("own", exercise_files(tmp_path)).title == "Own"


def test_files_of_the_same_name_never_meet(tmp_path):
    one, two = tmp_path / "one", tmp_path / "two"
    one.mkdir()
    two.mkdir()
    first = load(written(one, "own.py", GOOD))
    second = load(written(two, "own.py", GOOD.replace('title="Own"', 'title="Other"')))
    assert (first.title, second.title) == ("Own", "Other")
    assert load(one / "own.py") is first


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("own.py", "EXERCISE = 3", "takes a top-level EXERCISE"),
        ("own.py", "EXERCISE = 1 / 0", "stopped with ZeroDivisionError"),
        ("own.py", "EXERCISE = (", "stopped with SyntaxError"),
        ("other.py", GOOD, "the slug is 'own'; it takes the file's name, 'other'"),
    ],
)
def test_a_broken_file_says_what_is_wrong(tmp_path, name, text, words):
    path = written(tmp_path, name, text)
    for _ in range(2):  # a failed load leaves nothing behind
        with pytest.raises(ExerciseError) as caught:
            load(path)
        assert words in str(caught.value)
        assert str(path) in str(caught.value)


def test_a_file_that_is_not_there_says_so(tmp_path):
    with pytest.raises(ExerciseError, match="cannot be read"):
        load(tmp_path / "own.py")


def test_an_unknown_exercise_names_the_nearest():
    with pytest.raises(ExerciseError, match=r"did you mean 'three_axis'\?.*known: .*rrt"):
        find("three_axes", exercise_files())
