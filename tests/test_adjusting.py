"""Points, decimals, tolerances and parts of a sheet as course.toml sets them."""

import json

import numpy as np
import pytest
from courses import hand_in, handed_out, make_course, marked, right_answers
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.settings.adjusting import adjusted, spread
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import CourseError, Sheet, read_course
from kinegrade.course.sheet.handout import read_handout
from kinegrade.course.student.check import check_file
from kinegrade.exercises.exercise import Manual
from kinegrade.exercises.files.finding import exercise_files, load


def exercises(*slugs):
    return [load(exercise_files()[slug]) for slug in slugs]


def sheet(*slugs, **keys):
    return Sheet.model_validate({"name": "one", "exercises": slugs, **keys})


def points(made):
    return {part.variable: part.points for exercise in made for part in exercise.asked}


@pytest.mark.parametrize("total", [7, 10, 33.3])
def test_points_of_a_sheet_are_spread_in_hundredths_and_add_up(total):
    slugs = ("rrt", "implement_it")
    made = adjusted(exercises(*slugs), sheet(*slugs, points=total))
    assert sum(exercise.points for exercise in made) == pytest.approx(total, abs=1e-9)
    assert all(round(one, 2) == one for one in points(made).values())


def test_rubrics_add_up_to_the_points_of_their_part():
    (made,) = adjusted(exercises("implement_it"), sheet("implement_it", points=7))
    manual = [part for part in made.asked if isinstance(part.answer, Manual)]
    assert manual
    for part in manual:
        assert sum(one for one, _ in part.answer.rubric) == pytest.approx(part.points)


def test_spread_keeps_proportions():
    assert spread([1, 1, 2], 8) == [2, 2, 4]
    assert sum(spread([1, 1, 1], 10)) == pytest.approx(10)


def test_a_part_goes_before_its_exercise_and_that_before_the_sheet():
    keys = {
        "decimals": 2,
        "exercise": {"rrt": {"decimals": 3}},
        "part": [{"name": "rrt_J", "decimals": 5, "points": 9, "tolerance": 2}],
    }
    first, second = adjusted(exercises("rrt", "three_axis"), sheet("rrt", "three_axis", **keys))
    parts = {part.variable: part for part in (*first.asked, *second.asked)}
    assert getattr(parts["three_axis_A"].answer, "decimals", None) == 2
    assert parts["rrt_J"].points == 9
    assert parts["rrt_J"].tolerance_factor == 2
    decimals = {getattr(part.answer, "decimals", 3) for part in first.asked}
    assert decimals <= {3, 5}


def test_hints_are_left_out_of_a_sheet_or_of_one_exercise():
    off = {"exercise": {"rrt": {"hints": False}}}
    first, second = adjusted(exercises("rrt", "three_axis"), sheet("rrt", "three_axis", **off))
    assert not any(part.hints for part in first.asked)
    assert any(part.hints for part in second.asked)


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"exercise": {"rtt": {}}}, "did you mean 'rrt'"),
        ({"part": [{"name": "rrt_j"}]}, "rrt_J"),
        ({"part": [{"name": "nothing"}]}, "its parts are: rrt_"),
    ],
)
def test_tables_that_name_nothing_on_the_sheet_are_refused(keys, said):
    with pytest.raises(CourseError) as error:
        adjusted(exercises("rrt"), sheet("rrt", **keys))
    assert said in str(error.value)


def test_an_exercise_without_parts_is_refused():
    names = [{"name": part.variable, "drop": True} for part in exercises("rrt")[0].asked]
    with pytest.raises(CourseError, match="take the exercise off the sheet"):
        adjusted(exercises("rrt"), sheet("rrt", part=names))


DROPPED = '[[sheet.part]]\nname = "lever_p"\ndrop = true\n[sheet.exercise.lever]\npoints = 8\n'


def test_a_part_that_is_left_out_is_neither_asked_nor_marked(tmp_path):
    course = handed_out(make_course(tmp_path, more=DROPPED))
    released = json.loads((tmp_path / "released" / "ada" / "one.ipynb").read_bytes())
    cells = json.dumps(released["cells"])
    assert "lever_p" not in cells
    assert "lever_J" in cells
    hand_in(course, "ada", right_answers(course, "ada"))
    with Gradebook(tmp_path / "gradebook.sqlite") as gradebook:
        (result, *_) = marked(course, gradebook)
    assert (result.points, result.out_of) == (8, 8)
    assert list(result.earned) == ["lever_J"]


def test_a_changed_setting_marks_anew_and_check_hears_of_it(tmp_path):
    course = handed_out(make_course(tmp_path, mode="practice"))
    right = right_answers(course, "ada")
    off = {name: np.asarray(value) + 4e-4 for name, value in right.items()}
    hand_in(course, "ada", off)
    assert _points(course) < 5
    make_course(tmp_path, mode="practice", more="[sheet.exercise.lever]\ntolerance = 10\n")
    assert _points(read_course(tmp_path)) == 5

    sheet_file = tmp_path / "released" / "ada" / "one.ipynb"
    own = tmp_path / "submitted" / "ada" / "one.json"
    assert not all(remark.ok for remark in check_file(own, sheet_file, tmp_path / "exercises")[1])
    sheet_file.unlink()
    handed_out(tmp_path)
    assert read_handout(sheet_file).adjustments == {"exercise": {"lever": {"tolerance": 10.0}}}
    assert all(remark.ok for remark in check_file(own, sheet_file, tmp_path / "exercises")[1])


def _points(course):
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        (result, *_) = marked(course, gradebook)
    return result.points


def test_damaged_adjustments_get_a_sentence(tmp_path):
    handed_out(make_course(tmp_path, more="[sheet.exercise.lever]\ntolerance = 10\n"))
    path = tmp_path / "released" / "ada" / "one.ipynb"
    content = json.loads(path.read_bytes())
    content["metadata"]["kinegrade"]["adjusted"] = {"exercise": 7}
    path.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(CourseError, match="does not say which sheet"):
        check_file(path, exercises=tmp_path / "exercises")


def test_an_adjusted_sheet_loads_alike_in_another_process(tmp_path):
    course = handed_out(make_course(tmp_path, more=DROPPED))
    given = course.settings.sheet[0]
    again = Sheet.model_validate_json(given.model_dump_json())
    assert again == given
    assert [part.variable for part in exercises_of(course, again)[0].asked] == ["lever_J"]


def test_every_part_has_the_words_of_its_own_decimals():
    (made,) = adjusted(exercises("puma_velocities"), sheet("puma_velocities", decimals=6))
    asked = [part.answer.asked_beside for part in made.asked]
    assert "Give 6 decimals." in asked
    assert not [text for text in asked if text.startswith("Give") and "6" not in text]
