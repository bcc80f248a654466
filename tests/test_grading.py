"""Marking a class: each on its own, nothing twice, nothing lost, and what waits is never a zero."""

import os
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from courses import (
    CLASS,
    LEVER,
    enrol,
    files_of,
    hand_in,
    handed_out,
    make_course,
    marked,
    notebook,
    right_answers,
)
from kinegrade.course.grading import work
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.marking.marker import SheetMarker
from kinegrade.course.results.result import recorded_results
from kinegrade.course.results.tables import remark
from kinegrade.course.settings.config import CourseError, read_course
from kinegrade.course.sheet.submissions import READERS

KILLED = """
import os, signal, sys
from pathlib import Path
from sqlalchemy import Engine, event
from kinegrade.course.marking import saving
from test_grading import graded
saving.PAUSE = 0.0  # a transaction for each
left = [int(sys.argv[2])]
@event.listens_for(Engine, "before_cursor_execute")
def count(connection, cursor, statement, *rest):
    if statement.startswith(("INSERT INTO grade", "INSERT INTO counted")):
        if left[0] == 0:
            os.kill(os.getpid(), signal.SIGKILL)  # between the two, the transaction is half done
        left[0] -= 1
graded(Path(sys.argv[1]))
"""
COUNTS = ("SELECT count(*) FROM grade", "SELECT count(*) FROM counted")


