"""Results as a table on the terminal and as JSON."""

import json
from collections.abc import Sequence
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

from ...exercises.exercise import Exercise, Manual
from ...grader.marking.verdict import STATUS_WORDS, Status
from ..language.speech import phrase
from ..language.writing import number_text
from ..machine.console import say, shown
from ..settings.times import late_text
from ..text.escape import printable, printable_lines
from .marks import ByHand
from .result import Result

MARKS: dict[Status, str] = {
    "correct": "✓",
    "follows": "↪",
    "partly": "◐",
    "incorrect": "✗",
    "missing": "–",
    "failed": "!",
    "not_graded": "?",
}
ANY_WIDTH = 100_000  # columns, so that none are missing
FOLDED = 6  # columns for the name of an exercise that is folded
REMARK = 24  # columns that a remark has at least


def print_table(console: Console, results: Sequence[Result], exercises: Sequence[Exercise]) -> None:
    """Prints the table of a sheet; nothing in it is ever cut.

    On a narrow terminal the names of exercises are folded. Where that is not enough, and in a file,
    lines are as long as they have to be.
    """
    table = terminal_table(results, exercises)
    if console.is_terminal and _least_width(console, table) > console.width:
        table = terminal_table(results, exercises, folded=True)
    console.width = max(console.width, _least_width(console, table))
    console.print(table)


def _least_width(console: Console, table: Table) -> int:
    """How many columns a table takes in which nothing is cut."""
    return Measurement.get(console, console.options.update(width=ANY_WIDTH), table).minimum


def terminal_table(
    results: Sequence[Result], exercises: Sequence[Exercise], *, folded: bool = False
) -> Table:
    """A line per student: a mark for every part of each exercise, points, the first remark."""
    longest_id = max((len(result.student.id) for result in results), default=7)
    longest_points = max((len(result_text(result)) for result in results), default=10)
    table = Table(header_style="bold", pad_edge=False, box=SIMPLE_HEAD)
    table.add_column("student", no_wrap=True, min_width=longest_id)
    for exercise in exercises:
        if folded:
            width = max(FOLDED, len(exercise.asked))
            table.add_column(exercise.slug, overflow="fold", width=width)
        else:
            table.add_column(exercise.slug, no_wrap=True, min_width=len(exercise.slug))
    table.add_column("points", justify="right", no_wrap=True, min_width=longest_points)
    table.add_column("first remark", min_width=REMARK)

    for result in results:
        first = Text(printable(remark(result)))  # Text, as a string may hold markup of rich's
        marks = [_marks(result, exercise) for exercise in exercises]
        table.add_row(result.student.id, *marks, shown(result_text(result)), first)
    return table


def _marks(result: Result, exercise: Exercise) -> str:
    """One character for every part of an exercise."""
    marks = {verdict.part: shown(MARKS[verdict.status]) for verdict in result.verdicts}
    return "".join(marks.get(part.variable, " ") for part in exercise.asked)


def show_by_hand(waiting: Sequence[ByHand]) -> None:
    """Answers that wait for a mark, one after the other, with what to mark them by."""
    for one in waiting:
        rubric = [f"    ({i}) {points:g}  {text}" for i, (points, text) in enumerate(one.rubric, 1)]
        lines = [
            f"{one.student}  {one.part.variable}  {one.part.points:g} points",
            f"  answer: {_indented(_shown_answer(one))}",
            f"  key:    {_indented(one.key)}",
            "\n".join(rubric),
            "",
        ]
        print("\n".join(lines))  # noqa: T201 - data of a command
    if len(waiting) == 1:
        say("One answer waits for a mark.")
    else:
        say(f"{len(waiting)} answers wait for a mark.")


def _shown_answer(one: ByHand) -> str:
    if one.answer:
        return one.answer
    asked = one.part.answer
    if isinstance(asked, Manual) and asked.on_paper:
        return "(on paper)"
    return "(nothing)"


def _indented(text: str) -> str:
    """Its lines below one another, behind `answer:` or `key:`."""
    return printable_lines(text).replace("\n", f"\n{' ' * 10}")


def legend() -> str:
    """What the marks mean."""
    return "   ".join(f"{shown(mark)} {STATUS_WORDS[status]}" for status, mark in MARKS.items())


def result_text(result: Result) -> str:
    """Points of a result, or what stands in their place."""
    if result.excused:
        return phrase("excused")
    out_of = number_text(result.out_of)
    if result.points is not None:
        return f"{number_text(result.points)} / {out_of}"
    if not result.verdicts:
        return "—"
    known = [verdict.points for verdict in result.verdicts if verdict.points is not None]
    if not known:
        return phrase("not graded")
    return f"{number_text(result.so_far)} + ? / {out_of}"


def remark(result: Result, *, public: bool = False) -> str:
    """The reason why nothing was marked, else the first finding.

    With `public`, the first one that the student sees too.
    """
    if result.reason:
        return result.reason
    late = late_text(result.late)
    if late:
        return late
    if result.passed_over:
        names = ", ".join(result.passed_over)
        return f"also there, and not marked: {names}"
    for verdict in result.verdicts:
        if verdict.status == "correct":
            continue
        for finding in verdict.findings:
            if public and finding.private:
                continue
            # Behind the first line stands what was typed, with a caret.
            sentence = finding.text.partition("\n")[0]
            return f"{verdict.part}: {sentence}"
    return ""


def results_json(results: Sequence[Result]) -> str:
    """Everything a script would want, a line for each result."""
    lines = [json.dumps(_result_json(result)) for result in results]
    return "[\n" + ",\n".join(lines) + "\n]"


def _result_json(result: Result) -> dict[str, Any]:
    return {
        "student": result.student.id,
        "sheet": result.sheet,
        "status": result.status,
        "points": result.points,
        "out_of": result.out_of,
        "reason": result.reason,
        "days_late": result.late.days,
        "late_percent": result.late.percent,
        "published": result.published,
        "parts": [verdict.to_json() for verdict in result.verdicts],
    }
