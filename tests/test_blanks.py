"""Answer cells: a blank of every kind says what is asked, and an answer as code is read back as that answer."""

import ast
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from answers import EXERCISES, answer_code, kinds_of, variant_of
from courses import exercise_of, notebook
from kinegrade.course.commands.demo import fill_in
from kinegrade.course.sheet.self_check import self_check
from kinegrade.course.sheet.submissions import Submission
from kinegrade.exercises.answers import (
    Choice,
    Conditions,
    Configurations,
    Formulas,
    Function,
    Manual,
    Numbers,
    TableOf,
)
from kinegrade.exercises.exercise import Outcome, Part, references
from kinegrade.grader.collecting.ask import Limits
from kinegrade.grader.kinds.markers import MARKERS
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.table import read_table


def doubled(x: "Any") -> "Any":
    """Nothing but np is known where it is printed."""
    return 2 * np.asarray(x)


def judged(_, __, value):
    return Outcome(right=np.abs(np.sin(value)) < 1e-3)


V = {"x": 0.3, "l1": 0.75, "q": [0.2, 0.4]}
ROWS = [["q1 + pi/2", "l1", 0, "-pi/2"], [0, "q2", 0.25, 0]]
KINDS = {
    "one number": (Numbers(()), -0.0),
    "a vector": (Numbers((3,)), [0.5, -1e-7, 12.25]),
    "a matrix": (Numbers((6, 7)), np.arange(42).reshape(6, 7) / 7),
    "a stack": (Numbers((2, 3, 3)), np.arange(18).reshape(2, 3, 3) / 9),
    "a table": (TableOf(("l1",), "RP"), read_table(ROWS, ("l1", "q1", "q2"))),
    "one formula": (Formulas((), ("l1", "q1")), "l1*cos(q1) - 1"),
    "formulas": (Formulas((2,), ("l1", "q1")), ["l1*cos(q1)", "0.5"]),
    "a matrix of formulas": (
        Formulas((2, 2), ("l1", "q1")),
        [["cos(q1)", "-sin(q1)"], ["l1", "0"]],
    ),
    "a choice": (Choice(("it's one", "another", "none")), "b"),
    "conditions": (
        Conditions(("q1", "q2"), lambda _: {"q1": (-3.2, 3.2), "q2": (-3.2, 3.2)}),
        ["sin(q2)"],
    ),
    "angles": (Configurations(1), [0.0, np.pi]),
    "configurations": (Configurations(2), [[0.0, np.pi], [np.pi, 0.0]]),
    "a function": (
        Function("(x)", lambda _: {"small": [(1.5,), ([1, 2],)], "none": [([],)]}),
        doubled,
    ),
    "text": (Manual(((3.0, "a reason"),)), 'It\'s "so",\nand so.'),
}
FORMS = {
    "one number": "one number",
    "a vector": "3 numbers",
    "a matrix": "6 x 7 numbers",
    "a stack": "2 x 3 x 3 numbers",
    "a table": "2 rows [theta, d, a, alpha]",
    "one formula": "one formula, as text or sympy",
    "formulas": "2 formulas, as text or sympy",
    "a matrix of formulas": "2 x 2 formulas, as text or sympy",
    "a choice": "one of 'a', 'b', 'c'",
    "conditions": "a list of conditions, such as ['sin(q1) = 0']",
    "angles": "a list of numbers",
    "configurations": "a list of rows of 2 numbers",
    "text": "your text in quotes; it is marked by hand",
}


def one(kind):
    """An exercise with one part of a kind."""
    answer, value = KINDS[kind]
    check = judged if isinstance(answer, Configurations) else None
    return exercise_of(
        Part("t_x", "x?", 3, answer, lambda *_: value, check=check), draw=lambda _: V
    )


def marked(exercise, v, *cells):
    """Verdicts on a notebook of these cells."""
    submission = Submission(Path("one.ipynb"), notebook("import numpy as np", *cells))
    verdicts = mark(exercise, v, submission.raws(submission.asks(exercise, v), Limits()))
    return {verdict.part: verdict for verdict in verdicts}


def self_checked(exercise, code):
    """What the self-check prints for each answer after some code."""
    scope, out = {"np": np}, StringIO()
    with redirect_stdout(out):
        exec(f"{code}\n{self_check(exercise.asked)}", scope)  # noqa: S102
    return dict(line.split(None, 1) for line in out.getvalue().splitlines())


def test_every_kind_of_answer_is_looked_at():
    kinds = {type(answer) for answer, _ in KINDS.values()}
    assert kinds == set(MARKERS)
    assert set().union(*map(kinds_of, EXERCISES.values())) <= kinds


@pytest.mark.parametrize("kind", FORMS)
def test_a_blank_says_what_is_asked(kind):
    (part,) = one(kind).asked
    assert part.answer.form == FORMS[kind]
    assert part.answer.blank(part.variable) == f"t_x = ...  # {FORMS[kind]}"


def test_the_blank_of_a_function_is_a_function():
    (part,) = one("a function").asked
    assert part.answer.blank(part.variable) == "def t_x(x):\n    ..."


def test_the_blank_of_what_is_done_on_paper_says_so():
    part = Part("t_x", "x?", 3, Manual(((3.0, "a sketch"),), on_paper=True), lambda *_: "key")
    assert part.answer.blank(part.variable) == "t_x = ...  # on paper"
    assert self_checked(exercise_of(part), part.answer.blank(part.variable)) == {}


