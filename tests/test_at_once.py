"""Several kinegrades on one course: all end well, with what one alone would have made; and a killed one loses nothing."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from courses import (
    enrol,
    files_of,
    hand_in,
    handed_out,
    make_course,
    notebook,
    right_answers,
)
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.ledger.tables import LEDGER
from kinegrade.course.settings.config import read_course
from sqlalchemy import select

MANY = [(f"s{i:02}", f"Student {i}") for i in range(12)]
COMMAND = (sys.executable, "-c", "from kinegrade.course.cli import main; main()")
KILLS = 200


def started(*arguments):
    path = os.pathsep.join(entry for entry in sys.path if entry)
    return subprocess.Popen(
        [*COMMAND, *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": path, "COLUMNS": "100"},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def ended(process):
    out, err = process.communicate(timeout=300)
    assert process.returncode == 0, err
    return out


def records(place):
    with Gradebook(place) as gradebook:
        return {record.student: record for record in gradebook.records("one")}


def rows(place):
    """Every row but its time, by table."""
    found = {}
    with Gradebook(place) as gradebook, gradebook.database.reading() as connection:
        for name, table in LEDGER.tables.items():
            columns = [column for column in table.c if column.name != "at"]
            found[name] = [tuple(row) for row in connection.execute(select(*columns))]
    return found


@pytest.fixture
def alone(tmp_path):
    """The course after one undisturbed `generate`."""
    course = handed_out(make_course(tmp_path / "alone", students=MANY))
    return course.folder


def test_two_generates_at_once_both_end_well_with_the_records_of_one(alone, tmp_path, place):
    folder = make_course(tmp_path / "both", students=MANY)
    both = [started("generate", "-c", folder, "--gradebook", place) for _ in range(2)]
    for process in both:
        ended(process)
    assert records(place) == records(alone / "gradebook.sqlite")
    assert len(rows(place)["record"]) == len(MANY)
    for name in ("released", "solutions"):
        assert files_of(folder / name) == files_of(alone / name)


def test_two_grades_at_once_both_end_well_and_mark_once(alone, place):
    course = handed_out(alone)
    for student, _ in MANY:
        hand_in(course, student, right_answers(course, student))
    ended(started("generate", "-c", alone, "--gradebook", place))
    for process in [started("grade", "-c", alone, "--gradebook", place) for _ in range(2)]:
        assert "5 / 5" in ended(process)
    found = rows(place)
    assert len(found["submission"]) == len(found["grade"]) == len(found["counted"]) == len(MANY)


def test_what_another_drew_in_the_meantime_holds(tmp_path, monkeypatch):
    """A run with another roster was here between the reading of the records and the saving."""
    course = handed_out(make_course(tmp_path, students=MANY[:1]))
    enrol(tmp_path, MANY)
    first = records(tmp_path / "gradebook.sqlite")
    save, overtaken = Gradebook.save_records, []

    def save_late(gradebook, fresh, reason=""):
        if not overtaken:
            overtaken.append(fresh)
            save(gradebook, fresh)
        save(gradebook, fresh, reason)

    monkeypatch.setattr(Gradebook, "save_records", save_late)
    handed_out(tmp_path)
    found = records(tmp_path / "gradebook.sqlite")
    assert list(found) == [student for student, _ in MANY]
    assert found["s00"] == first["s00"]
    assert len({str(record.numbers) for record in found.values()}) == len(course.students) + 11


def marks(folder):
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        return gradebook.current("one"), gradebook.marks("one")


@pytest.mark.slow
def test_two_hundred_kills_lose_nothing_double_nothing_and_leave_nothing(tmp_path):
    """Wherever a command is killed, in drawing, collecting, marking or writing, the next goes on from there."""
    course = handed_out(make_course(tmp_path / "drawn", students=MANY[:4]))
    blank = make_course(tmp_path / "blank", students=MANY[:4])
    right = {student: right_answers(course, student) for student, _ in MANY[:4]}
    blank_course = read_course(blank)
    hand_in(blank_course, "s00", right["s00"])
    hand_in(blank_course, "s01", {"lever_p": [9.0, 9.0], "lever_J": right["s01"]["lever_J"]})
    tip = right["s02"]["lever_p"].tolist()
    hand_in(blank_course, "s02", notebook(f"lever_p = {tip}", "lever_J = 'x'"), "one.ipynb")

    scratch = tmp_path / "scratch"
    scratch.mkdir()
    path = os.pathsep.join(entry for entry in sys.path if entry)
    ran = subprocess.run(
        [sys.executable, Path(__file__).with_name("killing.py"), blank, str(KILLS), "11"],
        env={**os.environ, "PYTHONPATH": path, "COLUMNS": "100", "TMPDIR": str(scratch)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    assert sum(map(int, ran.stdout.split())) >= KILLS

    timed = tmp_path / "timed"
    expected, complete = marks(timed), files_of(timed)
    assert [one.points for one in expected[0]["s00"]] == [2, 3]
    for folder in sorted(tmp_path.glob("killed*")):
        assert marks(folder) == expected
        found = files_of(folder)
        assert set(found) == set(complete)  # no .part and no journal
        for name in ("output.txt", "gradebook.sqlite"):
            del found[name]
        assert {name: data for name, data in found.items() if data != complete[name]} == {}

        kept = rows(folder / "gradebook.sqlite")
        assert len(kept["record"]) == len(kept["reference"]) == 4
        # a notebook whose jail was killed is not graded, and graded by the next run
        waiting = {grade for grade, _, _, status, *_ in kept["verdict"] if status == "not_graded"}
        graded = [grade for grade, *_ in kept["grade"] if grade not in waiting]
        assert len(kept["submission"]) == len(graded) == 3
        assert len(kept["counted"]) == len(kept["grade"])
