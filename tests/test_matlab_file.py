"""A MATLAB script is read and never run: what is typed counts, what is computed says how to hand it in."""

from pathlib import Path

import numpy as np
import pytest
from answers import EXERCISES, SLUGS, variant_of
from kinegrade.course.settings.config import Sheet, Student
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.matlab import starter
from kinegrade.course.sheet.matlab_literal import literal
from kinegrade.course.sheet.submissions import Submission
from kinegrade.exercises.exercise import Formulas, Function, Manual, TableOf, references
from kinegrade.grader.collecting.ask import Ask, Limits
from kinegrade.grader.collecting.matlab_file import MAX_BYTES, from_m
from kinegrade.grader.marking.mark import mark


def read(text, *calls):
    return from_m(text if isinstance(text, bytes) else text.encode(), [Ask("x", calls)])["x"]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("x = 0.5;", 0.5),
        ("x=-.5", -0.5),
        ("x = 1e-3 % small", 0.001),
        ("x = [1 2; 3 4];", [[1, 2], [3, 4]]),
        ("x = [1, -2\n 3, 4]", [[1, -2], [3, 4]]),
        ("x = [1 -2; +3 4];", [[1, -2], [3, 4]]),
        ("x = [ ... first\n 1 2 % a comment; with 3 4\n 3 4 ];", [[1, 2], [3, 4]]),
        ("x = [1 2\n\n 3 4;\n];", [[1, 2], [3, 4]]),
        ("x = [1; 2; 3]';", [[1, 2, 3]]),
        ("x = [1 2 3].';", [[1], [2], [3]]),
        ("x = [[1 2]; [3 4]];", [[1, 2], [3, 4]]),
        ("x = [[1; 3] [2; 4]];", [[1, 2], [3, 4]]),
        ("x = {[1 0; 0 1], [2 0; 0 2]};", [[[1, 0], [0, 1]], [[2, 0], [0, 2]]]),
        ("a = [3 3]'; x = [1 2]; b = a';", [[1, 2]]),
        ("x = [9 9];\nx = [1 2];", [[1, 2]]),
        ("%{\nx = [9 9];\n%}\nx = [1 2];", [[1, 2]]),
        ("disp('x = 5'), x = [1 2];\r\ny = x * 2;\r\n", [[1, 2]]),
        ("if true\n y = 1;\nend\nx = [1 2];", [[1, 2]]),
        ("x = [1 2]; if x(end) == 2, y = 3; end", [[1, 2]]),
        ("\ufeffx = [1 2]; % \u00e9", [[1, 2]]),
        ("x = [1 2]; % \u00e9".encode("cp1252"), [[1, 2]]),
    ],
)
def test_numbers_are_read_as_matlab_means_them(text, value):
    raw = read(text)
    assert raw.kind == "num", raw
    assert raw.value.tolist() == value


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("x = pi/2;", "pi/2"),
        ("x = [sqrt(2)/2 0.5*cos(pi/4)]", [["sqrt(2)/2", "0.5*cos(pi/4)"]]),
        ("x = [2.^2, -sin(0.3) ]", [["2.^2", "-sin(0.3)"]]),
        ("x = [3 - 1, 4]", [["3-1", "4.0"]]),
        ("x = 'l1*sin(q1)';", "l1*sin(q1)"),
        ('x = "it\'s ""b""";', 'it\'s "b"'),
        ("x = 'it''s';", "it's"),
        ("x = ['first ' newline 'second', 10, '%3'];", "first \nsecond\n%3"),
        ("x = {'q1 + pi', 0.25; 'd1', pi/3};", [["q1 + pi", "0.25"], ["d1", "pi/3"]]),
        ("x = {{'q1', 0}, {'d1', 1}};", [["q1", "0.0"], ["d1", "1.0"]]),
        ("x = {'sin(q1) = 0', 'q2 = q3'};", [["sin(q1) = 0", "q2 = q3"]]),
    ],
)
def test_text_and_formulas_are_read_as_they_were_typed(text, value):
    raw = read(text)
    assert raw.kind == "text", raw
    assert raw.value == value


@pytest.mark.parametrize(
    "text", ["", "x = [];", "x = '';", "x = {};", "x = {''};", "y = 3;", "% x = 3", "x == 3"]
)
def test_what_is_empty_or_not_there_is_missing(text):
    assert read(text).kind == "missing"


