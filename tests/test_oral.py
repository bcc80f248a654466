"""What is alike in a class is found and shown to talk about; it costs nobody a point."""

import ast
import os

import numpy as np
import pytest
from courses import hand_in, handed_out, make_course, notebook, right_answers
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.marking.written import mark_and_write
from kinegrade.course.results.alike import alike, code_cells, statements
from kinegrade.course.results.result import recorded_results

OWN = (
    "def turn(angle, axis):\n    K = cross_matrix(axis)\n    return np.eye(3) + np.sin(angle) * K\n",
    "first = turn(q[0], [0, 0, 1]) @ tool\nsecond = turn(q[1], [0, 1, 0]) @ tool\n",
)
WORDS = ["alpha", "beta", "gamma", "delta", "epsilon", "zeta"]


def test_statements_know_no_comments_and_no_layout():
    written = statements(["x = compute(1,\n   2)  # mine\n", "if ready:\n    y  =  compute( 3 )"])
    assert written == {"x = compute(1, 2)", "y = compute(3)"}
    assert statements(["%timeit compute(1)\n  f( (broken"]) == {"%timeit compute(1)"}
    assert statements(["return J"]) == set()


def test_the_head_of_a_statement_is_written_without_what_it_holds(monkeypatch):
    written, unparse = [], ast.unparse

    def noted(node):
        written.append(unparse(node))
        return written[-1]

    monkeypatch.setattr(ast, "unparse", noted)
    chain = "if is_ready(a):\n    first()\n" + "elif is_waiting(a):\n    second()\n" * 50
    tried = (
        "try:\n    with open_files():\n        pass\nexcept ValueError:\n    match one_of(them):\n"
    )
    held = tried + "        case 1:\n            pass"
    heads = {"if is_ready(a):", "if is_waiting(a):", "with open_files():", "match one_of(them):"}
    assert statements([chain, held]) == heads
    assert max(len(text.splitlines()) for text in written) == 1


def test_a_cell_that_nobody_typed_is_compared_line_by_line():
    line = 'x = "' + 20_000 * "a" + '"'  # parsed, it would come back in other quotation marks
    assert statements([line]) == {line}


@pytest.mark.parametrize("data", [b"", b"[]", b"{", b'{"cells": [{"cell_type": "code"}]}'])
def test_what_is_no_notebook_has_no_cells(data):
    assert code_cells(data) == []


def test_students_who_share_what_nobody_else_wrote_are_a_pair():
    shared = {f"{word} = compute({word}, 1)" for word in WORDS}
    taught = {"J = np.zeros((6, 3))", "z = rotation[:, 2]"}
    written = {
        "ada": shared | taught | {"ada = compute(1, 2)"},
        "ben": shared | taught | {"ben = compute(1, 2)"},
        "cyd": taught | {f"c{word} = compute(0)" for word in WORDS},
        "dan": taught | {f"d{word} = compute(0)" for word in WORDS},
    }
    (pair,) = alike(written)
    assert (pair.one, pair.other) == ("ada", "ben")
    assert set(pair.statements) == shared
    assert pair.share == pytest.approx(6 / 9)


def test_few_shared_statements_and_those_of_many_make_no_pair():
    taught = {f"{word} = compute({word}, 1)" for word in WORDS}
    assert alike(dict.fromkeys(["ada", "ben", "cyd", "dan"], taught)) == []
    few = {"first = compute(1, 2)", "second = compute(1, 2)"}
    assert alike({"ada": few, "ben": few}) == []


def rrt_course(folder):
    return handed_out(make_course(folder, exercises=("rrt",)))


def test_equal_wrong_numbers_stand_on_a_page_and_cost_nothing(tmp_path, kinegrade):
    course = rrt_course(tmp_path)
    made_up = np.arange(1.0, 19.0).reshape(6, 3) / 7
    for student in ("ada", "ben"):
        hand_in(course, student, {"rrt_J": made_up})
    hand_in(course, "cyd", {"rrt_J": made_up + 1})
    with Gradebook(tmp_path / "gradebook.sqlite") as gradebook:
        mark_and_write(course, gradebook, course.settings.sheet)
        before = recorded_results(course, gradebook, course.settings.sheet[0])
        ran = kinegrade("oral", "one", "--course", str(tmp_path))
        assert recorded_results(course, gradebook, course.settings.sheet[0]) == before
    assert ran.code == 0, ran.err
    assert "2 students to talk to" in ran.err
    page = (tmp_path / "report" / "oral-one.html").read_text(encoding="utf-8")
    assert str(tmp_path / "report" / "oral-one.html") in ran.out
    assert "<code>rrt_J</code>" in page
    assert "Ada Lovelace (<code>ada</code>), Ben Bot (<code>ben</code>)" in page
    assert "cyd" not in page
    assert "no points are taken off" in page


def test_shared_code_is_shown_without_what_was_handed_out(tmp_path, kinegrade):
    course = handed_out(make_course(tmp_path))
    for student in ("ada", "ben"):
        given = code_cells((tmp_path / "released" / student / "one.ipynb").read_bytes())
        hand_in(course, student, notebook(*given, *OWN), "one.ipynb")
    hand_in(course, "cyd", notebook("mine = 1"), "one.ipynb")
    ran = kinegrade("oral", "one", "--course", str(tmp_path))
    assert ran.code == 0, ran.err
    page = (tmp_path / "report" / "oral-one.html").read_text(encoding="utf-8")
    assert "first = turn(q[0], [0, 0, 1]) @ tool" in page
    assert "import numpy" not in page


def test_the_file_that_is_looked_at_is_the_one_that_is_marked(tmp_path, kinegrade):
    second = '[[sheet]]\nname = "one-2"\nexercises = ["lever"]\n'
    course = handed_out(make_course(tmp_path, more=second))
    for student in ("ada", "ben"):
        hand_in(course, student, notebook("mine = 1"), "one.ipynb")
        later = hand_in(course, student, notebook(*OWN), "one-2.ipynb")
        os.utime(later, (4e9, 4e9))
    at = ("--course", str(tmp_path))
    assert "0 students to talk to" in kinegrade("oral", "one", *at).err
    assert "2 students to talk to" in kinegrade("oral", "one-2", *at).err


def test_a_class_without_equals_has_a_page_that_says_so(tmp_path, kinegrade):
    course = handed_out(make_course(tmp_path))
    hand_in(course, "ada", right_answers(course, "ada"))
    assert "0 students" in kinegrade("oral", "one", "--course", str(tmp_path)).err
    page = (tmp_path / "report" / "oral-one.html").read_text(encoding="utf-8")
    assert "Nobody handed in what somebody else did." in page
