"""Sheets as notebooks: valid, the same bytes every time, runnable as handed out, and without an answer in them."""

import json
import re
from contextlib import redirect_stdout
from io import StringIO

import nbformat
import numpy as np
import pytest
from answers import EXERCISES, variant_of
from courses import BUNDLED, lever, sheet
from kinegrade.course.blanks import answer_code, self_check
from kinegrade.course.config import Student
from kinegrade.course.notebook import given_cell, notebooks
from kinegrade.exercises.exercise import Numbers, references
from kinegrade.grader.collect import Ask, collect
from kinegrade.grader.mark import mark
from kinegrade.solutions.table import Table
from markdown_it import MarkdownIt
from nbclient import NotebookClient

ADA = Student("ada", "Ada Lovelace")
NASTY = (
    "<script>alert(1)</script>",
    "<img src=x onerror=alert(1)>",
    "**bold** _it_ `code`",
    "[click](javascript:alert(1))",
    "![x](http://example.org/x.png)",
    "$\\input{/etc/passwd}$ \\(x\\) $$x$$",
    "&lt;b&gt; &#42; | a | b |",
    "~~gone~~ # heading",
    "=SUM(A1:A9)",
    "***",
    "a\x1b[31mred\u202etxt",
)


def both(exercises, mode="graded", student=ADA, seed=0):
    pairs = [(exercise, variant_of(exercise.slug, seed)) for exercise in exercises]
    return notebooks("Tests", sheet(mode, tuple(e.slug for e in exercises)), student, pairs)


def quick(tmp_path, **options):
    """Both notebooks of the exercise without figures."""
    pairs = [(lever(tmp_path), {"L": 0.75, "q": [0.3]})]
    return notebooks("Tests", sheet(options.get("mode", "graded"), ("lever",)), options.get("student", ADA), pairs)


def sources(notebook, kind="code"):
    return ["".join(cell["source"]) for cell in json.loads(notebook)["cells"] if cell["cell_type"] == kind]


def test_both_notebooks_are_valid_and_the_same_bytes_every_time(exercise):
    first, second = both([exercise]), both([exercise])
    assert first == second
    for written in first:
        nbformat.validate(nbformat.reads(written.decode(), 4))
        ids = [cell["id"] for cell in json.loads(written)["cells"]]
        assert len(set(ids)) == len(ids)
        assert written.endswith(b"}\n")


def test_a_sheet_as_handed_out_runs_from_top_to_bottom_in_jupyter(bundled_course):
    path = bundled_course.folder / "released" / "ada" / "one.ipynb"
    notebook = nbformat.read(path, 4)
    NotebookClient(notebook, timeout=None, resources={"metadata": {"path": str(path.parent)}}).execute()
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(cell.execution_count for cell in code)
    assert [output for cell in code[:-1] for output in cell.outputs] == []
    said = "".join(output.text for output in code[-1].outputs)
    asked = [part.variable for slug in BUNDLED for part in EXERCISES[slug].asked]
    assert [line.split()[0] for line in said.splitlines()] == asked
    assert said.count("not answered yet") == len(asked)


def test_a_sheet_as_handed_out_is_not_answered(bundled_course):
    written = (bundled_course.folder / "released" / "ada" / "one.ipynb").read_bytes()
    asked = [Ask(part.variable) for slug in BUNDLED for part in EXERCISES[slug].asked]
    assert {raw.kind for raw in collect(written, asked).values()} == {"missing"}


def test_the_worked_solution_earns_full_marks(exercise):
    _, solution = both([exercise], seed=2)
    raws = collect(solution, [Ask(part.variable) for part in exercise.asked])
    verdicts = mark(exercise, variant_of(exercise.slug, 2), raws)
    assert {verdict.status for verdict in verdicts} == {"correct"}


def test_a_worked_solution_is_marked_as_one_and_has_no_numbers_for_a_check(exercise):
    handout, solution = both([exercise])
    assert "**Worked solution, for the instructor.**" in sources(solution, "markdown")[0]
    assert "solution" not in sources(handout, "markdown")[0]
    assert "numbers" not in json.loads(solution)["metadata"]["kinegrade"]


def test_a_handed_out_sheet_holds_no_answer(exercise):
    v = variant_of(exercise.slug)
    handout, solution = both([exercise])
    texts = [re.sub(r"data:image/[^\"]+", "", written.decode()) for written in (handout, solution)]
    answers = [references(exercise, v)[part.variable] for part in exercise.asked]
    values = {abs(x) for answer in answers if not isinstance(answer, Table) for x in answer.ravel()}
    drawn = {round(abs(x), 3) for value in v.values() for x in (value if isinstance(value, list) else [value])}
    telling = [f"{x:.3f}"[:-1] for x in values if abs(x - round(x, 2)) > 1e-6 and round(x, 3) not in drawn]
    assert len(telling) > 3
    assert [text for text in telling if text in texts[0] and len(text) > 5] == []
    assert any(text in texts[1] for text in telling)


