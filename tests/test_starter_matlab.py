"""The MATLAB script of a sheet: the student's numbers, a blank per part, and nothing that is not meant to run."""

import re

import numpy as np
import pytest
from courses import BUNDLED, CLASS, files_of, handed_out, make_course
from kinegrade.course.settings.config import CourseError, Sheet, Student
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.matlab import literal, starter
from kinegrade.exercises.answers import (
    Choice,
    Conditions,
    Configurations,
    Formulas,
    Function,
    Manual,
)
from kinegrade.exercises.exercise import Exercise, Numbers, Part, TableOf
from kinegrade.exercises.files.finding import exercise_files, find

ADA = Student("ada", "Ada Lovelace")
CODE = re.compile(
    r"[A-Za-z]\w* = .*;  %.*|\w+ = \S.*;|\w+ = [\[{].* \.\.\.|    .*|\};|save\(.*", re.ASCII
)


def sheet(name="one"):
    return Sheet(name=name, title="Sheet one", exercises=("x",), matlab=True)


def exercise(*answers, statement="A plain question.", units=None, title="Title", prompt="A prompt"):
    checks = [
        (lambda *_: None) if isinstance(answer, Configurations) else None for answer in answers
    ]
    parts = tuple(
        Part(f"ex_{i}", prompt, 2, answer, lambda *_: None, check=check)
        for i, (answer, check) in enumerate(zip(answers, checks, strict=True))
    )
    return Exercise(
        slug="ex", title=title, source="tests", draw=lambda _: {}, parts=parts, statement=lambda _: statement,
        units=units or {}, scale=lambda _: 1.0,
    )  # fmt: skip


def script(*answers, v=None, student=ADA, **more):
    return starter("Course", sheet(), student, [Assignment(exercise(*answers, **more), v or {})])


@pytest.mark.parametrize(
    ("answer", "line"),
    [
        (Numbers((6, 3)), "ex_0 = [];  % 6 x 3 numbers, linear rows above angular; 4 decimals"),
        (Numbers((6,), "N m"), "ex_0 = [];  % 6 numbers; 4 decimals"),  # torques of six joints
        (
            Numbers((6,), ["N"] * 3 + ["N m"] * 3),
            "ex_0 = [];  % 6 numbers, linear rows above angular; 4 decimals",
        ),
        (Numbers((3,), decimals=2), "ex_0 = [];  % 3 numbers; 2 decimals"),
        (Numbers(()), "ex_0 = [];  % one number; 4 decimals"),
        (
            Numbers((3, 4, 4)),
            "ex_0 = {};  % 3 matrices of 4 x 4 numbers: {first, second, ...}; 4 decimals",
        ),
        (
            TableOf(("d1",), "RRP"),
            "ex_0 = {};  % 3 rows theta, d, a, alpha, such as {'q1 + pi', 0.25, 'd1', 'pi/3'; ...}",
        ),
        (
            Formulas((2, 2), ("l1",)),
            "ex_0 = '';  % 2 x 2 formulas as text: '...', or char(...) of a symbolic matrix",
        ),
        (
            Formulas((), ("l1",)),
            "ex_0 = '';  % a formula as text: '...', or char(...) of a symbolic one",
        ),
        (Choice(("yes", "no")), "% a: yes\n% b: no\nex_0 = '';  % one of a, b"),
        (
            Conditions(("q1",), lambda _: {}),
            "ex_0 = {''};  % equations, such as {'sin(q1) = 0', 'q2 = q3'}",
        ),
        (
            Configurations(2, in_order=True),
            "ex_0 = [];  % a row of 2 numbers for every step, in their order; 4 decimals",
        ),
        (Configurations(3), "ex_0 = [];  % a row of 3 numbers for every configuration; 4 decimals"),
        (
            Manual(((2.0, "a line"),)),
            "ex_0 = '';  % your text; ['first line' newline 'second line'] has two lines",
        ),
        (
            Function("(q)", lambda _: {}),
            "ex_0 = {};  % a Python function ex_0(q): hand in the notebook",
        ),
    ],
)
def test_every_kind_of_answer_has_its_blank(answer, line):
    text = script(answer)
    assert f"\n% ex_0 (2 points): A prompt.\n{line}\n" in text
    assert text.endswith("save('one.mat', ...\n    'ex_0', ...\n    '-v7')\n")


