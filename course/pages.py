"""Feedback for each student and a report for the instructor, as HTML that needs nothing else."""

from collections import Counter
from collections.abc import Sequence
from functools import cache
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import BaseLoader, Environment, Template
from markupsafe import Markup

from ..exercises.exercise import Choice, Exercise, Manual, Part
from ..grader.marking.verdict import STATUS_WORDS, Verdict
from .config import Course, Sheet
from .escape import printable
from .files import write_atomically
from .formulas import number, page_text
from .grading import Result
from .tables import MARKS, remark, result_text, status


def write_feedback(
    course: Course, sheet: Sheet, exercises: Sequence[Exercise], result: Result
) -> Path:
    """feedback/<student>/<sheet>.html: every part, every entry, and what was found; no reference value."""
    path = course.folder / "feedback" / result.student.id / f"{sheet.name}.html"
    verdicts = {verdict.part: verdict for verdict in result.verdicts}
    blocks = [
        {
            "title": exercise.title,
            "parts": [
                feedback_block(part, verdicts[part.variable])
                for part in exercise.asked
                if part.variable in verdicts
            ],
        }
        for exercise in exercises
    ]
    html = template("feedback.html").render(
        course=course.settings.title,
        sheet=sheet.title or sheet.name,
        student=result.student,
        points=result_text(result),
        waiting=status(result) == "not_graded",
        blocks=blocks,
    )
    write_atomically(path, html)
    return path


def feedback_block(part: Part, verdict: Verdict) -> dict[str, Any]:
    """What a feedback page says of one part."""
    return {
        "variable": part.variable,
        "prompt": Markup(page_text(part.prompt)),  # noqa: S704 - page_text escapes
        "status": verdict.status,
        "words": STATUS_WORDS[verdict.status],
        "mark": MARKS[verdict.status],
        "points": "–" if verdict.points is None else f"{verdict.points:g}",
        "out_of": f"{verdict.out_of:g}",
        "reading": verdict.reading,
        "findings": [_finding(finding.text) for finding in verdict.findings if not finding.private],
        "matrices": list(_matrices(part, verdict)),
        "options": [Markup(page_text(text)) for text in part.answer.options]  # noqa: S704 - page_text escapes
        if isinstance(part.answer, Choice)
        else [],
        "text": verdict.answer if isinstance(part.answer, Manual) else None,
        "rubric": [(f"{points:g}", text) for points, text in part.answer.rubric]
        if isinstance(part.answer, Manual)
        else [],
    }


def _finding(text: str) -> dict[str, str]:
    """The sentence, and the typed lines with a caret that may follow it."""
    sentence, *typed = [printable(line) for line in text.split("\n")]
    return {"sentence": sentence, "typed": "\n".join(typed)}


def _matrices(part: Part, verdict: Verdict) -> list[list[list[dict[str, Any]]]]:
    """The answer as tables of cells with a text and whether it is right; a stack gives several."""
    if verdict.answer is None or verdict.right is None:
        return []
    answer, right = verdict.answer, verdict.right
    depth = _depth(right)
    if depth == 0:
        answer, right = [answer], [right]
    if depth <= 1:
        answer, right = [[x] for x in answer], [[x] for x in right]
    if depth <= 2:
        answer, right = [answer], [right]
    decimals = getattr(part.answer, "decimals", 0)
    return [
        [
            [
                {
                    "text": x if isinstance(x, str) else number(x, decimals),
                    "right": ok,
                    "typed": isinstance(x, str),
                }
                for x, ok in zip(xs, oks, strict=True)
            ]
            for xs, oks in zip(rows, flags, strict=True)
        ]
        for rows, flags in zip(answer, right, strict=True)
    ]


def _depth(nested: Any) -> int:
    return 1 + _depth(nested[0]) if isinstance(nested, list) else 0  # pyright: ignore[reportUnknownArgumentType]


def write_report(
    course: Course, sheets: Sequence[tuple[Sheet, Sequence[Exercise], Sequence[Result]]]
) -> Path:
    """report/index.html: the class, part by part, with the maps of the robots that were asked about."""
    path = course.folder / "report" / "index.html"
    blocks = [_sheet_block(sheet, exercises, results) for sheet, exercises, results in sheets]
    robots = {
        exercise.robot for _, exercises, _ in sheets for exercise in exercises if exercise.robot
    }
    figures = [_figure(path.parent, name) for name in sorted(robots)]
    write_atomically(
        path,
        template("report.html").render(
            course=course.settings.title, sheets=blocks, figures=figures
        ),
    )
    return path


def _sheet_block(
    sheet: Sheet, exercises: Sequence[Exercise], results: Sequence[Result]
) -> dict[str, Any]:
    parts = [part for exercise in exercises for part in exercise.asked]
    rows = [
        {
            "student": result.student,
            "feedback": f"../feedback/{result.student.id}/{sheet.name}.html"
            if result.verdicts
            else "",
            "cells": [_cell(result, part) for part in parts],
            "points": result_text(result),
            "remark": remark(result, public=True),
            "private": sorted(
                {f.text for verdict in result.verdicts for f in verdict.findings if f.private}
            ),
        }
        for result in results
    ]
    return {
        "title": sheet.title or sheet.name,
        "mode": sheet.mode,
        "parts": [
            {
                "variable": part.variable,
                "points": f"{part.points:g}",
                "counts": _counts(results, part),
            }
            for part in parts
        ],
        "rows": rows,
        "graded": sum(status(result) == "graded" for result in results),
        "waiting": sum(status(result) == "not_graded" for result in results),
        "missing": sum(status(result) == "no_submission" for result in results),
    }


def _cell(result: Result, part: Part) -> dict[str, str]:
    for verdict in result.verdicts:
        if verdict.part == part.variable:
            return {
                "status": verdict.status,
                "mark": MARKS[verdict.status],
                "words": STATUS_WORDS[verdict.status],
            }
    return {"status": "none", "mark": "", "words": "no submission"}


def _counts(results: Sequence[Result], part: Part) -> str:
    counts = Counter(
        v.status for result in results for v in result.verdicts if v.part == part.variable
    )
    return ", ".join(
        f"{counts[kind]} {words}" for kind, words in STATUS_WORDS.items() if counts[kind]
    )


def _figure(folder: Path, name: str) -> dict[str, str]:
    """The map of a robot and its description, made once per version."""
    from ..solutions.robots import robot

    file = f"{name}-{version('kinegrade')}.png"
    text = (folder / file).with_suffix(".txt")
    if not (folder / file).exists() or not text.exists():
        from ..grader.figures.maps import describe, picture

        write_atomically(folder / file, picture(robot(name), ".png"))
        write_atomically(text, describe(robot(name)))
    return {"file": file, "title": robot(name).title, "alt": text.read_text(encoding="utf-8")}


@cache
def template(name: str) -> Template:
    """One of our pages, with the style that all of them share."""
    environment: Any = Environment(
        loader=BaseLoader(), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    style = files("kinegrade.course").joinpath("templates/style.css").read_text(encoding="utf-8")
    environment.globals["style"] = Markup(style)  # noqa: S704 - our own file
    return environment.from_string(
        files("kinegrade.course").joinpath(f"templates/{name}").read_text(encoding="utf-8")
    )
