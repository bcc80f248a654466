"""Handing out: drawn once, written once, the same for the same secret, and never touched again."""

import json
import os
import signal
import subprocess
import sys

import pytest
from answers import EXERCISES, SLUGS
from courses import BUNDLED, CLASS, LEVER, enrol, files_of, handed_out, make_course
from kinegrade.course.handing_out import generate as sheets
from kinegrade.course.handing_out import release
from kinegrade.course.handing_out.generate import generate
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import CourseError, read_course
from kinegrade.course.variants.variant import canonical, fingerprint
from kinegrade.exercises.exercise import ExerciseError

KILLED = """
import os, signal, sys
from pathlib import Path
from courses import handed_out
rename, left = os.replace, [int(sys.argv[2])]
def replace(*paths):
    if left[0] == 0:
        os.kill(os.getpid(), signal.SIGKILL)
    left[0] -= 1
    rename(*paths)
os.replace = replace
handed_out(Path(sys.argv[1]))
"""


def records(course, sheet="one"):
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        return gradebook.records(sheet)


def released(folder):
    """What was handed out and the worked solutions, which have the same names in another folder."""
    places = ("released/", "solutions/")
    return {path: data for path, data in files_of(folder).items() if path.startswith(places)}


def test_every_student_gets_a_sheet_and_the_instructor_a_solution(class_of_three):
    files = files_of(class_of_three.folder)
    for student, _ in CLASS:
        assert f"released/{student}/one.ipynb" in files
        assert f"solutions/{student}/one.ipynb" in files


def test_what_was_drawn_is_recorded_with_its_fingerprint(class_of_three):
    (exercise,) = exercises_of(class_of_three, class_of_three.settings.sheet[0])
    found = records(class_of_three)
    assert [(record.student, record.exercise, record.attempt) for record in found] == [
        (student, "lever", 0) for student, _ in CLASS
    ]
    for record in found:
        assert record.answers == fingerprint(exercise, record.numbers)
        about = json.loads(
            (class_of_three.folder / f"released/{record.student}/one.ipynb").read_bytes()
        )["metadata"]
        assert about["kinegrade"]["numbers"] == {"lever": record.numbers}


def test_the_same_secret_and_roster_give_the_same_bytes(tmp_path, bundled_course):
    again = handed_out(make_course(tmp_path, exercises=BUNDLED, students=[("ada", "Ada Lovelace")]))
    assert released(again.folder) == released(bundled_course.folder)
    assert records(again) == records(bundled_course)


def test_the_order_of_the_roster_changes_nothing(tmp_path, class_of_three):
    turned = handed_out(make_course(tmp_path / "turned", students=CLASS[::-1]))
    assert released(turned.folder) == released(class_of_three.folder)


def test_another_secret_gives_other_numbers(tmp_path, class_of_three):
    other = handed_out(make_course(tmp_path / "other", secret="another secret, long enough"))  # noqa: S106
    mine, theirs = (
        ({canonical(r.numbers) for r in records(course)}) for course in (class_of_three, other)
    )
    assert not mine & theirs


def test_numbers_are_compared_with_those_of_others_without_going_through_all_of_them_again(
    tmp_path, monkeypatch
):
    compared = []
    monkeypatch.setattr(
        sheets, "canonical", lambda numbers: compared.append(1) or canonical(numbers)
    )
    course = handed_out(make_course(tmp_path, students=[(f"s{i}", f"S {i}") for i in range(8)]))
    enrol(tmp_path, [(f"s{i}", f"S {i}") for i in range(12)])
    handed_out(tmp_path)
    assert len({canonical(record.numbers) for record in records(course)}) == 12
    assert len(compared) == 8 + (8 + 4)  # once when drawn, and once when a later run reads it


def test_a_second_sheet_of_the_same_exercise_has_other_numbers(tmp_path):
    course = handed_out(
        make_course(tmp_path, more='[[sheet]]\nname = "two"\nexercises = ["lever"]\n')
    )
    assert not {canonical(r.numbers) for r in records(course)} & {
        canonical(r.numbers) for r in records(course, "two")
    }


def test_a_second_run_writes_nothing_anew(class_of_three):
    before = files_of(class_of_three.folder)
    stamps = {path: path.stat().st_mtime_ns for path in class_of_three.folder.glob("*/*/*.ipynb")}
    with Gradebook(class_of_three.folder / "gradebook.sqlite") as gradebook:
        again = generate(class_of_three, gradebook, class_of_three.settings.sheet)
    assert [sheet.new for sheet in again] == [False] * 3
    assert files_of(class_of_three.folder) == before
    assert stamps == {path: path.stat().st_mtime_ns for path in stamps}


def test_a_late_joiner_is_added_and_a_released_file_is_never_rewritten(class_of_three):
    folder = class_of_three.folder
    edited = folder / "released" / "ben" / "one.ipynb"
    edited.write_bytes(edited.read_bytes().replace(b"A lever.", b"A lever, corrected by hand."))
    before, drawn = released(folder), records(class_of_three)
    enrol(folder, [("dee", "Dee"), *CLASS])
    course = handed_out(folder)
    assert {path: data for path, data in released(folder).items() if "/dee/" not in path} == before
    assert "released/dee/one.ipynb" in files_of(folder)
    assert [record for record in records(course) if record.student != "dee"] == drawn


