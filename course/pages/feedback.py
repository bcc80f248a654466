"""A student's feedback: own question and answer, what was found, points, and the rules."""

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from markupsafe import Markup

from ...exercises.exercise import Choice, Exercise, Manual, Part, references
from ...grader.marking.verdict import ENTRIES_FOLLOW, STATUS_WORDS, Verdict
from ..language.speech import later, phrase, retold, speaking
from ..language.translated import translated, translations
from ..language.writing import number_text
from ..results.requests import how_to_ask
from ..results.result import Result
from ..results.tables import MARKS, result_text
from ..settings.config import Course, MarkingTable, Sheet
from ..settings.times import late_text, rules_text
from ..sheet.worked import worked_steps
from ..text.escape import printable
from ..text.markdown import markdown_html
from ..text.words import points_text, share_text
from ..variants.record import Record
from .entries import Cell, entry_tables
from .explained import explained
from .own_sheet import own_questions
from .page import template, with_formulas, write_page
from .position import position
from .sentences import sentence

log = logging.getLogger(__name__)
LOST = later("A figure that belongs here could not be drawn. Your points do not depend on it.")
T = TypeVar("T")
Block = dict[str, Any]
"""What a template shows of one thing, by the names that it uses."""
Records = Mapping[str, Record]
"""Exercise to what was drawn of it for one student."""


@dataclass(frozen=True)
class _Own:
    """One exercise of one student.

    Attributes:
        exercise: The exercise.
        record: The student's numbers and reference answers; None where none are recorded.
        verdicts: By variable.
        question: HTML of what was asked, with own numbers and figures.
        solved: Whether the worked solution is shown.
    """

    exercise: Exercise
    record: Record | None
    verdicts: Mapping[str, Verdict]
    question: str
    solved: bool


def write_feedback(
    course: Course,
    sheet: Sheet,
    exercises: Sequence[Exercise],
    result: Result,
    records: Records | None = None,
) -> Path:
    """feedback/<student>/<sheet>.html, which needs nothing else.

    It holds no reference value, unless the sheet shows its solutions.
    """
    beside = translations(sheet.exercises, sheet.language, course.folder / "exercises")
    shown = [translated(one, sheet.language, beside.get(one.slug)) for one in exercises]
    with speaking(sheet.language, tuple(beside.values())):
        html = _page(course, sheet, shown, result, records or {})
    path = course.folder / "feedback" / result.student.id / f"{sheet.name}.html"
    with speaking(sheet.language):
        write_page(path, html, synced=False)  # the next run looks at what it holds
    return path


def _page(
    course: Course,
    sheet: Sheet,
    exercises: Sequence[Exercise],
    result: Result,
    drawn: Records,
) -> str:
    """The page in the language that is spoken."""
    student = result.student
    released = course.folder / "released" / student.id / f"{sheet.name}.ipynb"
    numbers = {slug: record.numbers for slug, record in drawn.items()}
    questions = _or_nothing("question", own_questions, released, exercises, numbers) or {}
    verdicts = {verdict.part: verdict for verdict in result.verdicts}
    blocks: list[Block] = []
    for exercise in exercises:
        own = _Own(
            exercise,
            drawn.get(exercise.slug),
            verdicts,
            questions.get(exercise.slug, ""),
            sheet.show_solutions,
        )
        blocks.append(_exercise_block(own))

    return template("feedback.html").render(
        course=course.settings.title,
        sheet=sheet.title or sheet.name,
        student=student,
        points=result_text(result),
        waiting=result.status == "not_graded",
        notes=_notes(sheet, result),
        asking=how_to_ask(sheet.name),
        handing_in=rules_text(sheet),
        solved=sheet.show_solutions,
        passed_over=result.passed_over,
        blocks=blocks,
        rules=_rules(course.settings.marking),
        marks=[(MARKS[status], status, retold(words)) for status, words in STATUS_WORDS.items()],
    )


def _notes(sheet: Sheet, result: Result) -> list[str]:
    """What deadline, attempts and publication make of the points, a sentence each."""
    notes = [late_text(result.late)]
    if result.attempts.of > 1:
        attempts = result.attempts
        notes.insert(0, phrase("This is file {this} of {of}.", this=attempts.this, of=attempts.of))
    if result.excused:
        notes.insert(0, phrase("You are excused from this sheet: it does not count for you."))
    return [note for note in notes if note]


def _exercise_block(own: _Own) -> Block:
    parts = _part_blocks(own)
    earned, waits = 0.0, False
    for part in own.exercise.asked:
        if part.variable not in own.verdicts:
            continue
        worth = own.verdicts[part.variable].points
        earned += worth or 0.0
        waits = waits or worth is None
    numbers = None if own.record is None else own.record.numbers
    map_of_q, lost = _drawn("map", position, own.exercise, numbers)
    points = number_text(round(earned, 2))
    if waits:
        points += " + ?"
    return {
        "title": own.exercise.title,
        "points": phrase(
            "{points} of {out_of}", points=points, out_of=points_text(own.exercise.points)
        ),
        "question": Markup(own.question),  # noqa: S704 - the exercise's own text and numbers
        "position": map_of_q,
        "no_position": lost,
        "parts": parts,
    }


