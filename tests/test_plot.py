"""The command `plot`: kinds, formats, postures, and a robot as a student has it."""

from dataclasses import replace

import numpy as np
import pytest
from courses import handed_out, make_course
from kinegrade.course.commands.own_robot import own_robot
from kinegrade.course.commands.plot import Kind
from kinegrade.course.errors import CourseError
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.settings.config import read_course
from kinegrade.exercises.files.finding import exercise_files, find
from kinegrade.grader.figures import maps
from kinegrade.grader.figures.formats import FigureError
from kinegrade.grader.figures.robot_figure import KINDS, robot_figure
from kinegrade.grader.figures.robot_postures import ellipsoids, posture, usual_posture
from kinegrade.solutions.errors import KinegradeError
from kinegrade.solutions.robots import ROBOTS, robot
from test_cli import complaint

STARTS = {".png": b"\x89PNG", ".svg": b"<svg", ".pdf": b"%PDF"}
SHEETS = """
[[sheet]]
name = "two"
title = "Sheet two"
mode = "graded"
exercises = ["statics", "rrt"]
"""


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """A course in which every student has the three-axis arm twice, with lengths of its own."""
    folder = tmp_path_factory.mktemp("plot") / "course"
    make_course(folder, exercises=("lever", "three_axis", "planar_2r"), more=SHEETS)
    handed_out(folder)
    return folder


def numbers_of(folder, student, exercise):
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        for sheet in ("one", "two"):
            for record in gradebook.records(sheet):
                if (record.student, record.exercise) == (student, exercise):
                    return record.numbers
    raise AssertionError


def owned(folder, name, *, student="ben", sheets=(), exercise=None, at_q=False):
    course = read_course(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        chosen = course.sheets(sheets)
        return own_robot(course, gradebook, chosen, student, robot(name), exercise, at_q=at_q)


def test_the_kinds_of_the_command_are_those_of_the_figures():
    assert {kind.value for kind in Kind} == set(KINDS)


def test_plot_of_an_unknown_robot_is_one_sentence(kinegrade, tmp_path):
    assert "puma560" in complaint(kinegrade("plot", "puma", "-o", tmp_path / "p.png"))


def test_plot_writes_a_figure_and_says_what_it_shows(kinegrade, tmp_path, monkeypatch):
    monkeypatch.setattr(maps, "picture", lambda arm, suffix, *_: f"{arm.name}{suffix}".encode())
    monkeypatch.setattr(maps, "describe", lambda arm, _: f"What {arm.name} reaches.")
    ran = kinegrade("plot", "planar_2r", "-o", tmp_path / "p.svg")
    said = "What planar_2r reaches.\n"
    assert (ran.code, ran.out, ran.err) == (0, f"{tmp_path / 'p.svg'}\n", said)
    assert (tmp_path / "p.svg").read_bytes() == b"planar_2r.svg"
    nowhere = kinegrade("plot", "planar_2r", "-o", tmp_path / "p.svg" / "p.svg")
    assert (nowhere.code, nowhere.out) == (1, "")
    assert "p.svg: " in nowhere.err


@pytest.mark.parametrize("suffix", STARTS)
@pytest.mark.parametrize("kind", ["posture", "ellipsoids"])
def test_an_arm_is_written_in_every_format_with_the_same_bytes_twice(kind, suffix):
    one, two = (robot_figure(ROBOTS["puma560"], kind, suffix) for _ in range(2))
    assert one == two
    assert one.data.startswith(STARTS[suffix])


@pytest.mark.parametrize("suffix", STARTS)
@pytest.mark.parametrize("kind", ["workspace", "singularities"])
def test_a_map_is_written_in_every_format(kind, suffix):
    drawn = robot_figure(ROBOTS["planar_2r"], kind, suffix)
    assert drawn.data.startswith(STARTS[suffix] if suffix != ".svg" else b"<?xml")
    assert "0.3 m to 1.7 m" in drawn.words


@pytest.mark.parametrize("kind", KINDS)
def test_another_format_is_refused_with_a_sentence(kind):
    with pytest.raises(FigureError, match=r"\.png, \.svg or \.pdf, got one in '\.jpg'"):
        robot_figure(ROBOTS["planar_2r"], kind, ".jpg")


@pytest.mark.parametrize("name", ROBOTS)
def test_the_usual_posture_is_within_the_limits_and_not_singular(name):
    arm = ROBOTS[name]
    q = usual_posture(arm)
    assert arm.outside(q) == ()
    assert "lost" not in ellipsoids(arm, None, q).words
    assert arm.title in posture(arm, None, q).svg


def test_ellipsoids_say_their_half_axes_and_what_is_lost():
    arm = ROBOTS["planar_2r"]
    bent = ellipsoids(arm, {"l1": 1.0, "l2": 1.0}, (0.3, np.pi / 2)).words
    assert "half axes of 1.62, 0.618 m/s" in bent  # the golden ratio
    assert "a direction of motion is lost" in ellipsoids(arm, None, (0.3, 0.0)).words


def test_a_figure_of_ellipsoids_names_every_half_axis_and_stays_on_the_page():
    svg = ellipsoids(ROBOTS["panda"], None, usual_posture(ROBOTS["panda"])).svg
    assert svg.count('class="ellipsoid"') == 2
    assert svg.count('class="half-axis"') == 3
    assert svg.count("half-axis-label") == 3


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--q", "0,0"), "--q takes --kind posture or ellipsoids"),
        (("--kind", "posture", "--q", "0,0"), "--q takes 6 numbers for puma560"),
        (("--kind", "posture", "--q", "qx"), "or one of qz, qr, qs, qn, example; got 'qx'"),
        (("--kind", "posture", "--q", "0,0,0,0,0,inf"), "finite"),
        (("--sheet", "one"), "they take --student"),
        (("--exercise", "rrt"), "they take --student"),
        (("--kind", "posture", "-o", "p.jpg"), "got one in '.jpg'"),
    ],
)
def test_what_cannot_be_meant_is_one_sentence(kinegrade, arguments, words):
    assert words in complaint(kinegrade("plot", "puma560", *arguments))


