"""Sheets as notebooks: valid, the same bytes every time, runnable as handed out, and without an answer in them."""

import ast
import json
import re
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import nbformat
import numpy as np
import pytest
from answers import EXERCISES, flat, telling, variant_of
from courses import BUNDLED, exercise_of, lever, sheet
from kinegrade.course.commands.demo import fill_in
from kinegrade.course.settings.config import Student
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.given import given_cell, given_form, printed
from kinegrade.course.sheet.notebook import notebooks
from kinegrade.course.sheet.self_check import self_check
from kinegrade.course.sheet.submissions import Submission
from kinegrade.exercises.exercise import Choice, Manual, Part, references
from kinegrade.grader.collecting.ask import Limits
from kinegrade.grader.marking.mark import mark
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
    pairs = [Assignment(exercise, variant_of(exercise.slug, seed)) for exercise in exercises]
    return notebooks("Tests", sheet(mode, tuple(e.slug for e in exercises)), student, pairs)


def quick(tmp_path, **options):
    """Both notebooks of the exercise without figures."""
    pairs = [Assignment(lever(tmp_path), {"L": 0.75, "q": [0.3]})]
    return notebooks(
        "Tests",
        sheet(options.get("mode", "graded"), ("lever",)),
        options.get("student", ADA),
        pairs,
    )


def sources(notebook, kind="code"):
    return [
        "".join(cell["source"])
        for cell in json.loads(notebook)["cells"]
        if cell["cell_type"] == kind
    ]


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
    NotebookClient(
        notebook, timeout=None, resources={"metadata": {"path": str(path.parent)}}
    ).execute()
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(cell.execution_count for cell in code)
    assert [output for cell in code[:-1] for output in cell.outputs] == []
    said = "".join(output.text for output in code[-1].outputs)
    asked = [part.variable for slug in BUNDLED for part in EXERCISES[slug].asked]
    assert [line.split()[0] for line in said.splitlines()] == asked
    assert said.count("not answered yet") == len(asked)


def test_an_error_in_an_answer_does_not_keep_run_all_from_the_self_check(tmp_path):
    handout, _ = quick(tmp_path)
    notebook = nbformat.reads(fill_in(handout, {"lever_p": "1 / 0"}).decode(), 4)
    NotebookClient(notebook, timeout=None).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert [output.output_type for output in outputs] == ["error", "stream"]
    assert outputs[-1].text.count("not answered yet") == 2


def test_the_statement_is_seen_first_and_the_self_check_last_and_folded(tmp_path):
    handout, solution = quick(tmp_path)
    cells = json.loads(handout)["cells"]
    folded = [cell for cell in cells if cell["metadata"].get("jupyter", {}).get("source_hidden")]
    assert folded == [cells[-1]]
    assert "hide-input" in folded[0]["metadata"]["tags"]
    before = [cell for cell in cells[:-1] if cell["cell_type"] == "code"]
    assert max(len("".join(cell["source"]).splitlines()) for cell in before) < 6
    assert b"source_hidden" not in solution


def marked(written, exercise, v):
    """Verdicts by variable on a notebook."""
    submission = Submission(Path("one.ipynb"), written)
    verdicts = mark(exercise, v, submission.raws(submission.asks(exercise, v), Limits()))
    return {verdict.part: verdict for verdict in verdicts}


def expected(exercise, status):
    """That status, but for what is marked by hand: it waits where something is there or may be on paper."""
    by_hand = {
        part.variable: "missing"
        if status == "missing" and not part.answer.on_paper
        else "not_graded"
        for part in exercise.asked
        if isinstance(part.answer, Manual)
    }
    return {part.variable: status for part in exercise.asked} | by_hand


def test_a_sheet_as_handed_out_is_not_answered(exercise):
    handout, _ = both([exercise])
    found = marked(handout, exercise, variant_of(exercise.slug))
    assert {name: verdict.status for name, verdict in found.items()} == expected(
        exercise, "missing"
    )
    assert all(verdict.points in (0, None) for verdict in found.values())


def test_the_worked_solution_earns_full_marks(exercise):
    _, solution = both([exercise], seed=2)
    found = marked(solution, exercise, variant_of(exercise.slug, 2))
    assert {name: verdict.status for name, verdict in found.items()} == expected(
        exercise, "correct"
    )


def test_a_worked_solution_is_marked_as_one_and_has_no_numbers_for_a_check(exercise):
    handout, solution = both([exercise])
    assert ": worked solution\n" in sources(solution, "markdown")[0]
    assert "solution" not in sources(handout, "markdown")[0]
    assert "numbers" not in json.loads(solution)["metadata"]["kinegrade"]


def test_a_worked_solution_can_be_handed_out(exercise):
    """It says nothing of handing it in or of the instructor, has the numbers, and cites no course that it does not name."""
    _, solution = both([exercise])
    told = "\n".join(sources(solution, "markdown"))
    assert re.search(r"Replace each|instructor|At the end|\bS[0-4][ ,]", told) is None
    assert given_cell(exercise, variant_of(exercise.slug)) in sources(solution)


def test_a_worked_solution_shows_the_frames_that_the_sheet_asks_for():
    handout, solution = both([EXERCISES["rrt"]])
    assert handout.count(b"<img ") == 2
    assert solution.count(b"<img ") == 3
    assert b"*The arm with its frames.*" in solution