def test_an_exercise_edited_after_the_release_does_not_change_what_is_out(class_of_three):
    folder = class_of_three.folder
    before = released(folder)
    (folder / "exercises" / "lever.py").write_text(
        LEVER.replace("A lever.", "A stick."), encoding="utf-8"
    )
    handed_out(folder)
    assert released(folder) == before


def test_somebody_who_left_keeps_numbers_that_nobody_else_gets(tmp_path):
    narrow = LEVER.replace("rng.integers(40, 121)) / 100", "rng.integers(1, 5))").replace(
        "float(rng.integers(200, 1300)) / 1000", "0.5"
    )
    make_course(tmp_path)
    (tmp_path / "exercises" / "lever.py").write_text(narrow, encoding="utf-8")
    handed_out(tmp_path)
    enrol(tmp_path, [("dee", "Dee")])
    course = handed_out(tmp_path)
    assert (
        len({canonical(record.numbers) for record in records(course)}) == len(records(course)) == 4
    )
    enrol(tmp_path, [("eve", "Eve")])
    with pytest.raises(ExerciseError, match="1000 draws gave no new numbers"):
        handed_out(tmp_path)


def test_a_sheet_whose_file_was_lost_is_written_again_as_it_was(class_of_three):
    folder = class_of_three.folder
    before = released(folder)
    (folder / "released" / "ada" / "one.ipynb").unlink()
    (folder / "solutions" / "ben" / "one.ipynb").unlink()
    handed_out(folder)
    assert released(folder) == before


def test_a_gradebook_that_was_lost_is_drawn_again_as_it_was(class_of_three):
    drawn = records(class_of_three)
    (class_of_three.folder / "gradebook.sqlite").unlink()
    assert records(handed_out(class_of_three.folder)) == drawn


def test_numbers_that_stay_with_the_instructor_do_not_make_a_released_sheet_another_one(tmp_path):
    slug = next(slug for slug in SLUGS if EXERCISES[slug].hidden)
    course = handed_out(make_course(tmp_path, exercises=(slug,), students=CLASS[:1]))
    before, drawn = released(tmp_path), records(course)
    (tmp_path / "gradebook.sqlite").unlink()
    assert records(handed_out(tmp_path)) == drawn
    assert released(tmp_path) == before


@pytest.mark.parametrize(
    "change",
    [
        lambda folder: make_course(folder, exercises=("lever", "rrt")),
        lambda folder: (
            make_course(folder, secret="x" * 20),
            (folder / "gradebook.sqlite").unlink(),
        ),
    ],
    ids=["another exercise", "gradebook and secret lost"],
)
def test_numbers_are_never_recorded_for_a_sheet_that_is_out_with_others(class_of_three, change):
    folder = class_of_three.folder
    before = released(folder)
    change(folder)
    with pytest.raises(
        CourseError, match=r"released/ada/one.ipynb was handed out with other exercises or numbers"
    ):
        handed_out(folder)
    assert released(folder) == before
    assert not [record for record in records(class_of_three) if record.exercise == "rrt"]


@pytest.mark.parametrize("renames", [0, 1, 4])
def test_a_run_killed_at_any_file_is_finished_by_the_next(tmp_path, class_of_three, renames):
    folder = make_course(tmp_path / "killed")
    command = [sys.executable, "-c", KILLED, str(folder), str(renames)]
    path = os.pathsep.join(entry for entry in sys.path if entry)
    killed = subprocess.run(command, env={**os.environ, "PYTHONPATH": path}, check=False)
    assert killed.returncode == -signal.SIGKILL
    assert len(list(folder.glob("*/*/one.ipynb"))) == renames
    handed_out(folder)
    written = {path: data for path, data in released(folder).items() if not path.endswith(".part")}
    assert written == released(class_of_three.folder)
    assert records(read_course(folder)) == records(class_of_three)


def test_an_unknown_exercise_is_named_with_the_nearest_and_all_others(tmp_path):
    with pytest.raises(
        ExerciseError, match=r"no exercise 'leever'; did you mean 'lever'\?"
    ) as caught:
        handed_out(make_course(tmp_path, exercises=("leever",)))
    assert f"known: {', '.join(sorted([*SLUGS, 'lever']))}" in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("EXERCISE = (\n", "lever.py: the exercise file stopped with SyntaxError"),
        (
            "EXERCISE = 1 / 0\n",
            "lever.py: the exercise file stopped with ZeroDivisionError: division by zero",
        ),
        ("EXERCISE = 5\n", "lever.py: an exercise file takes a top-level EXERCISE"),
        (
            LEVER.replace('slug="lever"', 'slug="stick"'),
            "'stick_' *, got|starts with stick_, got 'lever_p'",
        ),
        (
            LEVER.replace("np.array([-y, x])", "np.ones(3)"),
            r"solve of lever_J: takes finite numbers of shape \(2,\)",
        ),
    ],
)
def test_a_broken_exercise_of_the_course_is_named(tmp_path, text, words):
    make_course(tmp_path)
    (tmp_path / "exercises" / "lever.py").write_text(text, encoding="utf-8")
    with pytest.raises(ExerciseError, match=words):
        handed_out(tmp_path)