def _or_nothing(what: str, make: Callable[..., T], *of: Any) -> T | None:
    """What is made; None where it cannot be, as of an exercise that was edited since.

    A student's points do not wait for a picture.
    """
    try:
        return make(*of)
    except Exception:
        log.exception("a %s is left out of the feedback", what)
        return None


def _drawn(what: str, make: Callable[..., T], *of: Any) -> tuple[T | None, str]:
    """A picture, and nothing; where it cannot be drawn nothing, and a sentence in its place."""
    try:
        return make(*of), ""
    except Exception:
        log.exception("a %s is left out of the feedback", what)
        return None, phrase(LOST)


def _part_blocks(own: _Own) -> list[Block]:
    """Every part that has a verdict, with its figure and, where it is shown, its solution."""
    solutions: dict[str, Block] = {}
    if own.solved and own.record is not None:
        solutions = _or_nothing("solution", _solutions, own.exercise, own.record.numbers) or {}

    blocks: list[Block] = []
    figures: list[Any] = [None]
    told = {""}
    for part in own.exercise.asked:
        verdict = own.verdicts.get(part.variable)
        if verdict is None:
            continue
        block = feedback_block(part, verdict)
        block["solution"] = solutions.get(part.variable)
        if own.record is not None:
            figure, lost = _drawn("figure", explained, own.exercise, part, own.record, verdict)
            if lost not in told:
                told.add(lost)
                block["no_figure"] = lost
            if figure not in figures:  # the same motion is asked in several ways
                figures.append(figure)
                block["figure"] = figure
        blocks.append(block)
    return blocks


def feedback_block(part: Part, verdict: Verdict) -> Block:
    """What a feedback page says of one part."""
    answer = part.answer
    points = "–"
    if verdict.points is not None:
        points = number_text(verdict.points)

    options: list[Markup] = []
    if isinstance(answer, Choice):
        options = [with_formulas(option) for option in answer.options]

    text: Any = None
    rubric: list[tuple[str, str]] = []
    if isinstance(answer, Manual):
        text = verdict.answer
        rubric = [(number_text(worth), criterion) for worth, criterion in answer.rubric]

    return {
        "variable": part.variable,
        "prompt": with_formulas(part.prompt),
        "status": verdict.status,
        "words": retold(STATUS_WORDS[verdict.status]),
        "mark": MARKS[verdict.status],
        "points": points,
        "out_of": number_text(verdict.out_of),
        "reading": retold(verdict.reading),
        "sentence": sentence(part, verdict),
        "findings": _findings(verdict, by_person=False),
        "comments": _findings(verdict, by_person=True),
        "from_own": _is_from_own(verdict),
        "matrices": _matrices(part, verdict),
        "options": options,
        "text": text,
        "rubric": rubric,
    }


def _is_from_own(verdict: Verdict) -> bool:
    """Whether entries are marked right because they follow from own answers that are not."""
    said = any(finding.text.startswith(ENTRIES_FOLLOW) for finding in verdict.findings)
    return verdict.status == "follows" or said


def _findings(verdict: Verdict, *, by_person: bool) -> list[dict[str, str]]:
    """What the student may read: a sentence each, and the typed lines with a caret below it."""
    shown: list[dict[str, str]] = []
    for finding in verdict.findings:
        if finding.private or finding.by_person != by_person:
            continue
        said, *typed = [printable(line) for line in finding.text.split("\n")]
        sentence_of = said if by_person else retold(said)
        shown.append({"sentence": sentence_of, "typed": "\n".join(typed)})
    return shown


def _matrices(part: Part, verdict: Verdict) -> list[list[list[Cell]]]:
    if verdict.answer is None or verdict.right is None:
        return []
    decimals = getattr(part.answer, "decimals", 0)
    return entry_tables(verdict.answer, verdict.right, decimals)


def _solutions(exercise: Exercise, v: dict[str, Any]) -> dict[str, Block]:
    """The worked solution of every part: its steps, and the answer as it would be handed in."""
    answers = references(exercise, v)
    solutions: dict[str, Block] = {}
    for part in exercise.asked:
        steps = [_html(step) for step in worked_steps(part, v, answers)]
        reference = answers[part.variable]
        shown: Block = {"steps": steps, "code": "", "key": ""}
        if isinstance(part.answer, Manual):
            shown["key"] = str(reference)
        else:
            shown["code"] = part.answer.code(part.variable, reference)
        solutions[part.variable] = shown
    return solutions


def _html(text: str) -> Markup:
    return Markup(markdown_html(text))  # noqa: S704 - the exercise's own text


def _rules(marking: MarkingTable) -> dict[str, str]:
    """What each kind of mistake costs, in words."""
    costs = marking.model_dump()
    return {kind: share_text(share) for kind, share in costs.items()}
