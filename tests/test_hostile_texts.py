"""A class whose every name and answer is hostile: it costs the part in which it stands, and nothing elsewhere."""

import csv
import json
import re
import unicodedata
from pathlib import Path

import pytest
from courses import hand_in, handed_out, make_course, right_answers
from kinegrade.course.settings.roster import SAFE_NAME

BAD = json.loads((Path(__file__).parent / "data" / "bad_inputs.json").read_text(encoding="utf-8"))
CONTROLS = [*map(chr, range(32)), "\x7f", *map(chr, range(0x80, 0xA0))]
TURNED = ["\u061c", "\u200e", "\u200f", *map(chr, (*range(0x202A, 0x202F), *range(0x2066, 0x206A)))]
LONE = ["\ud800", "\udfff", "\ud83d"]
MARKED_UP = [
    "<script>alert(1)</script>", '"><img src=x onerror=y>', "{{ 7*7 }}", "{% raw %}", "${7*7}", "[a](javascript:b)",
    "</style><svg/onload=x>", "<!--", "]]>", "&#x202e;", "&lt;b&gt;", "$\\input{/etc/passwd}$", "\\write18{ls}",
    "=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", "\r=1", "'=1", '=HYPERLINK("http://x")', "＝1", "%0a=1",
    "'; DROP TABLE grades; --", "../../course.toml", "/etc/passwd", "C:\\Windows", "~root", "$(id)", "`id`", "| ls",
    "\x1b[2J", "\x1b]0;title\x07", "\x1b[31mred", "[bold]rich[/]", "[link=x]y", "%s%n", "{0.__class__}", "__import__('os')",
    "1_000", "١٢٣", "１２３", "0x1f", "1e999", "-1e999", "nan", "inf", "1,5", "1.2.3", "٣,٥", "²", "½",
    "(" * 500, "[" * 500, "-" * 500, "sin(" * 300, "9" * 5000, "a" * 19_000, "q1^" * 400, "1/0", "0/0", "1e-400",
    "\ufeff1", "a\u0301" * 200, "\U0001f600", "ﷺ", "İ", "ß", "ſ", "\u2028", "\u2029", "\u00ad1", "\ue000", "\U0010ffff",
    "null", "None", "true", "undefined", "NaN", "...", "…", "!!python/object", "!include x", "---", "%YAML 1.2",
]  # fmt: skip
HOSTILE = [
    *(one["input"] for one in BAD),
    *(f"a{mark}b" for mark in (*CONTROLS, *TURNED, *LONE)),
    *MARKED_UP,
]
UNPRINTABLE = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]"
)


@pytest.fixture(scope="module")
def marked(tmp_path_factory):
    """A student for every text, which is the name and the first answer; the second answer is right."""
    students = [(f"s{i:03}", in_one_line(text)) for i, text in enumerate(HOSTILE)]
    folder = make_course(tmp_path_factory.mktemp("hostile"), students=students)
    course = handed_out(folder)
    for i, (student, _) in enumerate(students):
        answers = right_answers(course, student)
        hand_in(course, student, {"lever_p": HOSTILE[i], "lever_J": answers["lever_J"]})
    return course


@pytest.fixture(scope="module")
def graded(marked):
    """The course, graded, with marks and pages written."""
    from kinegrade.course.ledger.gradebook import Gradebook
    from kinegrade.course.marking.written import mark_and_write

    with Gradebook(marked.folder / "gradebook.sqlite") as gradebook:
        ((_, results),) = mark_and_write(marked, gradebook, marked.settings.sheet)
    return marked, results


def in_one_line(text):
    """A roster holds one student in a line, and no file holds half of a surrogate pair."""
    one = " ".join(text.split("\n")).replace("\r", " ")
    return "".join(char for char in one if unicodedata.category(char) != "Cs") or "x"


def test_there_are_enough_of_them():
    assert len(set(HOSTILE)) >= 190


def test_a_hostile_text_costs_its_own_part_alone(graded):
    course, results = graded
    assert [result.student.id for result in results] == [student.id for student in course.students]
    for result in results:
        first, second = result.verdicts
        assert (first.points, first.status) == (0.0, first.status)
        assert first.status in ("failed", "missing", "incorrect")
        assert (second.points, second.status) == (3.0, "correct")


def test_no_control_character_reaches_a_page(graded):
    course, _ = graded
    pages = [*course.folder.glob("feedback/*/one.html"), course.folder / "report" / "index.html"]
    assert len(pages) == len(HOSTILE) + 1
    for page in pages:
        text = page.read_text(encoding="utf-8")
        assert UNPRINTABLE.findall(text) == [], page
        ours = text.count("<script>") if page.parent.name == "report" else 0
        assert text.count("<script") == ours <= 1  # the report's own
        assert "<img src=x" not in text


def test_no_control_character_and_no_formula_reaches_the_table_of_grades(graded):
    course, _ = graded
    text = (course.folder / "grades.csv").read_text(encoding="utf-8")
    assert UNPRINTABLE.findall(text) == []
    rows = [*csv.DictReader(text.splitlines())]
    assert len(rows) == len(HOSTILE)
    assert [row for row in rows if row["name"].startswith(tuple("=+-@\t"))] == []
    assert {row["lever_J"] for row in rows} == {"3"}


def test_no_control_character_reaches_a_sheet(graded):
    course, _ = graded
    for path in course.folder.glob("released/*/one.ipynb"):
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        assert UNPRINTABLE.findall("".join("".join(cell["source"]) for cell in cells)) == [], path
        assert SAFE_NAME.fullmatch(path.parent.name)