@pytest.mark.parametrize("kind", KINDS)
def test_a_blank_is_not_answered(kind):
    exercise = one(kind)
    (part,) = exercise.asked
    assert self_checked(exercise, part.answer.blank(part.variable)) == {"t_x": "not answered yet"}
    verdict = marked(exercise, V, part.answer.blank(part.variable))["t_x"]
    assert (verdict.status, verdict.points) == ("missing", 0)


@pytest.mark.parametrize("kind", KINDS)
def test_a_reference_as_code_is_read_back_as_right(kind):
    exercise = one(kind)
    (part,) = exercise.asked
    code = answer_code(part, references(exercise, V)["t_x"])
    assert self_checked(exercise, code) == {"t_x": "ready"}
    verdict = marked(exercise, V, code)["t_x"]
    if kind == "text":
        assert (verdict.status, verdict.answer) == ("not_graded", KINDS[kind][1])
    else:
        assert (verdict.status, verdict.points) == ("correct", part.points)


def test_numbers_as_code_have_nine_decimals_and_no_minus_zero():
    (part,) = one("a vector").asked
    assert (
        answer_code(part, np.array([-1e-12, 1 / 3, -2.0]))
        == "t_x = np.array([ 0.         ,  0.333333333, -2.         ])"
    )
    (part,) = one("one number").asked
    assert answer_code(part, np.array(-0.0)) == "t_x = 0.0"


def test_a_function_as_code_has_the_name_of_its_part():
    (part,) = one("a function").asked
    code = answer_code(part, doubled)
    assert code.startswith('def t_x(x: "Any") -> "Any":\n')
    assert [node.name for node in ast.parse(code).body] == ["t_x"]


@pytest.mark.parametrize(
    ("kind", "value", "words"),
    [
        ("one number", "0.5", "ready"),
        ("one number", "[[0.5]]", "ready"),
        ("one number", "[1, 2]", "takes shape (), got (2,)"),
        ("a vector", "[[1], [2], [3]]", "ready"),
        ("a vector", "[1, 2]", "takes shape (3,), got (2,)"),
        ("a matrix", "np.ones((7, 6)).T", "ready"),
        ("a matrix", "[1, [2]]", "not numbers, or rows of different lengths"),
        ("a stack", "np.full((2, 3, 3), np.inf)", "holds NaN or infinity"),
        ("a table", "[[1, 2, 3]] * 2", "takes 2 rows of theta, d, a, alpha, got rows of [3, 3]"),
        ("a table", "7", "not a table: takes a list of rows"),
        ("one formula", "'l1*cos(q1)'", "ready"),
        ("one formula", "['l1', 'q1']", "takes formulas of shape (), got (2,)"),
        ("a matrix of formulas", "'[[a, b], [c, d]]'", "ready"),
        ("a matrix of formulas", "[['a', 'b']]", "takes formulas of shape (2, 2), got (1, 2)"),
        ("a choice", "'(B) '", "ready"),
        ("a choice", "'d'", "takes one of 'a', 'b', 'c', or the text of an option"),
        ("a choice", "2", "takes one of 'a', 'b', 'c', or the text of an option"),
        ("conditions", "'sin(q2) = 0'", "ready"),
        ("conditions", "[0, 1]", "takes a list of conditions in quotes"),
        ("angles", "0.5", "ready"),
        ("angles", "[0, 3.14]", "ready"),
        ("angles", "'x'", "ready: typed text, read when the sheet is marked"),
        ("configurations", "[[1, 2]]", "ready"),
        ("configurations", "[1, 2, 3]", "takes rows of 2 numbers"),
        ("configurations", "[]", "takes rows of 2 numbers"),
        ("a function", "max", "ready"),
        ("a function", "lambda x: x", "ready"),
        ("a function", "[1, 2]", "takes a function"),
        ("text", "'Because.'", "ready"),
        ("text", "'  '", "not answered yet"),
        ("text", "['a', 'b']", "takes text in quotes"),
    ],
)
def test_the_self_check_says_what_is_there(kind, value, words):
    assert self_checked(one(kind), f"t_x = {value}") == {"t_x": words}


def test_the_self_check_of_a_sheet_names_every_part_but_those_on_paper(exercise):
    asked = [p for p in exercise.asked if not (isinstance(p.answer, Manual) and p.answer.on_paper)]
    blanks = "\n".join(part.answer.blank(part.variable) for part in exercise.asked)
    assert self_checked(exercise, blanks) == {part.variable: "not answered yet" for part in asked}
    assert self_checked(exercise, "") == {part.variable: "not answered yet" for part in asked}


def test_the_references_of_a_sheet_as_code_pass_its_self_check(exercise):
    answers = references(exercise, variant_of(exercise.slug))
    code = "\n".join(answer_code(part, answers[part.variable]) for part in exercise.asked)
    assert set(self_checked(exercise, code).values()) == {"ready"}


def test_filled_in_where_the_blanks_stand_references_earn_full_marks(exercise):
    v = variant_of(exercise.slug, 1)
    answers = references(exercise, v)
    codes = {part.variable: answer_code(part, answers[part.variable]) for part in exercise.asked}
    sheet = notebook(
        "import numpy as np", *(part.answer.blank(part.variable) for part in exercise.asked)
    )
    submission = Submission(Path("one.ipynb"), fill_in(sheet, codes))
    verdicts = mark(exercise, v, submission.raws(submission.asks(exercise, v), Limits()))
    for part, verdict in zip(exercise.asked, verdicts, strict=True):
        assert verdict.part == part.variable
        if isinstance(part.answer, Manual):
            assert verdict.status == "not_graded"
        else:
            assert (verdict.status, verdict.points) == ("correct", part.points)
