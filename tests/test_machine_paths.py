"""No student reads where on the marking machine something lies."""

import sys
import tempfile

import pytest
from courses import hand_in, handed_out, make_course, notebook
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.marking.written import mark_and_write
from kinegrade.grader.collecting.machine_paths import without_paths

SAID = {
    "No such file or directory: '/tmp/notebook-x/data.csv'": "No such file or directory: '…/data.csv'",
    "cannot import name 'x' from 'numpy' (/usr/lib/python3/numpy/__init__.py)": "cannot import name 'x' from 'numpy' (…/__init__.py)",
    "at /srv/kim/course/": "at …/",
    r"[WinError 2]: 'C:\Users\kim\data.csv'": "[WinError 2]: '…/data.csv'",
}
KEPT = [
    "1/2 and q1/l1/2", "a (b)/c/d", "sin(q1)/l1/l2", "m/rad", "/ is a sign", "a/b/c.csv", "f(x)[1]/2/3", "http://x/y",
    "5 m/s/s", "'data.csv'",
]  # fmt: skip
CELLS = [
    "lever_p = open('data.csv').read()",
    "from numpy import nothing_of_the_kind",
    "import os\nlever_J = os.getcwd() + 1",
    "lever_J = 1/0",
    "raise ValueError(__import__('sys').executable + ' ' + __import__('numpy').__file__)",
]


@pytest.mark.parametrize("said", SAID)
def test_of_a_path_its_last_name_is_left(said):
    assert without_paths(said) == SAID[said]


@pytest.mark.parametrize("said", KEPT)
def test_a_quotient_is_no_path(said):
    assert without_paths(said) == said


@pytest.mark.parametrize("number", range(len(CELLS)))
def test_no_page_of_a_student_says_where_it_was_marked(tmp_path, number):
    course = handed_out(make_course(tmp_path / "course"))
    hand_in(course, "ada", notebook(CELLS[number]), "one.ipynb")
    hand_in(course, "ben", notebook("import numpy as np", CELLS[number]), "one.ipynb")
    (course.folder / "submitted" / "cyd").mkdir()
    (course.folder / "submitted" / "cyd" / "one.json").symlink_to("../ben/one.json")
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        mark_and_write(course, gradebook, course.settings.sheet)
    for student in ("ada", "ben", "cyd"):
        page = (course.folder / "feedback" / student / "one.html").read_text(encoding="utf-8")
        for place in (tempfile.gettempdir(), str(tmp_path), sys.prefix, sys.base_prefix):
            assert place not in page
        sheet = (course.folder / "released" / student / "one.ipynb").read_text(encoding="utf-8")
        assert str(tmp_path) not in sheet
        assert sys.prefix not in sheet
