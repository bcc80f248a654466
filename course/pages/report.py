"""The report for the instructor: what to do next, the class, every sheet part by part."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from markupsafe import Markup

from ...grader.marking.verdict import STATUS_WORDS
from ..ledger.term import Request
from ..results.grades import SheetResults, Total, totals
from ..results.mistakes import absent, mistakes, private_notes, to_talk_about, waiting
from ..results.result import Result
from ..results.statistics import PartNumbers, part_numbers, sheet_shares, spread
from ..results.tables import MARKS, remark, result_text
from ..settings.config import Course
from ..term.differences import Move
from .histogram import histogram
from .page import template, write_page
from .robot_maps import write_maps

Block = dict[str, Any]
"""What a template shows of one thing, by the names that it uses."""
TALKED_ABOUT = 5  # mistakes, and parts, that stand on the first screen
HARD = 0.5  # of the points: parts with less stand there
ODD = 0.1  # a discrimination below says that something is the matter with the question


def write_report(
    course: Course,
    sheets: Sequence[SheetResults],
    level: str = "",
    requests: Sequence[Request] = (),
) -> Path:
    """report/index.html, and beside it the page of the robots that were asked about.

    `level` is a sentence on how notebooks were run, `requests` are what students asked.
    """
    folder = course.folder / "report"
    title = course.settings.title
    people = totals(sheets)
    html = template("report.html").render(
        course=title,
        level=level,
        maps=write_maps(folder, title, _robots(sheets)),
        total=_total_block(people),
        names={student.id: student.name for student in course.students},
        next=_next_week(sheets) | {"requests": [one for one in requests if not one.answered]},
        changed=_changed(sheets),
        sheets=[_sheet_block(course, sheet) for sheet in sheets],
        people=[_person(sheets, i, total) for i, total in enumerate(people)],
        marks=[(MARKS[status], words) for status, words in STATUS_WORDS.items()],
    )
    path = folder / "index.html"
    write_page(path, html)
    return path


def _changed(sheets: Sequence[SheetResults]) -> list[str]:
    """Marks that are other ones than students were told, a line each."""
    lines: list[str] = []
    for sheet in sheets:
        told = [Move(result, result.by_now) for result in sheet.results if result.by_now]
        lines += [move.line().replace("->", "→") for move in told]
    return lines


def _robots(sheets: Sequence[SheetResults]) -> set[str]:
    """Names of the robots with a map that exercises are about."""
    robots: set[str] = set()
    for sheet in sheets:
        for exercise in sheet.exercises:
            robots.add(exercise.robot or "")
    return robots - {""}


def _total_block(people: Sequence[Total]) -> Block:
    shares = [total.percent / 100 for total in people if total.percent is not None]
    return _spread_block(shares, "course totals")


def _spread_block(shares: Sequence[float], of: str) -> Block:
    found = spread(shares)
    return {
        "count": found.count,
        "mean": _percent(found.mean),
        "median": _percent(found.median),
        "histogram": Markup(histogram(found.bins, of)),  # noqa: S704 - numbers and our own words
    }


def _percent(share: float | None) -> str:
    if share is None:
        return "–"
    return f"{100 * share:.0f} %"


def _next_week(sheets: Sequence[SheetResults]) -> Block:
    """What fits the first screen: what waits, who is missing, what to talk about."""
    numbers: list[PartNumbers] = []
    for sheet in sheets:
        numbers += part_numbers(sheet)
    hard = sorted(filter(_is_hard, numbers), key=_facility)
    odd = list(filter(_is_odd, numbers))
    return {
        "waiting": waiting(*sheets),
        "absent": _absent(sheets),
        "notes": private_notes(*sheets),
        "mistakes": to_talk_about(sheets, TALKED_ABOUT),
        "hard": [_part_block(part) for part in hard[:TALKED_ABOUT]],
        "odd": [_part_block(part) for part in odd[:TALKED_ABOUT]],
    }


def _absent(sheets: Sequence[SheetResults]) -> list[tuple[str, str, list[str]]]:
    """Sheet, reason and students, of the sheets of which anything was marked."""
    away: list[tuple[str, str, list[str]]] = []
    for sheet in sheets:
        if not sheet.is_due:
            continue
        name = sheet.sheet.title or sheet.sheet.name
        for reason, students in absent(sheet).items():
            away.append((name, reason, students))
    return away


def _is_hard(part: PartNumbers) -> bool:
    return part.facility is not None and part.facility < HARD


def _facility(part: PartNumbers) -> float:
    return -1.0 if part.facility is None else part.facility


def _is_odd(part: PartNumbers) -> bool:
    return part.discrimination is not None and part.discrimination < ODD


def _sheet_block(course: Course, sheet: SheetResults) -> Block:
    counts = Counter(result.status for result in sheet.results)
    return {
        "name": sheet.sheet.name,
        "title": sheet.sheet.title or sheet.sheet.name,
        "mode": sheet.sheet.mode,
        "out_of": f"{sheet.out_of:g}",
        "graded": counts["graded"],
        "waiting": counts["not_graded"],
        "missing": counts["no_submission"],
        "unsafe": sum(result.unsafe for result in sheet.results),
        "parts": [_part_block(part) for part in part_numbers(sheet)],
        "mistakes": mistakes(sheet),
        "rows": [_row(course, sheet, result) for result in sheet.results],
        **_spread_block(sheet_shares(sheet), f"points of {sheet.sheet.name}"),
    }


def _part_block(numbers: PartNumbers) -> Block:
    mean = "–"
    if numbers.mean is not None:
        mean = f"{numbers.mean:.2f}"
    discrimination = "–"
    if numbers.discrimination is not None:
        discrimination = f"{numbers.discrimination:.2f}".replace("-", "−")
    return {
        "variable": numbers.part.variable,
        "points": f"{numbers.part.points:g}",
        "count": numbers.count,
        "mean": mean,
        "facility": _percent(numbers.facility),
        "sort": _facility(numbers),
        "is_hard": _is_hard(numbers),
        "discrimination": discrimination,
        "is_odd": _is_odd(numbers),
    }


def _row(course: Course, sheet: SheetResults, result: Result) -> Block:
    """One student in the table of a sheet."""
    by_part = {verdict.part: verdict for verdict in result.verdicts}
    groups: list[list[tuple[str, str, str]]] = []
    for exercise in sheet.exercises:
        group: list[tuple[str, str, str]] = []
        for part in exercise.asked:
            if part.variable in by_part:
                status = by_part[part.variable].status
                group.append((MARKS[status], status, f"{part.variable}: {STATUS_WORDS[status]}"))
        groups.append(group)
    return {
        "student": result.student,
        "groups": groups,
        "points": result_text(result),
        "sort": -1 if result.points is None else result.points,
        "remark": remark(result, public=True),
        "links": _links(course, sheet.sheet.name, result.student.id),
    }


def _links(course: Course, sheet: str, student: str) -> list[tuple[str, str]]:
    """Words and addresses of the files that are there of one student's sheet."""
    links: list[tuple[str, str]] = []
    places = {
        "sheet": f"released/{student}/{sheet}.ipynb",
        "submission": "",
        "feedback": f"feedback/{student}/{sheet}.html",
        "solution": f"solutions/{student}/{sheet}.ipynb",
    }
    for path in sorted((course.folder / "submitted" / student).glob(f"{sheet}.*")):
        places["submission"] = f"submitted/{student}/{path.name}"
    for words, place in places.items():
        if place and (course.folder / place).exists():
            links.append((words, f"../{place}"))
    return links


def _person(sheets: Sequence[SheetResults], i: int, total: Total) -> Block:
    """One student in the table of the course."""
    percent = "–"
    if total.percent is not None:
        percent = f"{total.percent:g} %"
    cells: list[tuple[str, str, float]] = []
    for sheet in sheets:
        result = sheet.results[i]
        points = -1.0 if result.points is None else result.points
        cells.append((sheet.sheet.name, result_text(result), points))
    return {
        "student": total.student,
        "cells": cells,
        "points": "–" if total.points is None else f"{total.points:g} / {total.out_of:g}",
        "percent": percent,
        "sort": -1 if total.percent is None else total.percent,
        "status": total.status.replace("_", " "),
    }