def test_what_a_check_needs_stands_in_the_metadata(tmp_path):
    handout, _ = quick(tmp_path)
    about = json.loads(handout)["metadata"]["kinegrade"]
    assert about == {
        "sheet": "one",
        "student": "ada",
        "mode": "graded",
        "exercises": ["lever"],
        "numbers": {"lever": {"L": 0.75, "q": [0.3]}},
    }


@pytest.mark.parametrize(("mode", "hinted"), [("practice", True), ("graded", True), ("exam", False)])
def test_an_exam_has_no_hints(mode, hinted):
    handout, solution = both([EXERCISES["rrt"]], mode)
    assert (b"<details>" in handout) is hinted
    assert b"<details>" not in solution


def test_every_part_has_a_blank_of_its_own_and_its_points(exercise):
    handout, _ = both([exercise])
    for part in exercise.asked:
        assert sum(source.startswith(f"{part.variable} = ...") for source in sources(handout)) == 1
        assert any(
            text.startswith(f"**`{part.variable}`** ({part.points:g} point") for text in sources(handout, "markdown")
        )
    total = sum(part.points for part in exercise.asked)
    assert f"{total:g} points" in sources(handout, "markdown")[0]


@pytest.mark.parametrize("name", NASTY)
def test_a_name_comes_out_as_text_whatever_it_holds(tmp_path, name):
    handout, _ = quick(tmp_path, student=Student("ada", name))
    heading = sources(handout, "markdown")[0]
    plain = sources(quick(tmp_path)[0], "markdown")[0]
    render = MarkdownIt("commonmark", {"html": True}).enable(["table", "strikethrough"]).render
    assert re.findall("<[^>]*>", render(heading)) == re.findall("<[^>]*>", render(plain))
    assert not set("$\\\x1b\u202e") & set(heading)
    assert "\n\nTests · sheet `one` · **" in heading


def test_an_ordinary_name_is_printed_as_it_is(tmp_path):
    handout, _ = quick(tmp_path, student=Student("ada", "Zoë O'Brien-Çelik, Jr. (李)"))
    assert "**Zoë O'Brien-Çelik, Jr. (李)** (`ada`)" in sources(handout, "markdown")[0]


def test_the_given_cell_sets_every_printed_number_exactly(exercise):
    v = variant_of(exercise.slug)
    scope = {"np": np}
    exec(given_cell(exercise, v), scope)  # noqa: S102
    printed = [name for name in exercise.units if name in v]
    assert printed
    for name in printed:
        np.testing.assert_array_equal(scope[f"{exercise.slug}_{name}"], v[name])


def test_the_given_cell_names_the_units(exercise):
    lines = given_cell(exercise, variant_of(exercise.slug)).splitlines()
    assert all(re.search(r"# \[[^\]]+\]$", line) for line in lines[1:])


def test_an_answer_as_code_is_the_answer(exercise):
    v = variant_of(exercise.slug)
    for name, answer in references(exercise, v).items():
        part = next(part for part in exercise.parts if part.variable == name)
        scope = {"np": np}
        exec(answer_code(part, answer), scope)  # noqa: S102
        if isinstance(part.answer, Numbers):
            np.testing.assert_allclose(scope[name], answer, rtol=0, atol=6e-10)
        else:
            assert scope[name] == [[str(cell) for cell in row] for row in answer.rows]


def checked(exercise, code):
    scope, out = {"np": np}, StringIO()
    with redirect_stdout(out):
        exec(f"{code}\n{self_check(exercise.asked)}", scope)  # noqa: S102
    return dict(line.split(None, 1) for line in out.getvalue().splitlines())


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("...", "not answered yet"),
        ("[1.0, 2.0]", "ready"),
        ("np.ones((2, 2))", "takes shape (2,), got (2, 2)"),
        ("'x'", "not numbers, or rows of different lengths"),
        ("{}", "not numbers, or rows of different lengths"),
        ("[1, [2]]", "not numbers, or rows of different lengths"),
        ("[1, np.nan]", "holds NaN or infinity"),
    ],
)
def test_the_self_check_says_what_is_there(tmp_path, value, words):
    found = checked(lever(tmp_path), f"lever_p = {value}")
    assert found == {"lever_p": words, "lever_J": "not answered yet"}


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("[['q1', 0, 0, 0]] * 3", "ready"),
        ("np.zeros((3, 4))", "ready"),
        ("[['q1', 0, 0, 0]] * 2", "takes 3 rows of theta, d, a, alpha, got rows of [4, 4]"),
        ("[1, 2, 3]", "takes 3 rows of theta, d, a, alpha, got rows of [0, 0, 0]"),
    ],
)
def test_the_self_check_reads_a_table(value, words):
    assert checked(EXERCISES["rrt"], f"rrt_dh = {value}")["rrt_dh"] == words


def test_figures_are_inside_the_notebook_with_alternative_text():
    handout, _ = both([EXERCISES["rrt"]])
    images = re.findall(r"<img [^>]*>", "\n".join(sources(handout, "markdown")))
    assert images
    assert all(re.search(r'src="data:image/png;base64,[^"]+" alt="[^"]{20,}"', image) for image in images)
