"""The first cell of a notebook: whose sheet it is, how it is handed in, its units and row order."""

from collections.abc import Sequence

from ...exercises.exercise import Rows
from ..language.speech import ENGLISH, later, phrase, phrase_count
from ..settings.config import LimitsTable, Sheet, Student
from ..settings.times import rules_text
from ..text.escape import no_markup
from ..text.words import points_text
from .assignment import Assignment
from .given import unit_names

STACKED: dict[Rows, str] = {
    "linear, angular": later("the linear rows stand above the angular ones"),
    "angular, linear": later("the angular rows stand above the linear ones"),
}
NUMBERS = later(
    "The numbers on this sheet are yours alone. Replace each `...` by your answer and keep the "
    "names of the variables: answers are collected by name."
)
HANDING_IN = later(
    "At the end restart the kernel and run all cells - the sheet is marked in that way, from top "
    "to bottom - then save and hand in this file."
)
HANDING_IN_SCRIPT = later(
    "At the end run the whole file - the sheet is marked in that way, from top to bottom - then "
    "save and hand in this file."
)
IN_PLACE = later("Or answer in {places} in its place. Of several files the newest counts.")
PRACTICE = later(
    "Nothing of this is handed in: save, and `kinegrade check {own}` or `%check` tells what is "
    "right and what went wrong, as often as you like."
)
SOLVED = later(
    "Every part with its question, the way to its answer, and the answer with your numbers. Run "
    "from top to bottom, the cells leave all answers in their variables."
)
TIME = later(
    "When it is marked, a cell may compute for {cell} s, and all cells together may take "
    "{notebook} s."
)
ROUNDING = later("Round only what you hand in, and compute on with all digits.")
POINT = later("Numbers stand on this sheet as in Python, with a decimal point: type them so, too.")


def heading(
    course: str,
    sheet: Sheet,
    student: Student,
    assignments: Sequence[Assignment],
    limits: LimitsTable,
    own: str,
) -> str:
    """Markdown of a sheet's title, its student, its points, and what holds for all exercises.

    `own` is the name of the file in which it stands.
    """
    title = f"# {sheet.title or sheet.name}"
    rules = f"{conventions(assignments)} {rounding(sheet)}"
    time = phrase(TIME, cell=f"{limits.cell_seconds:g}", notebook=f"{limits.notebook_seconds:g}")
    about = _about(course, sheet, student, assignments)
    handing_in = f"{phrase(NUMBERS)} {_handing_in(sheet, student, own)} {time}"
    blocks = [title, about, own_rules(sheet), handing_in, rules]
    return "\n\n".join(filter(None, blocks))


def rounding(sheet: Sheet) -> str:
    """How numbers are handed in, where their sign is another in the sheet's language, too."""
    if sheet.language == ENGLISH:
        return phrase(ROUNDING)
    return f"{phrase(ROUNDING)} {phrase(POINT)}"


def own_rules(sheet: Sheet) -> str:
    """What an instructor wrote for this sheet, and when it is to be handed in; may be empty."""
    return "\n\n".join(filter(None, [sheet.instructions.strip(), rules_text(sheet)]))


def minutes_text(sheet: Sheet, assignments: Sequence[Assignment]) -> str:
    """How long a sheet is said to take, as "90 minutes"."""
    minutes = sheet.minutes or sum(one.exercise.minutes for one in assignments)
    return phrase_count("{number} minute", "{number} minutes", minutes)


def _handing_in(sheet: Sheet, student: Student, own: str) -> str:
    """What is done with the file at the end; of what a student drew for practice, nothing."""
    if not student.id:
        return phrase(PRACTICE, own=own)
    others = [f"{sheet.name}{ending}" for ending in _starters(sheet)]
    others = [f"`{other}`" for other in others if other != own]
    last = HANDING_IN_SCRIPT if own.endswith(".py") else HANDING_IN
    if not others:
        return phrase(last)
    return f"{phrase(last)} {phrase(IN_PLACE, places=phrase(' or ').join(others))}"


def _starters(sheet: Sheet) -> list[str]:
    """Endings of what is handed out and can be handed in."""
    endings = [".ipynb"]
    if sheet.python:
        endings.append(".py")
    return endings


def solution_heading(
    course: str, sheet: Sheet, student: Student, assignments: Sequence[Assignment]
) -> str:
    """Markdown of the title of a worked solution; its reader hands in nothing any more."""
    title = phrase("# {title}: worked solution", title=sheet.title or sheet.name)
    rules = f"{phrase(SOLVED)} {conventions(assignments)}"
    return "\n\n".join([title, _about(course, sheet, student, assignments), rules])


def _about(course: str, sheet: Sheet, student: Student, assignments: Sequence[Assignment]) -> str:
    points = sum(one.exercise.points for one in assignments)
    name = no_markup(student.name) or student.id
    who = f"**{name}** (`{student.id}`)" if student.id else f"**{name}**"
    return phrase(
        "{course} · sheet `{sheet}` · {who} · {points} · about {minutes}",
        course=course,
        sheet=sheet.name,
        who=who,
        points=points_text(points),
        minutes=minutes_text(sheet, assignments),
    )


def conventions(assignments: Sequence[Assignment]) -> str:
    """Units, and the order of rows where it is the same everywhere."""
    sentences = [phrase(_units(assignments))]
    orders = row_orders(assignments)
    if len(orders) == 1:  # else each exercise says its own
        rows = phrase(STACKED[orders.pop()])
        sentences.append(phrase("In every Jacobian and twist {rows}.", rows=rows))
    return " ".join(sentences)


def row_orders(assignments: Sequence[Assignment]) -> set[Rows]:
    """The orders of the rows of Jacobians and twists that the exercises of a sheet take."""
    return {one.exercise.rows for one in assignments}


def _units(assignments: Sequence[Assignment]) -> str:
    """Of the basic units of a sheet; newtons where a force or a moment is on it."""
    for one in assignments:
        for name in unit_names(one.exercise.units.values()):
            if name.startswith("N"):
                return later("Units are metres, radians, seconds and newtons.")
    return later("Units are metres, radians and seconds.")
