"""Results on the terminal and as JSON: nothing in them is obeyed, and what waits is never a zero."""

import io
import json

import pytest
from answers import EXERCISES
from courses import lever
from kinegrade.course.results.result import Result
from kinegrade.course.results.tables import (
    MARKS,
    legend,
    print_table,
    remark,
    result_text,
    results_json,
    terminal_table,
)
from kinegrade.course.settings.config import Student
from kinegrade.grader.marking.verdict import STATUS_WORDS, Finding, Verdict, not_graded
from rich.console import Console

ADA = Student("ada", "Ada Lovelace")


def result(*verdicts, student=ADA, reason=""):
    return Result(student, "one", verdicts, reason)


def verdict(part="lever_p", status="correct", points=2.0, *texts, private=False):
    return Verdict(part, status, points, 2.0, tuple(Finding(text, private) for text in texts))


def printed(tmp_path, results, *, width=140, color=False):
    console = Console(width=width, file=io.StringIO(), force_terminal=color, legacy_windows=False)
    console.print(terminal_table(results, [lever(tmp_path)]))
    return console.file.getvalue()


def test_every_status_has_a_mark_of_its_own_and_a_word():
    assert set(MARKS) == set(STATUS_WORDS)
    assert len(set(MARKS.values())) == len(MARKS)
    assert all(f"{MARKS[kind]} {words}" in legend() for kind, words in STATUS_WORDS.items())


def test_the_table_has_a_mark_for_every_part_the_points_and_the_first_remark(tmp_path):
    full = result(verdict(), verdict("lever_J", "partly", 1.25, "Look at row 2."))
    lines = printed(
        tmp_path, [full, result(student=Student("benedict", "B"), reason="no submission")]
    ).splitlines()
    assert ["student", "lever", "points", "first", "remark"] in [line.split() for line in lines]
    assert ["ada", "✓◐", "3.25", "/", "4", "lever_J:", "Look", "at", "row", "2."] in [
        line.split() for line in lines
    ]
    assert ["benedict", "—", "no", "submission"] in [line.split() for line in lines]


def test_ids_and_marks_are_never_broken_over_lines(tmp_path):
    long = result(verdict("lever_p", "partly", 1.0, "word " * 60), student=Student("x" * 40, "X"))
    assert any(
        line.strip().startswith("x" * 40)
        for line in printed(tmp_path, [long], width=100).splitlines()
    )


@pytest.mark.parametrize("count", [1, 4, 8, len(EXERCISES)])
@pytest.mark.parametrize(("width", "terminal"), [(80, True), (40, True), (140, False)])
def test_nothing_of_many_exercises_is_cut_on_a_terminal_and_in_a_file(count, width, terminal):
    exercises = list(EXERCISES.values())[:count]
    parts = [part.variable for exercise in exercises for part in exercise.asked]
    waiting = [not_graded(part, 33.25, "It waits.") for part in parts]
    found = result(verdict(parts[0]), *waiting[1:], student=Student("s1234567", "S"))
    console = Console(width=width, file=io.StringIO(), force_terminal=terminal, color_system=None)
    print_table(console, [found], exercises)
    printed = console.file.getvalue()
    (line,) = [line for line in printed.splitlines() if "s1234567" in line]
    assert result_text(found) in line
    assert line.count("✓") + line.count("?") == len(parts) + 1
    assert "…" not in printed
    assert "It waits." in " ".join(printed.split())
    if not terminal:
        assert all(exercise.slug in printed for exercise in exercises)


def test_a_terminal_that_is_wide_enough_has_no_longer_lines(tmp_path):
    long = result(verdict("lever_p", "partly", 1.0, "word " * 60))
    console = Console(width=60, file=io.StringIO(), force_terminal=True, color_system=None)
    print_table(console, [long], [lever(tmp_path)])
    assert {len(line) for line in console.file.getvalue().splitlines()} == {60}


@pytest.mark.parametrize(
    "text",
    [
        "[/b] [red]x[/red]",
        "[bold",
        "\x1b]0;title\x07\x1b[2J",
        "a\rb\u202ec",
        "\ud800",
        "[link=x]y[/]",
    ],
)
@pytest.mark.parametrize("color", [False, True])
def test_a_remark_is_shown_as_text_and_never_obeyed(tmp_path, text, color):
    out = printed(tmp_path, [result(verdict("lever_p", "failed", 0.0, text))], color=color)
    plain = printed(tmp_path, [result(verdict("lever_p", "failed", 0.0, "harmless"))], color=color)
    assert out.count("\x1b") == plain.count("\x1b")
    assert len(out.splitlines()) == len(plain.splitlines())
    out.encode()
    for char in "\x07\r\u202e":
        assert char not in out
    assert "".join(char if char.isprintable() else "\ufffd" for char in text) in out


@pytest.mark.parametrize(
    ("verdicts", "points", "word"),
    [
        ((verdict(), verdict("lever_J", "partly", 0.5)), "2.5 / 4", "graded"),
        ((verdict("lever_p", "missing", 0.0),), "0 / 2", "graded"),
        ((verdict(), not_graded("lever_J", 3, "wait")), "2 + ? / 5", "not_graded"),
        (
            (verdict("lever_p", "missing", 0.0), not_graded("lever_J", 3, "wait")),
            "0 + ? / 5",
            "not_graded",
        ),
        (
            (not_graded("lever_p", 2, "wait"), not_graded("lever_J", 3, "wait")),
            "not graded",
            "not_graded",
        ),
        ((), "—", "no_submission"),
    ],
)
def test_what_waits_is_never_a_zero(verdicts, points, word):
    assert result_text(result(*verdicts)) == points
    assert result(*verdicts).status == word


def test_a_remark_is_the_sentence_without_the_typed_lines_behind_it(tmp_path):
    found = result(
        verdict("lever_p", "failed", 0.0, "Row 1: the bracket is not closed.\nsin(q1\n   ^")
    )
    assert remark(found) == "lever_p: Row 1: the bracket is not closed."
    plain = printed(
        tmp_path, [result(verdict("lever_p", "failed", 0.0, "Row 1: the bracket is not closed."))]
    )
    assert printed(tmp_path, [found]) == plain


def test_a_part_that_is_right_has_no_remark():
    right, wrong = (
        verdict("lever_p", "correct", 2.0, "Well done."),
        verdict("lever_J", "partly", 1.0, "Look again."),
    )
    assert remark(result(right, wrong)) == "lever_J: Look again."
    assert remark(result(right)) == ""


def test_a_remark_for_students_leaves_out_what_is_private():
    found = result(
        verdict("lever_p", "incorrect", 0.0, "secret", private=True),
        verdict("lever_J", "partly", 1.0, "open"),
    )
    assert remark(found) == "lever_p: secret"
    assert remark(found, public=True) == "lever_J: open"
    assert remark(result(reason="why")) == "why"
    assert remark(result()) == ""


def test_json_holds_everything_a_script_would_want():
    found = result(
        verdict("lever_p", "partly", 1.25, "half \ud800"), not_graded("lever_J", 3, "wait")
    )
    (data,) = json.loads(results_json([found]))
    assert (data["student"], data["sheet"], data["status"], data["points"], data["out_of"]) == (
        "ada",
        "one",
        "not_graded",
        None,
        5,
    )
    assert [Verdict.from_json(part) for part in data["parts"]] == list(found.verdicts)
