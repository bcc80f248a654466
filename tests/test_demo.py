"""The demonstration: twelve students hand in what a class would, and get the same marks every time."""

import csv
import sqlite3

import numpy as np
import pytest
from courses import files_of
from kinegrade.course.commands.demo import COMMENT, HABITS, SHEETS, Code, run_demo
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import CourseError, read_course
from kinegrade.course.variants.drawn import drawn
from kinegrade.exercises.answers import Manual
from kinegrade.exercises.exercise import references
from kinegrade.exercises.files.finding import exercise_files, load

STUDENTS = [f"student{i:02}" for i in range(1, len(HABITS) + 1)]
MISTAKES = {
    3: "Only a sign is wrong",
    4: "The angular rows seem to stand above the linear ones",
    5: "the angles of q, given in radians, are taken as degrees",
    6: "rows and columns look exchanged",
    7: "Takes shape (6, 3), got (3, 3)",
    8: "Takes finite numbers, got NaN",
    10: "is not Python",
    11: "ran longer than 2 s and was stopped",
    12: "This is the reference answer of student01",
}


def grades(folder, sheet):
    """Every student's line of grades.csv, the columns of that sheet without its name."""
    found = {}
    with (folder / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
        for row in csv.DictReader(file):
            own = {name.removeprefix(f"{sheet}_"): text for name, text in row.items()}
            found[row["student"]] = own
    return found


def share(row):
    return float(row["points"]) / float(row["out_of"])


@pytest.mark.slow
def test_the_demonstration_marks_a_class_of_twelve_and_twice_the_same(tmp_path, capsys):
    """One test for all of it: building the class takes most of the time."""
    folder = tmp_path / "demo"
    run_demo(folder)
    first = capsys.readouterr()
    course = read_course(folder)
    found = {name: grades(folder, name) for name, *_ in SHEETS}
    for name, rows in found.items():
        assert [*rows] == STUDENTS
        assert [row["name"] for row in rows.values()] == [habit.title for habit in HABITS]
        assert share(rows["student01"]) == 1
        least = 0.4 if name == "wishes" else 0.7  # a wished pose asks for six decimals
        assert share(rows["student02"]) > least  # rounded to fewer decimals than asked
        assert share(rows["student09"]) == 0  # empty

    jacobian = {student: share(row) for student, row in found["jacobian"].items()}
    assert jacobian["student12"] == 0  # somebody else's
    assert all(0.2 < jacobian[f"student{i:02}"] < 1 for i in (3, 4, 5, 6, 7, 8, 10, 11))
    report = (folder / "report" / "index.html").read_text(encoding="utf-8")
    for number, words in MISTAKES.items():
        page = folder / "feedback" / f"student{number:02}" / "jacobian.html"
        assert words in (report if number == 12 else page.read_text(encoding="utf-8")), number
    assert "student01" not in (folder / "feedback" / "student12" / "jacobian.html").read_text(
        encoding="utf-8"
    )

    by_hand = {
        (sheet.name, part.variable)
        for sheet in course.settings.sheet
        for exercise in exercises_of(course, sheet)
        for part in exercise.asked
        if isinstance(part.answer, Manual)
    }
    assert by_hand
    for sheet, rows in found.items():
        waiting = [part for name, part in by_hand if name == sheet]
        for student, row in rows.items():
            waits = (
                bool(waiting) and student == STUDENTS[-1]
            )  # the last one's answers are left to be marked
            assert row["status"] == ("not_graded" if waits else "graded")
            assert [row[part] == "" for part in waiting] == [waits] * len(waiting)
            assert (row["points"] == "") is waits
        if waiting:
            page = (folder / "feedback" / "student01" / f"{sheet}.html").read_text(encoding="utf-8")
            assert COMMENT in page
    assert all(student in first.out for student in STUDENTS)
    assert "Feedback: " in first.err

    with sqlite3.connect(folder / "gradebook.sqlite") as connection:
        connection.executescript(
            "DELETE FROM grade WHERE sheet = 'jacobian'; DELETE FROM counted WHERE sheet = 'jacobian';"
        )
    connection.close()
    files = files_of(folder)
    run_demo(folder)  # one sheet is marked anew, the others are left as they were
    assert capsys.readouterr() == first
    again = files_of(folder)
    assert set(again) == set(files)
    assert [
        name for name in files if not name.endswith(".sqlite") and again[name] != files[name]
    ] == []


def test_the_demonstration_has_every_exercise_on_one_sheet():
    assert sorted(slug for *_, slugs in SHEETS for slug in slugs.split()) == sorted(
        exercise_files()
    )


@pytest.fixture
def elsewhere(tmp_path):
    """The exercise that asks for a table, by another name."""
    path = tmp_path / "elsewhere.py"
    text = exercise_files()["rrt"].read_text(encoding="utf-8")
    path.write_text(text.replace('    "rrt",\n', '    "elsewhere",\n'), encoding="utf-8")
    return load(path)


def spoiled(exercise, title):
    (habit,) = (habit for habit in HABITS if habit.title == title)
    v = drawn(exercise, np.random.default_rng(0))
    right = references(exercise, v)
    handed = habit.spoil(exercise, v, right)
    return {
        name.removeprefix(f"{exercise.slug}_"): (right[name], answer)
        for name, answer in handed.items()
    }


def test_one_wrong_sign_of_a_table_is_gone_on_with_whatever_the_exercise_is_called(elsewhere):
    found = spoiled(elsewhere, "one sign wrong")
    before, after = ([str(cell) for row in table.rows for cell in row] for table in found["dh"])
    assert [i for i, pair in enumerate(zip(before, after, strict=True)) if pair[0] != pair[1]] == [
        3
    ]
    same = {name for name, (right, handed) in found.items() if handed is right}
    assert {"dh", "T", "J", "J_symbolic"} == {*found} - same


def test_code_stands_in_a_part_that_is_found_by_its_kind(elsewhere):
    found = spoiled(elsewhere, "endless loop in one question")
    codes = {name: answer.text for name, (_, answer) in found.items() if isinstance(answer, Code)}
    assert codes == {"J": "while True:\n    elsewhere_J = None"}
    broken = spoiled(load(exercise_files()["three_axis"]), "syntax error")
    assert [name for name, (_, answer) in broken.items() if isinstance(answer, Code)] == ["A"]


def test_the_demonstration_leaves_another_course_alone(tmp_path):
    (tmp_path / "course.toml").write_text('title = "mine"\n', encoding="utf-8")
    with pytest.raises(CourseError, match="not the demonstration; name another folder"):
        run_demo(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["course.toml"]


def test_a_demonstration_killed_while_it_was_prepared_is_prepared_again(tmp_path, monkeypatch):
    monkeypatch.setattr("kinegrade.course.commands.demo.write_atomically", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        run_demo(tmp_path)
    monkeypatch.undo()
    monkeypatch.setattr(
        "kinegrade.course.commands.demo.generate", lambda *_: pytest.fail("prepared")
    )
    with pytest.raises(pytest.fail.Exception, match="prepared"):
        run_demo(tmp_path)
    assert len(read_course(tmp_path).students) == 12
