"""What a PDF shows, as data for its template: text as text, formulas from our own printer."""

from collections.abc import Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from ...exercises.exercise import Choice, Exercise, Manual, Numbers, Part
from ...exercises.kinds.paper import Paper
from ..language.speech import language_spoken, later, phrase
from ..language.writing import number_text
from ..settings.config import Sheet, Student
from ..sheet.assignment import Assignment, Figure
from ..sheet.given import given_form, given_formulas
from ..sheet.heading import (
    conventions,
    minutes_text,
    own_rules,
    rounding,
    row_orders,
)
from ..sheet.question import asked, order_text
from ..text.escape import printable
from ..text.words import points_text
from .formula import formula
from .mathml import FormulaError
from .prose import Block, formula_data, line, prose

Data = dict[str, Any]
LETTERS = "abcdefghijklmnopqrstuvwxyz"
HANDING_IN = later("The numbers on this sheet are yours alone.")
ANSWERING = later(
    "Write each answer into its boxes or onto its lines. The numbers at the left of a grid count "
    "its rows, those above it its columns."
)
EXAM = later(
    "Write into the boxes and onto the lines of the answer sheet. Every page carries the code of "
    "your variant; your name stands on this page alone."
)
SOLVED = later(
    "Every part with its question, the way to its answer, and the answer with your numbers."
)
WORDS = {
    "answer_sheet": later("Answer sheet"),
    "exercise": later("Exercise"),
    "first_try": later("First try without."),
    "for_points": later("For the points:"),
    "hints": later("Hints"),
    "matrix": later("matrix"),
    "name": later("Name"),
    "points": later("Points"),
    "reached": later("Reached"),
    "signature": later("Signature"),
    "solution": later("Solution."),
    "student": later("Student"),
    "time": later("Time"),
    "together": later("Together"),
    "of_variant": later("variant"),
    "variant": later("Variant"),
    "your_numbers": later("Your numbers:"),
}
"""Words of the template, by the names that it uses."""


@dataclass(frozen=True)
class Front:
    """Whose document it is: what its heading and the head of every page say."""

    course: str
    sheet: Sheet
    student: Student
    code: str

    @property
    def title(self) -> str:
        """The sheet's title, or its name."""
        return self.sheet.title or self.sheet.name

    @property
    def is_exam(self) -> bool:
        """Whether nothing but the questions may be told."""
        return self.sheet.mode == "exam"


def handout_data(front: Front, assignments: Sequence[Assignment]) -> Data:
    """The data of a personal sheet with its answer sheet; an exam has no hints.

    Raises:
        ExerciseError: an exercise fails on the student's numbers.
        FormulaError: a formula cannot be set; the sentence names exercise and part.
    """
    opening = EXAM if front.is_exam else HANDING_IN
    rules = f"{phrase(opening)} {conventions(assignments)} {rounding(front.sheet)}"
    own = own_rules(front.sheet)
    if own:
        rules = f"{own}\n\n{rules}"
    data = _document(front, assignments, rules)
    for one, shown in zip(assignments, data["exercises"], strict=True):
        for part, about in zip(one.exercise.asked, shown["parts"], strict=True):
            with _named(one.exercise, part.variable):
                about.update(_blank(part, hints=not front.is_exam))
    return data | {"kind": "handout", "foot": "", "answering": phrase(ANSWERING)}


def solution_data(front: Front, assignments: Sequence[Assignment]) -> Data:
    """The data of a worked solution.

    Raises:
        ExerciseError: an exercise fails on the student's numbers.
        FormulaError: a formula cannot be set; the sentence names exercise and part.
    """
    data = _document(front, assignments, f"{phrase(SOLVED)} {conventions(assignments)}")
    for one, shown in zip(assignments, data["exercises"], strict=True):
        shown["solved"] = [*map(_figure, one.solved_figures)]
        for part, about in zip(one.exercise.asked, shown["parts"], strict=True):
            with _named(one.exercise, part.variable):
                about.update(_solution(one, part))
    return data | {"kind": "solution", "foot": phrase("Worked solution")}


@contextmanager
def _named(exercise: Exercise, place: str) -> Generator[None]:
    """Puts the exercise and the place in it before what is said of a formula there."""
    try:
        yield
    except FormulaError as error:
        raise FormulaError(f"exercise {exercise.slug}, {place}: {error}") from error


