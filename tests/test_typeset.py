"""From Markdown with LaTeX to what a Typst template sets: formulas, their words, blocks of prose."""

import re

import pytest
from kinegrade.course.language.speech import speaking
from kinegrade.course.typeset.formula import formula
from kinegrade.course.typeset.mathml import FormulaError
from kinegrade.course.typeset.prose import line, prose
from typst import Compiler

COMPILER = Compiler(ignore_system_fonts=True)
PAGE = b'#set document(title: "x")\n#math.equation(alt: "x", eval(sys.inputs.math, mode: "math"))'

LATEX = (
    r"\mathbf T_0^{i} = \mathbf T_0^1 \cdots \mathbf T_{i-1}^{i}",
    r"\dot{\mathbf q} = \mathbf J^{+} \boldsymbol\xi",
    r"\left(\frac{a}{b}\right)^2 \le \sqrt{1 + \sqrt[3]{x}}",
    r"\begin{bmatrix} 0.1 & -2 \\ & \pi \end{bmatrix} \begin{pmatrix} a \\ b \end{pmatrix}",
    r"\begin{cases} a & x > 0 \\ b & \text{else} \end{cases}",
    r"\|x\| + |y| + \{1, 2; 3\} + f'(x) + \hat a \bar b \vec c \tilde d \ddot e",
    r"\sum_{i=1}^n \underbrace{x_i}_{all} \in \mathbb R, \quad \operatorname{rank} \mathbf J = 6 \%",
    r"\# \$ \& \_ < > / \text{a \"quoted\" #let x = 1}",
)


@pytest.mark.parametrize("latex", LATEX)
def test_typst_takes_what_the_printer_writes(latex):
    assert COMPILER.compile(PAGE, sys_inputs={"math": formula(latex).typst}, pdf_standards=["ua-1"])


@pytest.mark.parametrize(
    ("latex", "typst"),
    [
        ("q_1", "attach(q, b: 1)"),
        (r"\mathbf J", "bold(upright(J))"),
        (r"\boldsymbol\omega", "bold(ω)"),
        (r"0.5\,\mathrm{m/rad}", '0.5 thin "m/rad"'),
        (r"2\,\mathrm{m}", '2 thin "m"'),
        (r"\left(a\right)", r"lr(\( a \))"),
        (r"\begin{bmatrix} 1 \\ -2 \end{bmatrix}", 'mat(delim: "[", align: #right, 1; − 2)'),
        (r"\begin{bmatrix} a & b \end{bmatrix}", 'mat(delim: "[", align: #center, a, b)'),
        ("#x", r"\# x"),
    ],
)
def test_a_formula_in_typst(latex, typst):
    assert formula(latex).typst == typst


@pytest.mark.parametrize(
    ("latex", "words"),
    [
        (r"\dot q_1 = -0.5\,\mathrm{rad/s}", "q dot sub 1 equals minus 0.5 rad per s"),
        (r"\mathbf T_0^{2}", "T sub 0 super 2"),
        (r"\mathbf{q}", "q"),
        ("x^2", "x squared"),
        (r"\mathbf z^{2}", "z super 2"),
        (
            r"\begin{bmatrix} 1 & 2 \\ 3 & 4 \end{bmatrix}",
            "2 by 2 matrix, row 1: 1, 2; row 2: 3, 4;",
        ),
        (r"\frac{\pi}{2}", "(π) over (2)"),
        (r"\sqrt{a + b}", "the square root of (a plus b)"),
    ],
)
def test_a_formula_in_words(latex, words):
    assert formula(latex).alt == words


@pytest.mark.parametrize(
    ("latex", "words"),
    [
        (r"\dot q_1 = -\frac{1}{x^2}", "q Punkt Index 1 gleich minus (1) durch (x Quadrat)"),
        (r"\mathbf T_0^{2}", "T Index 0 hoch 2"),
        (
            r"\begin{bmatrix} 1 & 2 \\ 3 & 4 \end{bmatrix}",
            "2-mal-2-Matrix, Zeile 1: 1, 2; Zeile 2: 3, 4;",
        ),
    ],
)
def test_a_formula_in_the_words_of_a_german_sheet(latex, words):
    english = formula(latex).alt
    with speaking("de"):
        assert formula(latex).alt == words
    assert formula(latex).alt == english


@pytest.mark.parametrize(
    ("latex", "words"),
    [
        (r"\foo x", r"the command \foo in $\foo x$ is unknown"),
        (r"\mathfrak{J}_\nope", r"the command \nope"),
        (r"\begin{bmatrix} 1", "cannot be read as LaTeX"),
    ],
)
def test_what_is_unknown_is_named(latex, words):
    with pytest.raises(FormulaError, match=re.escape(words)):
        formula(latex)


def test_formulas_side_by_side_can_stand_below_each_other():
    found = formula(r"a = \begin{bmatrix} 1 \\ 2 \\ 3 \end{bmatrix},\quad b = 2")
    assert [piece.typst for piece in found.pieces] == [
        'a \\= mat(delim: "[", align: #right, 1; 2; 3) \\,',
        "b \\= 2",
    ]
    assert (found.rows, found.breakable) == (3, False)
    assert formula("a + b").breakable


def test_prose_is_data():
    blocks = prose(
        "The **right** `code` of $x$:\n\n- *one*\n- two\n\n| $i$ | b |\n|--|--|\n| 1 | 2 |"
    )
    assert [block["kind"] for block in blocks] == ["paragraph", "list", "table"]
    the, strong, _, code, _, math, colon = blocks[0]["inline"]
    assert (the, strong, code, colon) == ("The ", {"strong": ["right"]}, {"code": "code"}, ":")
    assert math["math"] == "x"
    assert blocks[1]["items"][0] == [{"kind": "paragraph", "inline": [{"emph": ["one"]}]}]
    assert blocks[2]["rows"] == [[["1"], ["2"]]]


def test_markup_of_typst_in_a_text_stays_text():
    typed = "#panic() @x <y> _z_ = \\ #"
    assert "".join(
        part if isinstance(part, str) else "z" for part in line(typed.replace("<y> ", ""))
    ) == (typed.replace("<y> ", "").replace("_z_", "z"))


def test_a_formula_that_stands_alone_ends_a_paragraph_and_takes_its_point():
    before, displayed, after = prose("Thus $$x = 1$$. Then.")
    assert (before["inline"], after["inline"]) == (["Thus "], ["Then."])
    assert displayed["math"] == r"x \= 1 \."


def test_a_tall_matrix_within_a_line_stands_alone():
    (text, matrix) = prose(r"This is $\begin{bmatrix} 1 \\ 2 \\ 3 \end{bmatrix}$.")
    assert (text["kind"], matrix["kind"]) == ("paragraph", "formula")
    (paragraph,) = prose(r"This is $\begin{bmatrix} 1 \\ 2 \end{bmatrix}$.")
    assert paragraph["kind"] == "paragraph"


@pytest.mark.parametrize("text", ["# Heading", "<b>bold</b>", "![x](y.png)", "> said"])
def test_markup_that_no_sheet_has_is_refused(text):
    with pytest.raises(FormulaError):
        prose(text)