def test_what_is_declared_beside_an_answer_has_a_line_and_is_saved():
    text = script(TableOf(("d1",), "RRP", "either"))
    assert "\nex_0_convention = 'standard';  % or 'modified'\nex_0 = {};" in text
    assert text.endswith(
        "save('one.mat', ...\n    'ex_0_convention', ...\n    'ex_0', ...\n    '-v7')\n"
    )


def test_what_is_done_on_paper_is_not_saved():
    text = script(Manual(((2.0, "a line"),), on_paper=True), Numbers((2,)))
    assert "On paper" in text
    assert "ex_0 =" not in text
    assert text.endswith("save('one.mat', ...\n    'ex_1', ...\n    '-v7')\n")


def test_a_function_comes_with_the_inputs_whose_results_are_handed_in():
    calls = {
        "planar": [([0.5, -1.0], "RR"), ([[1.0, 2], [3, 4]], "it's")],
        "other": [(np.eye(2), 3)],
    }
    text = script(Function("(q, kinds)", lambda _: {}, published=lambda _: calls))
    assert (
        "% Results of ex_0(q, kinds) for the arguments in each cell of ex_0_inputs:\n"
        "ex_0_inputs = { ...\n"
        "    {[0.5, -1.0], 'RR'}; ...\n"
        "    {[1.0, 2; 3, 4], 'it''s'}; ...\n"
        "    {[1.0, 0.0; 0.0, 1.0], 3}; ...\n"
        "};\n"
        "ex_0 = cell(1, 3);  % ex_0{k} = result for ex_0_inputs{k}{:}\n"
    ) in text


def test_an_argument_that_is_a_dict_has_a_line_for_every_field():
    arm = {"kinds": ["R", "P"], "a": [0.123456789] * 3, "alpha": [0.5] * 3}
    text = script(
        Function("(arm, q)", lambda _: {}, published=lambda _: {"yours": [(arm, [0.5, 1.0])]})
    )
    assert (
        "ex_0_inputs = { ...\n"
        "    {struct('kinds', {{'R', 'P'}}, ...\n"
        "    'a', [0.123456789, 0.123456789, 0.123456789], ...\n"
        "    'alpha', [0.5, 0.5, 0.5]), ...\n"
        "    [0.5, 1.0]}; ...\n"
        "};\n"
    ) in text


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (0.5, "0.5"),
        (-3, "-3"),
        (1e-7, "1e-07"),
        (float("inf"), "Inf"),
        (-float("inf"), "-Inf"),
        (float("nan"), "NaN"),
        (True, "true"),
        (None, "[]"),
        ("RRP", "'RRP'"),
        ("it's", "'it''s'"),
        ("a\nb", "['a', 10, 'b']"),
        ("", "''"),
        ([], "[]"),
        ([1.0, 2.5], "[1.0, 2.5]"),
        ([[1, 2], [3, 4]], "[1, 2; 3, 4]"),
        ([[1, 2], [3]], "{[1, 2], [3]}"),
        (["a", 1], "{'a', 1}"),
        ([[[1, 2]], [[3, 4]]], "{[1, 2], [3, 4]}"),
        (np.eye(2), "[1.0, 0.0; 0.0, 1.0]"),
        ({}, "struct()"),
        ({"a": [0.1, 0.2], "n": 2}, "struct('a', [0.1, 0.2], 'n', 2)"),
        (
            {"kinds": ["R", "P"]},
            "struct('kinds', {{'R', 'P'}})",
        ),  # one pair of braces would make two structures
        ([{"a": 1}, {"a": 2}], "{struct('a', 1), struct('a', 2)}"),
        ({"tool": {"p": [0.5]}}, "struct('tool', struct('p', [0.5]))"),
    ],
)
def test_drawn_values_are_written_as_matlab_reads_them(value, expected):
    assert literal(value) == expected


def test_a_value_that_matlab_has_no_word_for_is_refused():
    with pytest.raises(CourseError, match=r"takes numbers, text, lists and dicts, got \(1\+2j\)"):
        literal([1 + 2j])
    with pytest.raises(CourseError, match="takes names of MATLAB, such as 'kinds', got 'a b'"):
        literal({"a b": 1})


def test_numbers_have_the_names_and_units_of_the_notebook():
    v = {"d1": 0.5, "q": [0.1, -0.2], "hidden": 3}
    text = script(Numbers((2,)), v=v, units={"d1": "m", "q": ["rad", "m"], "a1": "m"})
    assert "\nex_d1 = 0.5;  % [m]\nex_q = [0.1, -0.2];  % [rad, m]\n" in text
    assert "hidden" not in text
    assert "ex_a1" not in text


