"""Feedback for each student and a report for the instructor, as HTML that needs nothing else."""

from collections import Counter
from collections.abc import Sequence
from functools import cache
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import Environment, FunctionLoader, Template
from markupsafe import Markup

from ..exercises.exercise import Choice, Exercise, Manual, Part
from ..grader.marking.verdict import STATUS_WORDS, Verdict
from .config import Course, Sheet
from .entries import Cell, entry_tables
from .escape import printable_lines
from .files import write_atomically
from .formulas import page_text
from .grading import Result
from .tables import MARKS, remark, result_text, status

Block = dict[str, Any]
"""What a template shows of one thing, by the names that it uses."""


def write_feedback(
    course: Course, sheet: Sheet, exercises: Sequence[Exercise], result: Result
) -> Path:
    """feedback/<student>/<sheet>.html: every part and entry, what was found, no reference value."""
    path = course.folder / "feedback" / result.student.id / f"{sheet.name}.html"
    html = template("feedback.html").render(
        course=course.settings.title,
        sheet=sheet.title or sheet.name,
        student=result.student,
        points=result_text(result),
        waiting=status(result) == "not_graded",
        blocks=_exercise_blocks(exercises, result.verdicts),
    )
    write_atomically(path, html)
    return path


def _exercise_blocks(exercises: Sequence[Exercise], verdicts: Sequence[Verdict]) -> list[Block]:
    by_part = {verdict.part: verdict for verdict in verdicts}
    blocks: list[Block] = []
    for exercise in exercises:
        parts: list[Block] = []
        for part in exercise.asked:
            verdict = by_part.get(part.variable)
            if verdict is not None:
                parts.append(feedback_block(part, verdict))
        blocks.append({"title": exercise.title, "parts": parts})
    return blocks


def feedback_block(part: Part, verdict: Verdict) -> Block:
    """What a feedback page says of one part."""
    answer = part.answer
    points = "–"
    if verdict.points is not None:
        points = f"{verdict.points:g}"

    options: list[Markup] = []
    if isinstance(answer, Choice):
        options = [_markup(option) for option in answer.options]

    text: Any = None
    rubric: list[tuple[str, str]] = []
    if isinstance(answer, Manual):
        text = verdict.answer
        rubric = [(f"{worth:g}", criterion) for worth, criterion in answer.rubric]

    return {
        "variable": part.variable,
        "prompt": _markup(part.prompt),
        "status": verdict.status,
        "words": STATUS_WORDS[verdict.status],
        "mark": MARKS[verdict.status],
        "points": points,
        "out_of": f"{verdict.out_of:g}",
        "reading": verdict.reading,
        "findings": _findings(verdict),
        "matrices": _matrices(part, verdict),
        "options": options,
        "text": text,
        "rubric": rubric,
    }


def _markup(line: str) -> Markup:
    return Markup(page_text(line))  # noqa: S704 - page_text escapes


def _findings(verdict: Verdict) -> list[dict[str, str]]:
    """What the student may read: a sentence each, and the typed lines with a caret below it."""
    shown: list[dict[str, str]] = []
    for finding in verdict.findings:
        if finding.private:
            continue
        sentence, *typed = finding.text.split("\n")
        shown.append({"sentence": sentence, "typed": "\n".join(typed)})
    return shown


def _matrices(part: Part, verdict: Verdict) -> list[list[list[Cell]]]:
    if verdict.answer is None or verdict.right is None:
        return []
    decimals = getattr(part.answer, "decimals", 0)
    return entry_tables(verdict.answer, verdict.right, decimals)


def write_report(
    course: Course,
    sheets: Sequence[tuple[Sheet, Sequence[Exercise], Sequence[Result]]],
    level: str = "",
) -> Path:
    """report/index.html: the class, part by part, with maps of the robots that were asked about.

    `level` is a sentence on how notebooks were run.
    """
    path = course.folder / "report" / "index.html"
    blocks: list[Block] = []
    robots: set[str] = set()
    for sheet, exercises, results in sheets:
        blocks.append(_sheet_block(sheet, exercises, results))
        for exercise in exercises:
            if exercise.robot:
                robots.add(exercise.robot)

    figures = [_figure(path.parent, name) for name in sorted(robots)]
    html = template("report.html").render(
        course=course.settings.title, sheets=blocks, figures=figures, level=level
    )
    write_atomically(path, html)
    return path


def _sheet_block(sheet: Sheet, exercises: Sequence[Exercise], results: Sequence[Result]) -> Block:
    parts: list[Part] = []
    for exercise in exercises:
        parts += exercise.asked
    counts = Counter(map(status, results))
    rows = [_row(sheet, parts, result) for result in results]
    return {
        "title": sheet.title or sheet.name,
        "mode": sheet.mode,
        "parts": [_part_block(part, results) for part in parts],
        "rows": rows,
        "graded": counts["graded"],
        "waiting": counts["not_graded"],
        "missing": counts["no_submission"],
        "unsafe": sum(result.unsafe for result in results),
    }


def _part_block(part: Part, results: Sequence[Result]) -> Block:
    """One part, and how many of the class were right, partly right and so on."""
    counts: Counter[str] = Counter()
    for result in results:
        for verdict in result.verdicts:
            if verdict.part == part.variable:
                counts[verdict.status] += 1

    said: list[str] = []
    for kind, words in STATUS_WORDS.items():
        if counts[kind]:
            said.append(f"{counts[kind]} {words}")
    return {
        "variable": part.variable,
        "points": f"{part.points:g}",
        "counts": ", ".join(said),
    }


def _row(sheet: Sheet, parts: Sequence[Part], result: Result) -> Block:
    """One student in the table of a sheet, with what only the instructor reads."""
    feedback = ""
    if result.verdicts:
        feedback = f"../feedback/{result.student.id}/{sheet.name}.html"

    private: set[str] = set()
    for verdict in result.verdicts:
        for finding in verdict.findings:
            if finding.private:
                private.add(finding.text)

    return {
        "student": result.student,
        "feedback": feedback,
        "cells": [_cell(result, part) for part in parts],
        "points": result_text(result),
        "remark": remark(result, public=True),
        "private": sorted(private),
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


def template(name: str) -> Template:
    """One of our pages, with the style that all of them share."""
    return _environment().get_template(name)


@cache
def _environment() -> Environment:
    environment: Any = Environment(
        loader=FunctionLoader(_template_text),
        autoescape=True,
        finalize=_shown,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals["style"] = Markup(_template_text("style.css"))  # noqa: S704 - our own file
    return environment


def _shown(value: Any) -> Any:
    """What a page shows of anything: text without control characters; our own markup as it is."""
    if isinstance(value, str) and not isinstance(value, Markup):
        return printable_lines(value)
    return value


def _template_text(name: str) -> str:
    return files("kinegrade.course").joinpath(f"templates/{name}").read_text(encoding="utf-8")
