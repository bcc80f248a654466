"""A class is marked in worker processes as it is here, and a process that is killed costs nobody a mark."""

import pytest
from courses import CLASS, LEVER, enrol, hand_in, handed_out, make_course, notebook, right_answers
from kinegrade.course.grading import processes
from kinegrade.course.settings.config import read_course
from test_grading import graded, recorded, said, statuses

MANY = [*CLASS, *((f"s{i}", f"S {i}") for i in range(5))]
KILLS = """
import os, multiprocessing
from pathlib import Path


def killed_once_or_always(v):
    if v["L"] != LENGTH or multiprocessing.parent_process() is None:
        return
    mark = Path(__file__).with_name("killed")
    if ALWAYS or not mark.exists():
        mark.touch()
        os.kill(os.getpid(), 9)


def tip(v, _):
    killed_once_or_always(v)
"""


@pytest.fixture
def in_processes(monkeypatch):
    monkeypatch.setattr(processes, "WORTH", 2)
    monkeypatch.setattr(processes, "cores", lambda: 2)


@pytest.fixture
def folder(tmp_path):
    course = handed_out(make_course(tmp_path / "course", students=MANY))
    for i, (student, _) in enumerate(MANY):
        right = right_answers(course, student)
        if i % 3:
            right["lever_J"] = -right["lever_J"]
        tip = right["lever_p"].tolist()
        if i % 2:
            cells = notebook("import numpy", f"lever_p = {tip}", "lever_J = numpy.zeros(3)")
            hand_in(course, student, cells, "one.ipynb")
        else:
            hand_in(course, student, right)
    return course.folder


def test_worker_processes_give_the_marks_that_one_process_gives(folder, in_processes, monkeypatch):
    monkeypatch.setattr("kinegrade.course.grading.work.mark", None)  # this process marks nothing
    found = graded(folder)
    assert list(found) == [student for student, _ in MANY]
    assert recorded(folder) == found
    monkeypatch.undo()
    (folder / "gradebook.sqlite").unlink()
    handed_out(folder)
    assert graded(folder) == found
    assert {result.points for result in found.values()} == {2, 3.5, 5}


def test_few_submissions_start_no_process(folder, monkeypatch):
    monkeypatch.setattr(processes, "worker_processes", lambda: pytest.fail("started"))
    assert len(graded(folder)) < processes.WORTH


def killing(tmp_path, *, always):
    """A course whose exercise kills the worker process that marks ben."""
    folder = make_course(tmp_path / "course")
    course = handed_out(folder)
    with_length = [record.numbers["L"] for record in _records(folder) if record.student == "ben"]
    text = KILLS.replace("LENGTH", str(with_length[0])).replace("ALWAYS", str(always))
    (folder / "exercises" / "lever.py").write_text(
        LEVER.replace("\ndef tip(v, _):\n", text), encoding="utf-8"
    )
    for student, _ in CLASS:
        hand_in(course, student, right_answers(course, student))
    return folder


def _records(folder):
    from kinegrade.course.ledger.gradebook import Gradebook

    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        return gradebook.records("one")


def test_a_killed_process_costs_a_second_try_and_no_grade(tmp_path, in_processes):
    folder = killing(tmp_path, always=False)
    found = graded(folder)
    assert [result.points for result in found.values()] == [5, 5, 5]
    assert (folder / "exercises" / "killed").exists()


def test_what_kills_every_process_waits_with_the_reason_and_costs_nobody_else(
    tmp_path, in_processes, monkeypatch
):
    folder = killing(tmp_path, always=True)
    found = graded(folder)
    assert [result.points for result in found.values()] == [5, None, 5]
    assert statuses(found["ben"]) == ["not_graded"] * 2
    assert "was killed, twice; the submission is kept and will be marked again" in said(
        found["ben"]
    )
    monkeypatch.undo()  # in this process the exercise kills nobody
    assert graded(folder)["ben"].points == 5


def test_a_class_that_grows_is_marked_as_it_comes(folder, in_processes):
    first = graded(folder)
    enrol(folder, [*MANY, ("zoe", "Zoe")])
    course = handed_out(folder)
    hand_in(course, "zoe", right_answers(course, "zoe"))
    found = graded(folder)
    assert found.pop("zoe").points == 5
    assert found == first
    assert len(read_course(folder).students) == len(MANY) + 1