def graded(folder, *, accept_change=False):
    """Student to result, of a fresh run."""
    course = read_course(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        results = marked(course, gradebook, accept_change=accept_change)
        return {result.student.id: result for result in results}


def recorded(folder):
    course = read_course(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        return {
            result.student.id: result
            for result in recorded_results(course, gradebook, course.settings.sheet[0])
        }


def statuses(result):
    return [verdict.status for verdict in result.verdicts]


def said(result):
    return " ".join(
        [result.reason, *(finding.text for v in result.verdicts for finding in v.findings)]
    )


@pytest.fixture
def folder(class_of_three):
    """The course; everybody handed in what is right."""
    for student, _ in CLASS:
        hand_in(class_of_three, student, right_answers(class_of_three, student))
    return class_of_three.folder


def answers(folder, student):
    return right_answers(read_course(folder), student)


def put(folder, student, data, name="one.json"):
    return hand_in(read_course(folder), student, data, name)


def edit(folder, old, new):
    text = LEVER.replace(old, new)
    assert text != LEVER
    (folder / "exercises" / "lever.py").write_text(text, encoding="utf-8")


def test_right_answers_earn_all_points_in_the_order_of_the_roster(folder):
    found = graded(folder)
    assert list(found) == [student for student, _ in CLASS]
    assert [(result.points, result.out_of) for result in found.values()] == [(5, 5)] * 3


def test_every_student_is_counted_once_in_the_progress(folder):
    (folder / "submitted" / "ben" / "one.json").unlink()
    course, steps = read_course(folder), []
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        marked(course, gradebook, step=lambda: steps.append(1))
    assert len(steps) == 3


def test_wrong_missing_and_unreadable_parts_have_points_and_what_waits_has_none(folder):
    put(folder, "ada", {"lever_p": [9.0, 9.0]})
    put(folder, "ben", {"lever_p": "x", "lever_J": {"a": 1}})
    found = graded(folder)
    assert statuses(found["ada"]) == ["incorrect", "missing"]
    assert statuses(found["ben"]) == ["failed", "failed"]
    assert (found["ada"].points, found["ben"].points) == (0, 0)


def test_no_submission_is_no_grade(folder):
    (folder / "submitted" / "ben" / "one.json").unlink()
    result = graded(folder)["ben"]
    assert (result.verdicts, result.points, result.reason) == ((), None, "no submission")


def test_a_submission_under_another_name_is_pointed_at(folder):
    (folder / "submitted" / "ben" / "one.json").rename(
        folder / "submitted" / "ben" / "my answers.ipynb"
    )
    result = graded(folder)["ben"]
    assert (
        result.reason
        == "no submission; my answers.ipynb is there, but the file takes the name one.ipynb"
    )
    assert result.points is None


def test_a_submission_of_somebody_who_never_got_a_sheet_waits(folder):
    enrol(folder, [*CLASS, ("dee", "Dee")])
    put(folder, "dee", {"lever_p": [1, 2]})
    result = graded(folder)["dee"]
    assert statuses(result) == ["not_graded"] * 2
    assert "`kinegrade generate` adds it" in result.reason
    assert result.points is None


BAD = {
    "nothing": b"",
    "half a notebook": notebook("lever_p = [1, 2]")[:100],
    "garbage": bytes(range(256)) * 8,
    "UTF-16": notebook("lever_p = [1, 2]").decode().encode("utf-16"),
    "a list": b"[]",
    "it stops": notebook("1 / 0", "import os; os._exit(1)"),
    "it raises": notebook("lever_p = 1 / 0", "lever_J = 2 * lever_p"),
    "text and an object": notebook("lever_p = 'x'", "class A: pass\nlever_J = A()"),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_bad_notebook_fails_with_a_sentence_and_everybody_else_is_marked(folder, kind):
    (folder / "submitted" / "ben" / "one.json").unlink()
    put(folder, "ben", BAD[kind], "one.ipynb")
    found = graded(folder)
    assert statuses(found["ben"]) == ["failed"] * 2
    assert found["ben"].points == 0
    sentences = [verdict.findings[0].text.partition("\n")[0] for verdict in found["ben"].verdicts]
    assert all(
        sentence.endswith(".") for sentence in sentences
    )  # typed text with a caret may follow
    assert (found["ada"].points, found["cyd"].points) == (5, 5)


@pytest.mark.parametrize(
    "make", [lambda path: path.mkdir(), lambda path: path.symlink_to("nowhere")]
)
def test_a_submission_that_cannot_be_read_waits_and_everybody_else_is_marked(folder, make):
    (folder / "submitted" / "ben" / "one.json").unlink()
    make(folder / "submitted" / "ben" / "one.json")
    found = graded(folder)
    assert statuses(found["ben"]) == ["not_graded"] * 2
    assert "submitted/ben/one.json" in found["ben"].reason
    assert found["ben"].points is None
    assert (found["ada"].points, found["cyd"].points) == (5, 5)


def test_nothing_is_marked_twice(folder, monkeypatch):
    first = graded(folder)
    monkeypatch.setattr(work, "mark", lambda *_: pytest.fail("marked again"))
    assert graded(folder) == first


def test_a_new_submission_is_marked_anew_and_the_old_one_is_remembered(folder, monkeypatch):
    right = answers(folder, "ada")
    graded(folder)
    put(folder, "ada", right | {"lever_J": [0.0, 0.0]})
    assert graded(folder)["ada"].points == recorded(folder)["ada"].points == 2
    put(folder, "ada", right)
    monkeypatch.setattr(work, "mark", lambda *_: pytest.fail("marked again"))
    assert graded(folder)["ada"].points == recorded(folder)["ada"].points == 5


def test_the_same_bytes_in_a_file_of_another_kind_are_another_submission(folder):
    graded(folder)
    path = folder / "submitted" / "ada" / "one.json"
    path.rename(path.with_suffix(".csv"))
    assert statuses(graded(folder)["ada"]) == ["missing"] * 2


def test_other_limits_mark_anew(folder):
    graded(folder)
    course = folder / "course.toml"
    course.write_text(
        course.read_text(encoding="utf-8") + "[limits]\ncell_seconds = 3\n", encoding="utf-8"
    )
    graded(folder)
    with sqlite3.connect(folder / "gradebook.sqlite") as connection:
        assert connection.execute(
            "SELECT count(*) FROM grade WHERE student = 'ada'"
        ).fetchone() == (2,)
    connection.close()


def test_two_runs_give_the_same_results(folder):
    put(folder, "ada", {"lever_p": [9.0, 9.0]})
    first = graded(folder)
    with sqlite3.connect(folder / "gradebook.sqlite") as connection:
        connection.executescript("DELETE FROM counted; DELETE FROM grade;")
    connection.close()
    assert graded(folder) == first


def test_results_are_read_back_without_looking_at_submissions(folder):
    (folder / "submitted" / "cyd" / "one.json").unlink()
    first = graded(folder)
    (folder / "submitted" / "ada" / "one.json").unlink()
    again = recorded(folder)
    assert [again[student].verdicts for student in again] == [
        first[student].verdicts for student in first
    ]
    assert again["cyd"].reason == "nothing marked yet"


def test_a_failure_of_the_grader_leaves_a_submission_waiting_and_is_made_up_for(
    folder, monkeypatch, caplog
):
    right, real = answers(folder, "ben"), work.mark

    def failing(exercise, v, raws, others, **more):
        if np.allclose(raws["lever_p"].value, right["lever_p"]):
            raise KeyError("ours")
        return real(exercise, v, raws, others, **more)

    monkeypatch.setattr(work, "mark", failing)
    found = graded(folder)
    assert [result.points for result in found.values()] == [5, None, 5]
    assert statuses(found["ben"]) == ["not_graded"] * 2
    assert "exercise lever failed with KeyError" in said(found["ben"])
    assert "ben, sheet one: lever could not be marked" in caplog.text
    monkeypatch.undo()
    assert graded(folder)["ben"].points == recorded(folder)["ben"].points == 5


def test_a_failure_while_reading_a_submission_costs_that_submission_only(
    folder, monkeypatch, caplog
):
    def fail(*_):
        raise MemoryError("full")

    put(folder, "ben", b"lever_p\n1,2\n", "one.csv")
    (folder / "submitted" / "ben" / "one.json").unlink()
    monkeypatch.setitem(READERS, ".csv", fail)
    found = graded(folder)
    assert [result.points for result in found.values()] == [5, None, 5]
    assert "MemoryError" in said(found["ben"])
    assert "could not be marked" in caplog.text


def test_a_failure_in_one_exercise_leaves_the_others_marked(tmp_path, monkeypatch, caplog):
    make_course(tmp_path, exercises=("lever", "stick"), students=CLASS[:1])
    (tmp_path / "exercises" / "stick.py").write_text(
        LEVER.replace("lever", "stick"), encoding="utf-8"
    )
    course = handed_out(tmp_path)
    hand_in(course, "ada", right_answers(course, "ada"))
    real = work.mark
    monkeypatch.setattr(
        work,
        "mark",
        lambda e, *rest, **more: 1 / 0 if e.slug == "stick" else real(e, *rest, **more),
    )
    result = graded(tmp_path)["ada"]
    assert statuses(result) == ["correct", "correct", "not_graded", "not_graded"]
    assert result.points is None
    assert "ZeroDivisionError" in caplog.text


def test_parts_whose_reference_moved_wait_until_the_change_is_accepted(folder):
    before = graded(folder)
    edit(folder, "np.array([-y, x])", "np.array([y, x])")
    found = graded(folder)["ada"]
    assert statuses(found) == ["correct", "not_graded"]
    assert found.verdicts[1].part == "lever_J"
    assert "`kinegrade grade --accept-change`" in said(found)
    assert found.points is None
    accepted = graded(folder, accept_change=True)["ada"]
    assert (accepted.verdicts[0].status, accepted.verdicts[0].points) == ("correct", 2)
    assert statuses(accepted)[1] in ("partly", "incorrect")
    assert graded(folder)["ada"] == accepted
    assert before["ada"].points == 5
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        told = {event.what: event.reason for event in gradebook.history("ada", "one")}
    assert told["other reference answers of lever accepted"] == "grade --accept-change"


def test_parts_wait_that_moved_though_no_exercise_was_edited(folder, monkeypatch):
    before = graded(folder)
    monkeypatch.setattr(
        "kinegrade.course.grading.holding.installed", lambda _: "another"
    )  # of a library
    monkeypatch.setattr("kinegrade.course.grading.check.moved_parts", lambda *_: ["lever_J"])
    assert statuses(graded(folder)["ada"]) == ["correct", "not_graded"]
    monkeypatch.undo()
    assert graded(folder) == before


def test_an_edit_that_is_taken_back_brings_the_grades_back(folder):
    before = graded(folder)
    edit(folder, "np.array([-y, x])", "np.array([y, x])")
    assert graded(folder)["ada"].points is None
    (folder / "exercises" / "lever.py").write_text(LEVER, encoding="utf-8")
    assert graded(folder) == before
    assert recorded(folder) == before


def test_an_edit_that_changes_no_answer_marks_anew_and_waits_for_nobody(folder):
    graded(folder)
    edit(folder, "A lever.", "A stick.")
    assert [result.points for result in graded(folder).values()] == [5, 5, 5]


def test_a_change_in_a_module_beside_the_exercise_makes_its_marks_stale(folder, monkeypatch):
    (folder / "exercises" / "arms.py").write_text("share = 1.0\n", encoding="utf-8")
    edit(
        folder,
        "return np.array([-y, x])",
        "from arms import share\n    return share * np.array([-y, x])",
    )
    before = graded(folder)
    real, marked = work.mark, []
    monkeypatch.setattr(
        work, "mark", lambda e, *rest, **more: marked.append(e.slug) or real(e, *rest, **more)
    )
    assert graded(folder) == before
    assert marked == []
    (folder / "exercises" / "arms.py").write_text("share = 0.5 + 0.5\n", encoding="utf-8")
    assert graded(folder) == before
    assert len(marked) == 3
    (folder / "exercises" / "arms.py").write_text("share = 2.0\n", encoding="utf-8")
    assert statuses(graded(folder)["ada"]) == ["correct", "not_graded"]  # the answers moved, too


def test_a_change_in_what_marking_imports_makes_marks_stale(folder, monkeypatch):
    (folder / "exercises" / "arms.py").write_text(
        "from kinegrade.solutions.sections import lines\n", encoding="utf-8"
    )
    edit(folder, "import numpy", "import arms\nimport numpy")
    before = graded(folder)
    real, marked = work.mark, []
    monkeypatch.setattr(
        work, "mark", lambda e, *rest, **more: marked.append(e.slug) or real(e, *rest, **more)
    )
    read = Path.read_bytes
    for name, times in (("lines.py", 3), ("compare.py", 6), ("maps.py", 6)):
        monkeypatch.setattr(
            Path, "read_bytes", lambda path, name=name: read(path) + b"\n" * (path.name == name)
        )
        assert graded(folder) == before
        assert len(marked) == times, name


def test_accepting_a_change_writes_the_worked_solutions_again(folder, kinegrade):
    solutions = folder / "solutions"
    before = files_of(solutions)
    released = files_of(folder / "released")
    edit(folder, "np.array([-y, x])", "np.array([y, x])")
    assert "written again" not in kinegrade("grade", "--course", folder).err
    assert files_of(solutions) == before
    ran = kinegrade("grade", "--course", folder, "--accept-change")
    assert "answers of 3 students changed" in ran.err
    assert "3 worked solutions were written again" in ran.err
    after = files_of(solutions)
    assert set(after) == set(before)
    assert all(after[path] != before[path] for path in before)
    assert files_of(folder / "released") == released
    assert "written again" not in kinegrade("grade", "--course", folder, "--accept-change").err


def test_no_worked_solution_is_left_that_contradicts_an_accepted_answer(folder):
    """Killed after the change was accepted, before the solutions were written: they are not there."""
    edit(folder, "np.array([-y, x])", "np.array([y, x])")
    graded(folder, accept_change=True)
    assert files_of(folder / "solutions") == {}
    handed_out(folder)
    assert len(files_of(folder / "solutions")) == 3


def test_an_exercise_that_needs_numbers_it_did_not_draw_waits_and_cannot_be_accepted(
    folder, caplog
):
    edit(folder, 'v["L"] * np', 'v["width"] * np')
    found = graded(folder)
    assert {status for result in found.values() for status in statuses(result)} == {"not_graded"}
    assert "KeyError" in caplog.text
    with pytest.raises(
        CourseError,
        match="exercise lever cannot be accepted: it fails with KeyError: 'width' on the",
    ):
        graded(folder, accept_change=True)


def test_somebody_elses_answers_are_named_to_the_instructor_only(folder, monkeypatch):
    monkeypatch.setattr("kinegrade.grader.marking.follow.TELLING", 1)  # a lever has few numbers
    put(folder, "ben", answers(folder, "ada"))
    result = graded(folder)["ben"]
    told = [
        finding
        for verdict in result.verdicts
        for finding in verdict.findings
        if "ada" in finding.text
    ]
    assert len(told) == 2
    assert all(finding.private for finding in told)
    assert result.points == 0


SAME = {"lever_p": [3.21, -7.65], "lever_v": [1.23, 4.56]}


def shared_by(result):
    private = [f.text for v in result.verdicts for f in v.findings if f.private]
    return {text.split()[0] for text in private if "handed in the same numbers" in text}


@pytest.mark.parametrize("first", ["ada", "ben"])
def test_the_same_wrong_numbers_are_told_on_both_sides_whoever_came_first(
    folder, monkeypatch, first
):
    monkeypatch.setattr("kinegrade.grader.marking.follow.TELLING", 1)  # a lever has few numbers
    monkeypatch.setattr("kinegrade.grader.marking.sharing.TELLING", 1)
    monkeypatch.setattr("kinegrade.course.results.same_numbers.TELLING", 1)
    (second,) = {"ada", "ben"} - {first}
    put(folder, first, SAME)
    assert shared_by(graded(folder)[first]) == set()
    put(folder, second, SAME)
    found = graded(folder)
    assert (shared_by(found[first]), shared_by(found[second])) == ({second}, {first})
    assert graded(folder) == found  # and nothing is done twice
    put(folder, second, {"lever_p": [1.0, 2.0]})
    assert shared_by(graded(folder)[first]) == set()


def test_nobody_copies_from_oneself(folder):
    close = answers(folder, "ben")["lever_p"] + 1.5e-3
    put(folder, "ben", {"lever_p": close})
    result = graded(folder)["ben"]
    assert result.verdicts[0].status != "correct"
    assert "ben" not in said(result)


@pytest.mark.parametrize("statements", [1, 4])
def test_a_run_killed_inside_a_transaction_is_finished_by_the_next_with_the_same_grades(
    folder, tmp_path, statements
):
    put(folder, "ada", {"lever_p": [9.0, 9.0]})
    command = [sys.executable, "-c", KILLED, str(folder), str(statements)]
    path = os.pathsep.join(entry for entry in sys.path if entry)
    killed = subprocess.run(command, env={**os.environ, "PYTHONPATH": path}, check=False)
    assert killed.returncode == -signal.SIGKILL
    with sqlite3.connect(folder / "gradebook.sqlite") as connection:
        kept = [connection.execute(query).fetchone()[0] for query in COUNTS]
    connection.close()
    assert kept == [statements // 2] * 2
    undisturbed = handed_out(make_course(tmp_path / "undisturbed"))
    for student, _ in CLASS:
        hand_in(undisturbed, student, (folder / "submitted" / student / "one.json").read_bytes())
    assert graded(folder) == graded(undisturbed.folder)
    assert recorded(folder) == recorded(undisturbed.folder)


def test_a_stopped_run_does_not_read_the_rest_of_the_class(folder, monkeypatch):
    more = [(f"s{i}", f"S {i}") for i in range(6)]
    enrol(folder, [*CLASS, *more])
    handed_out(folder)
    for student, _ in more:
        put(folder, student, {"lever_p": [1, 2]})
    read, readers = [], READERS
    reader = readers[".json"]

    def stop(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("kinegrade.course.grading.place.cores", lambda: 1)
    monkeypatch.setitem(readers, ".json", lambda *of: read.append(1) or reader(*of))
    monkeypatch.setattr(SheetMarker, "_save", stop)
    with pytest.raises(KeyboardInterrupt):
        graded(folder)
    assert len(read) <= 2


def test_marked_files_are_marked_anew_only_when_asked(folder, monkeypatch):
    put(folder, "ada", answers(folder, "ada"))
    graded(folder)
    seen = []
    monkeypatch.setattr("kinegrade.course.grading.work.mark", lambda *_, **__: seen.append(1) or [])
    graded(folder)
    assert seen == []
    course = read_course(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        marked(course, gradebook, again=True)
    assert seen


def test_a_lost_gradebook_is_not_taken_for_an_empty_one(folder):
    (folder / "gradebook.sqlite").unlink()
    with pytest.raises(CourseError, match="knows nothing of sheet"):
        graded(folder)


def test_a_report_is_not_written_from_a_lost_gradebook(folder, kinegrade):
    assert kinegrade("report", "-c", folder).code == 0
    grades = (folder / "grades.csv").read_bytes()
    ran = kinegrade("report", "-c", folder, "--gradebook", folder / "gradebok.sqlite")
    assert ran.code == 1
    assert "gradebok.sqlite knows nothing of sheet one, though it was released" in ran.err
    (folder / "gradebook.sqlite").unlink()
    assert kinegrade("report", "-c", folder).code == 1
    assert (folder / "grades.csv").read_bytes() == grades


def test_other_versions_of_a_file_are_named_and_files_of_other_sheets_are_not(folder):
    for name in (
        "one (2).ipynb",
        "One-final.json",
        "one.csv",
        "two.json",
        "notes.txt",
        "oneself.py",
    ):
        os.utime(put(folder, "ada", b"{}", name), (1e9, 1e9))
    found = graded(folder)
    assert found["ada"].points == 5
    assert found["ada"].passed_over == ("One-final.json", "one (2).ipynb", "one.csv", "oneself.py")
    assert found["ben"].passed_over == ()
    assert remark(found["ada"]).startswith("also there, and not marked: One-final.json")
