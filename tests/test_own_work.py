"""What is told without the key: readable, shape, and whether answers fit each other."""

import numpy as np
import pytest
from answers import EXERCISES, part_of, raws_of, right_raws, variant_of
from kinegrade.exercises.answers import Choice, Conditions, Configurations, Numbers
from kinegrade.exercises.exercise import Manual, references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.own_work import remarks


def told(slug, changes, *, consistency=True, seed=0):
    exercise, v = EXERCISES[slug], variant_of(slug, seed)
    answers = references(exercise, v) | changes
    found = remarks(exercise, v, raws_of(exercise, v, answers), consistency=consistency)
    return {remark.part: remark for remark in found}


def test_a_right_sheet_fits_itself(exercise):
    v = variant_of(exercise.slug)
    found = list(remarks(exercise, v, right_raws(exercise, v), consistency=True))
    assert [remark.part for remark in found] == [part.variable for part in exercise.asked]
    assert all(remark.ok for remark in found)


def test_a_jacobian_that_does_not_follow_from_the_own_transforms_is_told():
    found = told("rrt", {"rrt_J": np.full((6, 3), 0.5)})
    assert not found["rrt_J"].ok
    assert "does not follow from your own rrt_dh and rrt_T" in found["rrt_J"].text


GUESSED = {
    "inverse_velocities": ("ranks", "solutions", "lost", "elbow"),
    "find_the_mistake": ("name", "J"),
    "frames": ("which",),
    "rrt": ("singular",),
    "pseudoinverse": ("sides", "null", "still"),
    "small_rotations": ("factor",),
    "statics": ("costless", "carried"),
}


@pytest.mark.parametrize(
    ("slug", "name"), [(slug, name) for slug, names in GUESSED.items() for name in names]
)
def test_what_could_be_tried_out_until_it_fits_is_said_to_be_readable_and_no_more(slug, name):
    exercise, v = EXERCISES[slug], variant_of(slug)
    part = part_of(exercise, f"{slug}_{name}")
    right = references(exercise, v)[part.variable]
    wrong = WRONG[type(part.answer)](right)
    for value in (right, wrong):
        remark = told(slug, {part.variable: value})[part.variable]
        assert (remark.ok, remark.text) == (True, "can be read")


WRONG = {
    Choice: lambda right: "b" if right == "a" else "a",
    Numbers: lambda right: right + 1.0,
    Configurations: lambda right: right + 0.5,
    Conditions: lambda right: right[:1],
}


def test_no_letter_of_a_choice_is_told_from_another(exercise):
    for part in exercise.asked:
        if not isinstance(part.answer, Choice):
            continue
        said = {told(exercise.slug, {part.variable: x})[part.variable] for x in part.answer.letters}
        assert len(said) == 1


def test_a_wrong_but_consistent_sheet_is_not_given_away():
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis")
    theirs = references(exercise, variant_of("three_axis", 9))
    own = {name: theirs[name] for name in ("three_axis_p", "three_axis_z")}
    for part in exercise.parts:
        if part.variable not in own:
            own[part.variable] = part.solve(v, own)
    assert all(remark.ok for remark in told("three_axis", own).values())


def test_wrong_formulas_and_numbers_that_fit_them_are_not_given_away():
    exercise, v = EXERCISES["planar_2r"], variant_of("planar_2r")
    pose, J = part_of(exercise, "planar_2r_pose"), part_of(exercise, "planar_2r_J_symbolic")
    own = {
        pose.variable: pose.answer.declared(
            ["l1*cos(q1) + l2*cos(q1 + q2)", "l1*sin(q1) + l2*sin(q1 + q2)", "q1"], v
        )
    }
    fitting = told("planar_2r", {**own, J.variable: J.solve(v, own)})
    assert fitting[J.variable].ok
    assert not told("planar_2r", own)[J.variable].ok


def test_what_is_marked_by_hand_is_there_or_not():
    exercise = EXERCISES["pseudoinverse"]
    (part,) = (part for part in exercise.asked if isinstance(part.answer, Manual))
    there = told("pseudoinverse", {})[part.variable]
    assert (there.ok, there.text) == (True, "is there; it is marked by hand")
    missing = told("pseudoinverse", {part.variable: Raw("missing")})[part.variable]
    assert (missing.ok, missing.text) == (False, "not answered; it is marked by hand")


@pytest.mark.parametrize(
    ("raw", "status", "words"),
    [
        (Raw("text", "My reason."), "not_graded", "is there"),
        (Raw("text", ["My reason.", ""]), "not_graded", "is there"),
        (Raw("text", " \n\t"), "missing", "not answered"),
        (Raw("text", ["", " "]), "missing", "not answered"),
        (Raw("missing"), "missing", "not answered"),
        (Raw("num", np.ones(2)), "failed", "takes text in quotes"),
        (Raw("error", "cell 3 stopped"), "failed", "cell 3 stopped"),
    ],
)
def test_check_and_marking_agree_on_what_is_there_to_be_marked_by_hand(raw, status, words):
    exercise, v = EXERCISES["pseudoinverse"], variant_of("pseudoinverse")
    (part,) = (part for part in exercise.asked if isinstance(part.answer, Manual))
    remark = told("pseudoinverse", {part.variable: raw})[part.variable]
    assert (remark.ok, remark.text) == (status == "not_graded", f"{words}; it is marked by hand")
    marked = {verdict.part: verdict for verdict in mark(exercise, v, {part.variable: raw})}
    assert marked[part.variable].status == status


@pytest.mark.parametrize("raw", [Raw("text", " "), Raw("text", [["", ""], [" ", ""]])])
def test_blank_text_is_no_answer_whatever_is_asked(exercise, raw):
    v = variant_of(exercise.slug)
    raws = {part.variable: raw for part in exercise.asked}
    assert {verdict.status for verdict in mark(exercise, v, raws)} == {"missing"}
    found = [
        remark.text.partition(";")[0] for remark in remarks(exercise, v, raws, consistency=True)
    ]
    assert found == ["not answered"] * len(exercise.asked)


def test_an_exam_tells_shape_and_nothing_more():
    found = told("rrt", {"rrt_J": np.ones((6, 3)), "rrt_T": np.ones((4, 4))}, consistency=False)
    assert (found["rrt_J"].ok, found["rrt_J"].text) == (True, "can be read")
    assert not found["rrt_T"].ok
    assert "takes shape (3, 4, 4)" in found["rrt_T"].text


@pytest.mark.parametrize("consistency", [True, False])
def test_what_cannot_be_read_says_why(consistency):
    found = told(
        "rrt", {"rrt_dh": Raw("missing"), "rrt_J": np.full((6, 3), np.nan)}, consistency=consistency
    )
    assert found["rrt_dh"].text == "not answered"
    assert "NaN" in found["rrt_J"].text


def test_own_answers_from_which_nothing_follows_are_no_failure():
    found = told("puma_velocities", {"puma_velocities_J": np.zeros((6, 6))})
    assert "nothing follows" in found["puma_velocities_qdot"].text