def secrets_of(exercise, v):
    """Texts that tell an answer and are not part of the question: numbers that were drawn, options of a choice."""
    asked = (
        exercise.statement(v)
        + given_cell(exercise, v)
        + "".join(part.prompt for part in exercise.asked)
    )
    asked += " ".join(f"{abs(x):.4f}" for x in flat(printed(exercise, v)))
    answers = references(exercise, v)
    parts = [part for part in exercise.asked if not isinstance(part.answer, Choice)]
    told = {text for part in parts for text in telling(part, answers[part.variable], v)}
    return {text for text in told if text not in asked}


def test_a_handed_out_sheet_holds_no_answer(exercise):
    secrets = secrets_of(exercise, variant_of(exercise.slug))
    handout, solution = (
        "\n".join(sources(written) + sources(written, "markdown")) for written in both([exercise])
    )
    pictureless = re.sub(r"data:image/[^\"]+", "", handout)
    assert secrets
    assert [text for text in secrets if text in pictureless] == []
    assert any(text in solution for text in secrets)


def test_what_a_check_needs_stands_in_the_metadata(tmp_path):
    handout, _ = quick(tmp_path)
    about = json.loads(handout)["metadata"]["kinegrade"]
    assert about == {
        "sheet": "one",
        "student": "ada",
        "mode": "graded",
        "exercises": ["lever"],
        "limits": {"cell_seconds": 30.0, "notebook_seconds": 180.0, "memory_mb": 2048},
        "numbers": {"lever": {"L": 0.75, "q": [0.3]}},
    }


@pytest.mark.parametrize(
    ("mode", "hinted"), [("practice", True), ("graded", True), ("exam", False)]
)
def test_an_exam_has_no_hints(mode, hinted):
    handout, solution = both([EXERCISES["rrt"]], mode)
    assert (b"<details>" in handout) is hinted
    assert b"<details>" not in solution


def test_every_part_has_a_blank_of_its_own_and_its_points(exercise):
    handout, _ = both([exercise])
    for part in exercise.asked:
        blanks = (f"{part.variable} = ...", f"def {part.variable}(")
        assert sum(source.startswith(blanks) for source in sources(handout)) == 1
        assert any(
            text.startswith(f"**`{part.variable}`** ({part.points:g} point")
            for text in sources(handout, "markdown")
        )
    assert f"{exercise.points:g} points" in sources(handout, "markdown")[0]


def test_the_options_of_a_choice_stand_below_its_question_with_their_letters():
    exercise = EXERCISES["find_the_mistake"]
    handout, _ = both([exercise])
    (part,) = (part for part in exercise.asked if isinstance(part.answer, Choice))
    (cell,) = (
        text for text in sources(handout, "markdown") if text.startswith(f"**`{part.variable}`**")
    )
    for letter, option in zip(part.answer.letters, part.answer.options, strict=True):
        assert f"\n- **{letter})** {option}" in cell


@pytest.mark.parametrize(
    ("on_paper", "words"), [(False, "Marked by hand."), (True, "On paper, marked by hand.")]
)
def test_what_is_marked_by_hand_says_so_and_the_solution_has_its_rubric(on_paper, words):
    part = Part(
        "t_why",
        "Why",
        3,
        Manual(((1, "a reason"), (2, "an example")), on_paper=on_paper),
        lambda *_: "The key.",
    )
    exercise = exercise_of(part)
    handout, solution = notebooks(
        "Tests", sheet(exercises=("t",)), ADA, [Assignment(exercise, {"x": 0.5})]
    )
    assert any(
        text.startswith("**`t_why`** (3 points): Why.") and words in text
        for text in sources(handout, "markdown")
    )
    assert "- 1 point: a reason\n- 2 points: an example" in sources(solution, "markdown")
    assert "t_why = 'The key.'" in sources(solution)
    assert b"an example" not in handout
    assert b"The key." not in handout


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
    """Behind every number; behind the last line of one that stands in several."""
    cell = given_cell(exercise, variant_of(exercise.slug))
    ends = [node.end_lineno for node in ast.parse(cell).body]
    lines = cell.splitlines()
    assert ends
    assert all(re.search(r"# \[[^\]]+\]$", lines[end - 1]) for end in ends)


def test_only_what_has_a_unit_is_printed(exercise):
    v = variant_of(exercise.slug)
    scope = {"np": np}
    exec(given_cell(exercise, v), scope)  # noqa: S102
    names = {name for name in scope if name.startswith(f"{exercise.slug}_")}
    assert names == {f"{exercise.slug}_{name}" for name in exercise.units if name in v}
    assert not {f"{exercise.slug}_{name}" for name in exercise.hidden} & names
    assert not set(exercise.hidden) & set(printed(exercise, v))


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
        ("'x'", "ready: typed text, read when the sheet is marked"),
        ("['1/2', '0.3 m']", "ready: typed text, read when the sheet is marked"),
        ("[[1.0], [2.0]]", "ready"),
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
    assert all(
        re.search(r'src="data:image/svg\+xml;base64,[^"]+" alt="[^"]{20,}"', image)
        for image in images
    )


@pytest.mark.parametrize(
    ("slug", "words"),
    [
        ("rrt", "`form 11`."),
        ("cross_products", "`kinds PRR`."),
        ("last_frame_columns", "`columns 4, 5`."),
        (
            "puma_velocities",
            "`wording orientation held (omega = 0)`, `family near wrist-singular`.",
        ),
    ],
)
def test_a_sheet_names_its_variant_plainly(slug, words):
    text = given_form(EXERCISES[slug], variant_of(slug))
    assert text == f"*Your variant of this exercise, to name when you ask about it: {words}*"
