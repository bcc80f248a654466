"""Results as a table on the terminal, as grades.csv, and as JSON."""

import csv
import io
import json
from collections.abc import Sequence

from rich.box import SIMPLE_HEAD
from rich.table import Table
from rich.text import Text

from ..exercises.exercise import Exercise, Manual
from ..grader.marking.verdict import STATUS_WORDS
from .console import say
from .escape import no_formula, printable
from .grading import Result
from .marks import ByHand

NEWLINE = "\n"  # behind it stands what was typed, with a caret
MARKS = {
    "correct": "✓",
    "follows": "✓",
    "partly": "◐",
    "incorrect": "✗",
    "missing": "–",
    "failed": "!",
    "not_graded": "?",
}


def terminal_table(results: Sequence[Result], exercises: Sequence[Exercise]) -> Table:
    """One line per student: a mark for every part of each exercise, points, and the first thing worth knowing."""
    table = Table(header_style="bold", pad_edge=False, box=SIMPLE_HEAD)
    table.add_column(
        "student",
        no_wrap=True,
        min_width=max((len(result.student.id) for result in results), default=7),
    )
    for exercise in exercises:
        table.add_column(exercise.slug, no_wrap=True, min_width=len(exercise.slug))
    table.add_column("points", justify="right", no_wrap=True, min_width=10)
    table.add_column("first remark")
    for result in results:
        marks = {verdict.part: MARKS[verdict.status] for verdict in result.verdicts}
        shown = [
            "".join(marks.get(part.variable, " ") for part in exercise.asked)
            for exercise in exercises
        ]
        table.add_row(
            result.student.id, *shown, result_text(result), Text(printable(remark(result)))
        )
    return table


def show_by_hand(waiting: Sequence[ByHand]) -> None:
    """Answers that wait for a mark, one after the other, with what to mark them by."""
    for one in waiting:
        assert isinstance(one.part.answer, Manual)  # noqa: S101 - only such parts wait
        answer = (
            printable(one.answer)
            if one.answer
            else "(on paper)"
            if one.part.answer.on_paper
            else "(nothing)"
        )
        rubric = "\n".join(f"    {points:g}  {text}" for points, text in one.part.answer.rubric)
        print(f"{one.student}  {one.part.variable}  {one.part.points:g} points\n  answer: {answer}")  # noqa: T201 - data of a command
        print(f"  key:    {one.key}\n{rubric}\n")  # noqa: T201 - the same
    say(
        f"{len(waiting)} answers wait for a mark."
        if len(waiting) != 1
        else "One answer waits for a mark."
    )


def legend() -> str:
    """What the marks mean."""
    return "   ".join(f"{mark} {STATUS_WORDS[status]}" for status, mark in MARKS.items())  # pyright: ignore[reportArgumentType]


def result_text(result: Result) -> str:
    """Points of a result, or what stands in their place."""
    if result.points is not None:
        return f"{result.points:g} / {result.out_of:g}"
    if not result.verdicts:
        return "—"
    known = [verdict.points for verdict in result.verdicts if verdict.points is not None]
    return f"{round(sum(known), 2):g} + ? / {result.out_of:g}" if known else "not graded"


def remark(result: Result, *, public: bool = False) -> str:
    """The reason why nothing was marked, else the first finding; with `public`, one that the student sees too."""
    if result.reason:
        return result.reason
    for verdict in (verdict for verdict in result.verdicts if verdict.status != "correct"):
        for finding in verdict.findings:
            if not (public and finding.private):
                return f"{verdict.part}: {finding.text.partition(NEWLINE)[0]}"
    return ""


def grades_csv(results: Sequence[Result], parts: Sequence[str]) -> str:
    """Every cell quoted; a grade that is not there is empty, never a zero."""
    out = io.StringIO()
    writer = csv.writer(out, quoting=csv.QUOTE_ALL, lineterminator="\n")
    writer.writerow(["student", "name", "sheet", "status", "points", "out_of", *parts])
    for result in results:
        points = {verdict.part: verdict.points for verdict in result.verdicts}
        writer.writerow(
            [
                result.student.id,
                no_formula(result.student.name),
                result.sheet,
                status(result),
                "" if result.points is None else f"{result.points:g}",
                f"{result.out_of:g}" if result.verdicts else "",
                *("" if points.get(part) is None else f"{points[part]:g}" for part in parts),
            ]
        )
    return out.getvalue()


def status(result: Result) -> str:
    """graded, not_graded or no_submission."""
    if result.points is not None:
        return "graded"
    return "not_graded" if result.verdicts else "no_submission"


def results_json(results: Sequence[Result]) -> str:
    """Everything a script would want."""
    data = [
        {
            "student": result.student.id,
            "sheet": result.sheet,
            "status": status(result),
            "points": result.points,
            "out_of": result.out_of,
            "reason": result.reason,
            "parts": [verdict.to_json() for verdict in result.verdicts],
        }
        for result in results
    ]
    return json.dumps(data, indent=2)