def _document(front: Front, assignments: Sequence[Assignment], rules: str) -> Data:
    """What sheet and solution have in common."""
    points = sum(one.exercise.points for one in assignments)
    differ = len(row_orders(assignments)) > 1
    exercises: list[Data] = []
    for number, one in enumerate(assignments, 1):
        exercises.append(_exercise(number, one, order=differ))
    title = printable(front.title)
    name, minutes = printable(front.student.name), minutes_text(front.sheet, assignments)
    return {
        "mode": front.sheet.mode,
        "language": language_spoken(),
        "words": {name: phrase(word) for name, word in WORDS.items()},
        "solution_title": phrase("{title}: worked solution", title=title),
        "about_minutes": phrase("about {minutes}", minutes=minutes),
        "course": printable(front.course),
        "title": title,
        "name": name,
        "student": front.student.id,
        "code": front.code,
        "points": points_text(points),
        "worth": number_text(points),
        "minutes": minutes,
        "rules": prose(rules),
        "exercises": exercises,
    }


def _exercise(number: int, one: Assignment, *, order: bool) -> Data:
    """Heading, statement, numbers, figures and questions."""
    exercise = one.exercise
    parts: list[Data] = []
    for letter, part in zip(LETTERS, exercise.asked, strict=False):
        with _named(exercise, part.variable):
            parts.append(_part(letter, part))

    with _named(exercise, "statement"):
        inline, displayed = given_formulas(exercise, one.v)
        return {
            "number": number,
            "title": line(exercise.title),
            "points": points_text(exercise.points),
            "worth": number_text(exercise.points),
            "objectives": line(" ".join(exercise.objectives)),
            "order": line(order_text(exercise) if order else ""),
            "statement": prose(exercise.statement(one.v)),
            "numbers": {
                "inline": [*map(_formula, inline)],
                "displayed": [*map(_formula, displayed)],
                "form": line(given_form(exercise, one.v)),
            },
            "figures": [*map(_figure, one.figures)],
            "parts": parts,
        }


def _figure(figure: Figure) -> Data:
    """A drawing; its ratio spares Typst to look into it before it is placed."""
    return {
        "svg": figure.svg,
        "caption": line(figure.caption),
        "alt": figure.alt,
        "ratio": figure.ratio,
    }


def _part(letter: str, part: Part) -> Data:
    """The question, and its options where it is a choice."""
    options: list[Data] = []
    if isinstance(part.answer, Choice):
        for option, text in zip(part.answer.letters, part.answer.options, strict=True):
            options.append({"letter": option, "text": line(text)})
    return {
        "letter": letter,
        "variable": part.variable,
        "points": points_text(part.points),
        "question": prose(asked(part).removeprefix(f"({letter}) ")),
        "options": options,
    }


def _blank(part: Part, *, hints: bool) -> Data:
    """Hints, and the place for the answer."""
    told = part.hints if hints else ()
    return {
        "hints": [*map(line, told)],
        "paper": _paper(part.answer.paper),
    }


def _paper(paper: Paper) -> Data:
    return {
        "rows": [*map(_formula, paper.rows)],
        "columns": [*map(_formula, paper.columns)],
        "grids": paper.grids,
        "wide": paper.wide,
        "lines": paper.lines,
        "letters": list(paper.letters),
    }


def _formula(latex: str) -> Data:
    if not latex:
        return {"math": "", "alt": ""}
    return formula_data(formula(latex))


def _solution(one: Assignment, part: Part) -> Data:
    """The steps, what earns points by hand, and the answer as it is typed or written."""
    steps: list[Block] = []
    for step in one.solution[part.variable]:
        steps += prose(step)

    answer = one.answers[part.variable]
    if isinstance(part.answer, Manual):
        lines: list[str] = []
        for points, text in part.answer.rubric:
            lines.append(f"{points_text(points)}: {text}")
        key = "" if steps else answer
        return {"steps": steps, "rubric": lines, "key": key, "code": ""}

    if isinstance(part.answer, Choice):
        return {
            "steps": steps,
            "rubric": [],
            "key": phrase("Answer: {letter}", letter=answer),
            "code": "",
        }

    code = ""
    if not steps or not isinstance(part.answer, Numbers):  # of numbers, the last step shows them
        code = part.answer.code(part.variable, answer)
    return {"steps": steps, "rubric": [], "key": "", "code": code}