def test_an_unknown_kind_is_wrong_usage_that_lists_them(kinegrade):
    ran = kinegrade("plot", "puma560", "--kind", "map")
    assert ran.code == 2
    assert "ellipsoids" in ran.err


@pytest.mark.parametrize("text", ["0.1,0.5,0.1,0.8,0.1,0.2", "0.1 0.5 .1 .8 .1 .2", "example"])
def test_a_posture_is_given_by_numbers_or_by_name(kinegrade, tmp_path, text):
    where = tmp_path / "p.svg"
    ran = kinegrade("plot", "puma560", "--kind", "posture", "--q", text, "-o", where)
    assert (ran.code, ran.out) == (0, f"{where}\n")
    assert "q2 = 0.5 rad" in ran.err


def test_a_students_robot_has_the_students_lengths_and_q(course):
    drawn = numbers_of(course, "ben", "three_axis")
    own = owned(course, "three_axis", sheets=("one",))
    assert own.lengths == {name: drawn[name] for name in ("L", "a2", "a3")}
    assert list(own.q) == drawn["q"]
    other = owned(course, "three_axis", student="ada", sheets=("one",))
    assert other.lengths != own.lengths


def test_a_students_form_is_that_of_the_sheet(course):
    drawn = numbers_of(course, "ben", "rrt")
    own = owned(course, "rrt_offset")
    (_, now) = find("rrt", exercise_files()).drawings(drawn)
    np.testing.assert_allclose(own.robot.chain(own.lengths).fixed, now.chain.fixed, atol=1e-12)


def test_a_planar_form_has_its_two_rows_and_its_angle_in_radians(course):
    own = owned(course, "planar_2r")
    assert own.robot.task_rows == (0, 1)
    assert "beta = " in posture(own.robot, own.lengths, own.q).words
    assert " rad)" in posture(own.robot, own.lengths, own.q).words


def test_the_command_draws_a_students_robot(kinegrade, course, tmp_path):
    where = tmp_path / "own.svg"
    of = ("--student", "ben", "--course", course, "-o", where)
    ran = kinegrade("plot", "rrt_offset", "--kind", "ellipsoids", *of)
    assert (ran.code, ran.out) == (0, f"{where}\n")
    drawn = numbers_of(course, "ben", "rrt")
    assert f"d1 = {drawn['d1']:.5g} m" in ran.err
    assert f"q1 = {drawn['q'][0]:.4g} rad" in ran.err


@pytest.mark.parametrize(
    ("name", "chosen", "words"),
    [
        ("three_axis", {}, "in 2 exercises: three_axis of sheet one, statics of sheet two"),
        ("three_axis", {"exercise": "rrt"}, "no exercise rrt about three_axis"),
        ("scara", {}, "no exercise about scara; there are planar_2r in planar_2r of sheet one"),
        ("scara", {"student": "bem"}, "has no student 'bem' (did you mean 'ben'?)"),
        ("scara", {"sheets": ("three",)}, "there is no sheet 'three'"),
    ],
)
def test_what_a_student_does_not_have_is_one_sentence(course, name, chosen, words):
    with pytest.raises(CourseError) as raised:
        owned(course, name, **chosen)
    assert words in str(raised.value)


def test_a_course_without_sheets_handed_out_is_one_sentence(tmp_path):
    folder = make_course(tmp_path / "course", exercises=("three_axis",))
    with pytest.raises(CourseError, match="`kinegrade generate` draws"):
        owned(folder, "three_axis")


def test_one_arm_in_two_exercises_is_asked_about_only_where_q_matters(tmp_path):
    folder = make_course(tmp_path / "course", exercises=("puma_velocities", "inverse_velocities"))
    handed_out(folder)
    assert owned(folder, "puma560").exercise == "inverse_velocities"
    with pytest.raises(CourseError, match="say which"):
        owned(folder, "puma560", at_q=True)


def test_a_length_that_the_robot_has_not_is_one_sentence():
    with pytest.raises(KinegradeError, match="l9"):
        posture(ROBOTS["planar_2r"], {"l9": 1.0}, (0.1, 0.2))


def test_a_robot_of_one_joint_has_a_posture_but_no_map():
    single = replace(
        ROBOTS["planar_2r"],
        rows=(("q1", "0", "l1", "0"),),
        limits=((-1.0, 1.0),),
        factors=(),
        task_rows=(0,),
    )
    assert robot_figure(single, "posture", ".svg").data
    with pytest.raises(FigureError, match="two joints or more"):
        robot_figure(single, "workspace", ".svg")
