"""PDFs of sheets and worked solutions: for every reader, the same bytes, with nothing in them that is to be found out."""

import json
import re
from dataclasses import replace
from io import BytesIO
from typing import Any

import pytest
from answers import EXERCISES, flat, variant_of
from courses import exercise_of, sheet
from kinegrade.course.settings.config import Student
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.typeset.document import Front, handout_data, solution_data
from kinegrade.course.typeset.mathml import FormulaError
from kinegrade.course.typeset.pdf import TypesettingError, pages, pdf
from kinegrade.exercises.exercise import Choice, Manual, Numbers, Part, Step
from pypdf import PdfReader

ADA = Student("ada", "Ada Lovelace")
CODE = "K7M3-QXB9"


def about(exercise, mode="graded", student=ADA, seed=0):
    front = Front("Tests", sheet(mode, (exercise.slug,)), student, CODE)
    return front, [Assignment(exercise, variant_of(exercise.slug, seed))]


def reader(data):
    return PdfReader(BytesIO(pdf(data)))


def texts(data):
    """The text of every page."""
    return [page.extract_text() for page in reader(data).pages]


def plain(text):
    """Text without blanks and hyphens, as lines may end anywhere."""
    return re.sub(r"[\s\-\u00ad\u2010]", "", text)


def test_every_sheet_is_set_for_every_reader_and_shows_its_parts(exercise):
    """Typst refuses PDF/UA where a formula or a figure has no words."""
    written = texts(handout_data(*about(exercise)))
    told = plain("".join(written))
    for part in exercise.asked:
        assert told.count(part.variable) >= 2  # the question and its boxes
        assert plain(f"({part.points:g} point") in told
    assert all(CODE in page for page in written)
    assert ADA.name in written[0]


def test_no_sheet_holds_an_answer_and_every_solution_does(exercise):
    front, assignments = about(exercise)
    v = variant_of(exercise.slug)
    handout = plain("".join(texts(handout_data(front, assignments))))
    solution = plain("".join(texts(solution_data(front, assignments))))
    printed = {f"{abs(x):.4f}" for x in flat(v)}
    found = set()
    for part in exercise.asked:
        if isinstance(part.answer, Numbers):
            answer = assignments[0].answers[part.variable]
            shown = {f"{abs(x):.{part.answer.decimals}f}" for x in flat(answer) if abs(x) > 0.1}
            found |= {text for text in shown if len(text) > 5 and text not in printed}
    asked = plain(exercise.statement(v)) + json.dumps(v)
    found = {text for text in found if text not in asked}
    assert [text for text in found if text in handout] == []
    if found:
        assert any(text in solution for text in found)


def test_the_same_student_gets_the_same_bytes():
    data = handout_data(*about(EXERCISES["rrt"]))
    first = pdf(data)
    pdf(solution_data(*about(EXERCISES["three_axis"])))
    assert pdf(data) == first
    assert pdf(handout_data(*about(EXERCISES["rrt"], seed=1))) != first


def test_a_pdf_says_that_it_is_tagged_and_names_nobody_in_its_metadata():
    found = reader(handout_data(*about(EXERCISES["three_axis"])))
    root: Any = found.trailer["/Root"]
    assert root["/MarkInfo"]["/Marked"]
    assert root["/Lang"] == "en"
    assert b"pdfuaid:part" in root["/Metadata"].get_data()
    said: Any = found.metadata
    assert said.title == "Sheet one"
    assert ADA.name not in str(said)


def test_an_exam_has_a_cover_and_a_code_on_every_page_and_no_hints():
    exercise = EXERCISES["rrt"]
    cover, *others = texts(handout_data(*about(exercise, "exam")))
    assert ADA.name in cover
    assert "1 Jacobian of an RRT robot 19" in cover
    assert all(CODE in page and ADA.name not in page for page in others)
    told = plain("".join(others))
    assert "Hints" not in told
    hints = [hint for part in exercise.asked for hint in part.hints if "$" not in hint]
    assert hints
    graded = plain("".join(texts(handout_data(*about(exercise)))))
    assert [hint for hint in hints if plain(hint) not in graded] == []
    assert [hint for hint in hints if plain(hint) in told] == []


@pytest.mark.parametrize(
    "name", ["#panic()", '$x$ *b* _i_ "q" \\ `c`', "]#[ <a> @b", "=SUM(A1)", "Zoë Çelik"]
)
def test_a_name_comes_out_as_it_is_whatever_it_holds(name):
    (exercise, v) = exercise_of(Part("t_x", "X", 1, Numbers(()), lambda *_: 1.0)), {"x": 0.5}
    front = Front("Tests", sheet(exercises=("t",)), Student("ada", name), CODE)
    told = "".join(texts(handout_data(front, [Assignment(exercise, v)])))
    assert plain(name) in plain(told)


def test_a_solution_shows_the_way_the_rubric_and_the_answer():
    parts = (
        Part("t_x", "X", 2, Numbers((2,), decimals=3), lambda *_: [1.5, -2.25],
             explain=lambda *_: [Step("Look at $x$:", r"\mathbf x", numbers=[1.5, -2.25])]),
        Part("t_c", "Which?", 1, Choice(("left", "right")), lambda *_: "b"),
        Part("t_why", "Why", 3, Manual(((1, "a reason <b> #x"), (2, "two"))), lambda *_: "The key."),
    )  # fmt: skip
    front = Front("Tests", sheet(exercises=("t",)), ADA, CODE)
    assignments = [Assignment(exercise_of(*parts), {"x": 0.5})]
    told = "".join(texts(solution_data(front, assignments)))
    for shown in (
        "Solution. Look at",
        "−2.250",
        "Answer: b",
        "1 point: a reason <b> #x",
        "The key.",
    ):
        assert shown in told
    blank = "".join(texts(handout_data(front, assignments)))
    for shown in ("−2.250", "Answer: b", "a reason", "The key."):
        assert shown not in blank


def test_an_unknown_command_is_named_with_exercise_and_part():
    part = Part("t_x", r"The angle $\foo$", 1, Numbers(()), lambda *_: 1.0)
    front = Front("Tests", sheet(exercises=("t",)), ADA, CODE)
    with pytest.raises(
        FormulaError, match=r"exercise t, t_x: the command \\foo in \$\\foo\$ is unknown"
    ):
        handout_data(front, [Assignment(exercise_of(part), {"x": 0.5})])


def test_a_figure_without_words_is_refused():
    front, assignments = about(EXERCISES["three_axis"])
    data = handout_data(front, assignments)
    data["exercises"][0]["figures"][0]["alt"] = None
    with pytest.raises(TypesettingError, match=r"Sheet one of ada cannot be set: .*alt"):
        pdf(data)


def test_pages_can_be_looked_at():
    front, assignments = about(EXERCISES["implement_it"])
    drawn = pages(handout_data(front, assignments), ppi=20)
    assert len(drawn) == len(texts(handout_data(front, assignments)))
    assert all(page.startswith(b"\x89PNG") for page in drawn)


def test_the_order_of_rows_stands_where_it_differs():
    rows = [
        replace(EXERCISES["rrt"], rows=order) for order in ("linear, angular", "angular, linear")
    ]
    front = Front("Tests", sheet(exercises=("rrt", "rrt")), ADA, CODE)
    data = handout_data(front, [Assignment(one, variant_of("rrt")) for one in rows])
    told = " ".join("".join(texts(data)).split())
    assert "the angular rows stand above the linear ones" in told
    assert "the linear rows stand above the angular ones" in told
