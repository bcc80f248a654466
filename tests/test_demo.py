"""The demonstration: twelve students hand in what a class would, and get the same marks every time."""

import csv
import sqlite3

import pytest
from courses import files_of
from kinegrade.course.config import CourseError, read_course
from kinegrade.course.demo import HABITS, run_demo

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


def grades(folder):
    with (folder / "grades.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_the_demonstration_marks_a_class_of_twelve_and_twice_the_same(tmp_path, capsys):
    """One test for all of it: building the class takes most of the time."""
    folder = tmp_path / "demo"
    run_demo(folder)
    first = capsys.readouterr()
    rows = grades(folder)
    assert [row["student"] for row in rows] == [f"student{i:02}" for i in range(1, 13)]
    assert [row["name"] for row in rows] == [habit.title for habit in HABITS]
    assert {row["status"] for row in rows} == {"graded"}

    points = [float(row["points"]) / float(row["out_of"]) for row in rows]
    assert points[0] == 1
    assert points[1] > 0.8  # rounded to fewer decimals than asked
    assert points[8] == points[11] == 0  # empty, and somebody else's
    assert all(0.2 < share < 1 for share in points[2:8] + points[9:11])
    report = (folder / "report" / "index.html").read_text(encoding="utf-8")
    for student, words in MISTAKES.items():
        page = folder / "feedback" / f"student{student:02}" / "jacobian.html"
        assert words in (report if student == 12 else page.read_text(encoding="utf-8")), student
    assert "student01" not in (folder / "feedback" / "student12" / "jacobian.html").read_text(encoding="utf-8")
    assert "student12" in first.out
    assert "Feedback: " in first.err

    files = files_of(folder)
    run_demo(folder)
    assert capsys.readouterr() == first
    assert files_of(folder) == files

    with sqlite3.connect(folder / "gradebook.sqlite") as connection:
        connection.executescript("DELETE FROM grade; DELETE FROM current;")
    connection.close()
    run_demo(folder)
    assert capsys.readouterr() == first
    assert grades(folder) == rows
    for name in files:
        if not name.endswith(".sqlite"):
            assert (folder / name).read_bytes() == files[name], name


def test_the_demonstration_leaves_another_course_alone(tmp_path):
    (tmp_path / "course.toml").write_text('title = "mine"\n', encoding="utf-8")
    with pytest.raises(CourseError, match="not the demonstration; name another folder"):
        run_demo(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["course.toml"]


def test_a_demonstration_killed_while_it_was_prepared_is_prepared_again(tmp_path, monkeypatch):
    monkeypatch.setattr("kinegrade.course.demo.write_atomically", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        run_demo(tmp_path)
    monkeypatch.undo()
    monkeypatch.setattr("kinegrade.course.demo.generate", lambda *_: pytest.fail("prepared"))
    with pytest.raises(pytest.fail.Exception, match="prepared"):
        run_demo(tmp_path)
    assert len(read_course(tmp_path).students) == 12