def test_an_exercise_twice_on_a_sheet_is_refused(tmp_path):
    with pytest.raises(
        CourseError, match="sheet one: lever_p is asked twice; answers are collected by name"
    ):
        handed_out(make_course(tmp_path, exercises=("lever", "lever")))


def test_an_exercise_of_the_course_replaces_ours_of_the_same_name(tmp_path):
    make_course(tmp_path, exercises=("rrt",))
    (tmp_path / "exercises" / "rrt.py").write_text(LEVER.replace("lever", "rrt"), encoding="utf-8")
    course = handed_out(tmp_path)
    assert {tuple(record.answers) for record in records(course)} == {("rrt_p", "rrt_J")}


@pytest.mark.parametrize(
    ("pins", "match"),
    [
        (
            "pinned.puma_velocity.wording = 'x'",
            r"pins .puma_velocity. \(did you mean .puma_velocities.\?\)",
        ),
        (
            "pinned.puma_velocities.wordin = 'x'",
            r"pins 'wordin' of puma_velocities \(did you mean 'wording'\?\)",
        ),
        ("pinned.puma_velocities.q = [1]", "its choices of form are: wording, family"),
    ],
)
def test_only_choices_of_form_of_the_sheet_are_pinned(tmp_path, pins, match):
    make_course(tmp_path, exercises=("puma_velocities",), more=f"\n{pins}\n")
    course = read_course(tmp_path)
    with pytest.raises(CourseError, match=match):
        exercises_of(course, course.settings.sheet[0])


def test_a_sheet_with_a_pin_gives_all_students_that_form(tmp_path):
    wording = "only vx prescribed, least norm"
    pin = f"\npinned.puma_velocities.wording = '{wording}'\n"
    handed_out(make_course(tmp_path, exercises=("puma_velocities",), more=pin))
    with Gradebook(tmp_path / "gradebook.sqlite") as gradebook:
        records = gradebook.records("one")
    assert {record.numbers["wording"] for record in records} == {wording}


def with_formats(folder, formats, **options):
    make_course(folder, **options)
    settings = folder / "course.toml"
    settings.write_text(
        f"formats = {json.dumps(formats)}\n{settings.read_text(encoding='utf-8')}", encoding="utf-8"
    )
    return folder


def test_a_course_with_two_formats_has_both_of_everything_and_the_same_bytes(tmp_path):
    first = handed_out(with_formats(tmp_path / "a", ["ipynb", "pdf"]))
    found = released(first.folder)
    for student, _ in CLASS:
        for place in ("released", "solutions"):
            assert found[f"{place}/{student}/one.pdf"].startswith(b"%PDF-1.7")
            assert f"{place}/{student}/one.ipynb" in found
    again = handed_out(with_formats(tmp_path / "b", ["ipynb", "pdf"]))
    assert released(again.folder) == found


def test_a_format_that_is_added_later_touches_no_notebook(class_of_three):
    before = released(class_of_three.folder)
    after = released(handed_out(with_formats(class_of_three.folder, ["ipynb", "pdf"])).folder)
    assert {path: after[path] for path in before} == before
    assert len(after) == 2 * len(before)


def test_a_sheet_on_paper_alone_is_handed_out_once(tmp_path):
    folder = with_formats(tmp_path, ["pdf"], mode="exam")
    before = released(handed_out(folder).folder)
    assert {path.rpartition(".")[2] for path in before} == {"pdf"}
    assert released(handed_out(folder).folder) == before


def test_a_large_class_is_written_by_several_processes_with_the_same_bytes(tmp_path, monkeypatch):
    students = [(f"s{i}", f"S {i}") for i in range(4)]
    alone = handed_out(make_course(tmp_path / "alone", students=students))
    monkeypatch.setattr(release, "WORTH", 2)
    monkeypatch.setattr(release, "write", None)  # this process writes nothing
    together = handed_out(make_course(tmp_path / "together", students=students))
    assert released(together.folder) == released(alone.folder)


def test_what_an_exercise_does_wrong_in_another_process_is_said_here(tmp_path, monkeypatch):
    monkeypatch.setattr(release, "WORTH", 1)
    folder = make_course(tmp_path)
    lever = folder / "exercises" / "lever.py"
    text = lever.read_text(encoding="utf-8")
    lever.write_text(
        text.replace('needs=("lever_p",)', 'needs=("lever_p",), explain="Text."'), encoding="utf-8"
    )
    with pytest.raises(
        ExerciseError, match="explain of lever_J takes a function that returns steps"
    ):
        handed_out(folder)