@pytest.mark.parametrize(
    "text",
    [
        "x = A * B;",
        "x = [l1*cos(q1) 0];",
        "x = jacobian(q);",
        "x = [1 2; 3 4] * 2;",
        "x = zeros(3);",
        "x = cell(1, 3);",
        "x = [1 2];\nx(1) = 3;",
        "x = {};\nx{2} = 3;",
        "[x, y] = size(A);",
        "for k = 1:3\n x = 3;\nend",
        "if true, x = 3; end",
        "function x = f(q)\n x = 3;\nend",
        "function J = x(q)\n J = 3;",
        "x = [1 2; 3 4](1);",
        "x = @(q) q;",
        "x = y';",
        "x = 1:3;",
        "x = [1 2 [3; 4]];",
        "x = ]",
        "x =",
        "x = [",
        "x = " + "[" * 50 + "1" + "]" * 50,
    ],
)
def test_what_is_computed_says_in_which_line_and_how_to_hand_it_in(text):
    raw = read("% a\n" + text)
    assert raw.kind == "error", raw
    line = 2 + text[: text.rindex("x")].count("\n") if "for" not in text else 3
    assert f"x is computed in line {line}, and MATLAB is not run" in raw.value
    assert "save('answers.mat', 'x', '-v7')" in raw.value


def test_an_unfinished_transpose_or_a_large_file_stops_nothing():
    assert read("y = 'open\nx = 2;").value == 2
    assert "hand in a .mat file" in read(b" " * (MAX_BYTES + 1)).value
    assert read("x = " + "(" * 5000 + "\n").kind == "text"  # which is refused where it is read
    assert read("x = " + "[" * 5000 + "\n").kind == "error"


def test_results_of_calls_are_the_cells_in_their_order():
    raw = read("x = {[1 2], 3};", (1.0,), (2.0,))
    assert raw.listed
    assert [result.value.tolist() for result in raw.value] == [[[1, 2]], 3]


def script(exercise, answers):
    return "\n".join(f"{name} = {literal(value)};" for name, value in answers.items()).encode()


def as_matlab(part, value, v):
    """An answer as it is typed in MATLAB; None for what a file cannot hold."""
    answer = part.answer
    if isinstance(answer, Function):
        calls = answer.published_calls(v)
        return [value(*call) for call in calls] if calls else None
    if isinstance(answer, TableOf):
        return [[str(cell) for cell in row] for row in value.rows]
    if isinstance(answer, Formulas):
        return value.text()
    if isinstance(value, tuple):
        return [f"{entry} = 0" for entry in value]
    return value


@pytest.mark.parametrize("slug", SLUGS)
def test_right_answers_of_every_exercise_are_read_from_a_script(slug):
    exercise, v = EXERCISES[slug], variant_of(slug)
    given = references(exercise, v)
    typed = {}
    for part in exercise.asked:
        value = as_matlab(part, given[part.variable], v)
        if value is not None:
            typed[part.variable] = value
    submission = Submission(Path("one.m"), script(exercise, typed))
    raws = submission.raws(submission.asks(exercise, v), Limits())
    for part, verdict in zip(exercise.asked, mark(exercise, v, raws), strict=True):
        if part.variable in typed and not isinstance(part.answer, Manual):
            assert verdict.points == part.points, (part.variable, verdict)


@pytest.mark.parametrize("slug", SLUGS)
def test_a_script_as_it_was_handed_out_holds_no_answer_and_nothing_that_is_wrong(slug):
    exercise, v = EXERCISES[slug], variant_of(slug)
    sheet = Sheet(name="one", exercises=(slug,), matlab=True)
    text = starter("Course", sheet, Student("ada", "Ada"), [Assignment(exercise, v)])
    submission = Submission(Path("one.m"), text.encode())
    raws = submission.raws(submission.asks(exercise, v), Limits())
    functions = [part.variable for part in exercise.asked if isinstance(part.answer, Function)]
    for name, raw in raws.items():
        if name not in functions and not name.endswith("_convention"):
            assert raw.kind == "missing", (name, raw)
    assert np.all([raw.kind for raw in raws.values()])
