"""Results as a table on the terminal and as JSON."""

import json
from collections.abc import Sequence
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.table import Table
from rich.text import Text

from ...exercises.exercise import Exercise, Manual
from ...grader.marking.verdict import STATUS_WORDS, Status
from ..language.speech import phrase
from ..language.writing import number_text
from ..machine.console import say, shown
from ..settings.times import late_text
from ..text.escape import printable
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


def terminal_table(results: Sequence[Result], exercises: Sequence[Exercise]) -> Table:
    """A line per student: a mark for every part of each exercise, points, the first remark."""
    longest = max((len(result.student.id) for result in results), default=7)
    table = Table(header_style="bold", pad_edge=False, box=SIMPLE_HEAD)
    table.add_column("student", no_wrap=True, min_width=longest)
    for exercise in exercises:
        table.add_column(exercise.slug, no_wrap=True, min_width=len(exercise.slug))
    table.add_column("points", justify="right", no_wrap=True, min_width=10)
    table.add_column("first remark")

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
            f"  answer: {_shown_answer(one)}",
            f"  key:    {one.key}",
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
        return printable(one.answer)
    asked = one.part.answer
    if isinstance(asked, Manual) and asked.on_paper:
        return "(on paper)"
    return "(nothing)"


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