def test_a_matrix_that_is_too_long_for_a_line_has_a_line_for_every_row():
    row = [0.123456 + i for i in range(9)]
    shown = ", ".join(map(repr, row))
    text = script(Numbers((2,)), v={"J": [row, row, row]}, units={"J": "m"})
    assert f"\nex_J = [{shown}; ...\n    {shown}; ...\n    {shown}];  % [m]\n" in text
    function = Function(
        "(J, kinds)",
        lambda _: {},
        published=lambda _: {"one": [([row, row], "R; P"), ([1.0], "R")]},
    )
    assert (
        "ex_0_inputs = { ...\n"
        f"    {{[{shown}; ...\n    {shown}], ...\n    'R; P'}}; ...\n"
        "    {[1.0], 'R'}; ...\n};\n"
    ) in script(function)


def test_a_statement_with_formulas_is_left_to_the_notebook():
    assert "% A plain question.\n" in script(Numbers((2,)))
    text = script(Numbers((2,)), statement=r"With $\mathbf q$ and | tables.", prompt="At $q$")
    assert "% The question: one.ipynb, number and title as here." in text
    assert "% ex_0 (2 points)\n" in text
    assert "mathbf" not in text


@pytest.mark.parametrize(
    "breaker", ["\n", "\r", "\r\n", "\x0b", "\x0c", "\x85", "\u2028", "\u2029", "\x00", "\x1b"]
)
def test_no_name_or_title_breaks_out_of_its_comment(breaker):
    evil = f"A{breaker}delete('x') %{{ {breaker}%}}{breaker}"
    text = script(
        Choice((evil,)), Function(f"(q{breaker}) x", lambda _: {}), student=Student("ada", evil), title=evil,
        statement=evil, prompt=evil, units={"d": "m"}, v={"d": evil},
    )  # fmt: skip
    lines = re.split(r"[\n\r\x0b\x0c\x85\u2028\u2029]", text)
    assert [
        line for line in lines if line and not line.startswith("%") and not CODE.fullmatch(line)
    ] == []
    assert not any(line.strip() in ("%{", "%}") for line in lines)
    assert "\x00" not in text
    assert "\x1b" not in text


def test_a_name_that_matlab_does_not_take_is_refused():
    long = Exercise(
        **{
            **vars(exercise(Numbers((2,)))),
            "parts": (Part("ex_" + "x" * 64, "P", 1, Numbers((2,)), print),),
        }
    )
    with pytest.raises(CourseError, match="is no name in MATLAB"):
        starter("Course", sheet(), ADA, [Assignment(long, {})])


@pytest.mark.parametrize("slug", BUNDLED)
def test_our_exercises_have_a_script_of_code_and_comments(slug):
    found = find(slug, exercise_files())
    text = starter(
        "Course", sheet(), ADA, [Assignment(found, found.draw(np.random.default_rng(1)))]
    )
    assert [
        line for line in text.splitlines() if line and line[0] != "%" and not CODE.fullmatch(line)
    ] == []
    assert max(map(len, text.splitlines())) <= 120
    for part in found.asked:
        assert f"\n{part.variable} = " in text
        assert f"    '{part.variable}', ...\n" in text


def test_a_sheet_with_matlab_releases_a_script_once(tmp_path):
    make_course(tmp_path)
    handed_out(tmp_path)
    before = files_of(tmp_path / "released")
    assert not any(path.endswith(".m") for path in before)
    settings = tmp_path / "course.toml"
    settings.write_text(settings.read_text(encoding="utf-8") + "matlab = true\n", encoding="utf-8")
    handed_out(tmp_path)
    after = files_of(tmp_path / "released")
    assert {path: data for path, data in after.items() if not path.endswith(".m")} == before
    assert {path for path in after if path.endswith(".m")} == {
        f"{student}/one.m" for student, _ in CLASS
    }
    assert b"lever_L = " in after["ada/one.m"]
    (tmp_path / "released" / "ada" / "one.m").write_bytes(b"% my own\n")
    (tmp_path / "released" / "ben" / "one.m").unlink()
    handed_out(tmp_path)
    assert files_of(tmp_path / "released") == after | {"ada/one.m": b"% my own\n"}
