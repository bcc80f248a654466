"""The first cell of a notebook: whose sheet it is, how it is handed in, its units and row order."""

from collections.abc import Sequence

from ...exercises.exercise import Rows
from ..config import LimitsTable, Sheet, Student
from ..escape import no_markup
from ..times import rules_text
from ..words import points_text
from .assignment import Assignment
from .given import unit_names

STACKED: dict[Rows, str] = {
    "linear, angular": "the linear rows stand above the angular ones",
    "angular, linear": "the angular rows stand above the linear ones",
}
NUMBERS = (
    "The numbers on this sheet are yours alone. Replace each `...` by your answer and keep the "
    "names of the variables: answers are collected by name."
)
HANDING_IN = (
    "At the end restart the kernel and run all cells - the sheet is marked in that way, from top "
    "to bottom - then save and hand in this file"
)
HANDING_IN_SCRIPT = (
    "At the end run the whole file - the sheet is marked in that way, from top to bottom - then "
    "save and hand in this file"
)
PRACTICE = (
    "Nothing of this is handed in: save, and `kinegrade check {own}` or `%check` tells what is "
    "right and what went wrong, as often as you like."
)
SOLVED = (
    "Every part with its question, the way to its answer, and the answer with your numbers. Run "
    "from top to bottom, the cells leave all answers in their variables."
)
TIME = (
    "When it is marked, a cell may compute for {cell:g} s, and all cells together may take "
    "{notebook:g} s."
)
ROUNDING = "Round only what you hand in, and compute on with all digits."


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
    rules = f"{conventions(assignments)} {ROUNDING}"
    time = TIME.format(cell=limits.cell_seconds, notebook=limits.notebook_seconds)
    about = _about(course, sheet, student, assignments)
    handing_in = f"{NUMBERS} {_handing_in(sheet, student, own)} {time}"
    blocks = [title, about, own_rules(sheet), handing_in, rules]
    return "\n\n".join(filter(None, blocks))


def own_rules(sheet: Sheet) -> str:
    """What an instructor wrote for this sheet, and when it is to be handed in; may be empty."""
    return "\n\n".join(filter(None, [sheet.instructions.strip(), rules_text(sheet)]))


def minutes_text(sheet: Sheet, assignments: Sequence[Assignment]) -> str:
    """How long a sheet is said to take, as "90 minutes"."""
    minutes = sheet.minutes or sum(one.exercise.minutes for one in assignments)
    return f"{minutes} minutes"


def _handing_in(sheet: Sheet, student: Student, own: str) -> str:
    """What is done with the file at the end; of what a student drew for practice, nothing."""
    if not student.id:
        return PRACTICE.format(own=own)
    others = [f"{sheet.name}{ending}" for ending in _starters(sheet)]
    others = [f"`{other}`" for other in others if other != own]
    last = HANDING_IN_SCRIPT if own.endswith(".py") else HANDING_IN
    if not others:
        return f"{last}."
    places = " or ".join(others)
    return f"{last}, or answer in {places} in its place. Of several files the newest counts."


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
    title = f"# {sheet.title or sheet.name}: worked solution"
    rules = f"{SOLVED} {conventions(assignments)}"
    return "\n\n".join([title, _about(course, sheet, student, assignments), rules])


def _about(course: str, sheet: Sheet, student: Student, assignments: Sequence[Assignment]) -> str:
    points = sum(one.exercise.points for one in assignments)
    name = no_markup(student.name) or student.id
    who = f"**{name}** (`{student.id}`)" if student.id else f"**{name}**"
    return (
        f"{course} · sheet `{sheet.name}` · {who} · {points_text(points)} · "
        f"about {minutes_text(sheet, assignments)}"
    )


def conventions(assignments: Sequence[Assignment]) -> str:
    """Units, and the order of rows where it is the same everywhere."""
    sentences = [f"Units are {_units(assignments)}."]
    orders = row_orders(assignments)
    if len(orders) == 1:  # else each exercise says its own
        sentences.append(f"In every Jacobian and twist {STACKED[orders.pop()]}.")
    return " ".join(sentences)


def row_orders(assignments: Sequence[Assignment]) -> set[Rows]:
    """The orders of the rows of Jacobians and twists that the exercises of a sheet take."""
    return {one.exercise.rows for one in assignments}


def _units(assignments: Sequence[Assignment]) -> str:
    """The basic units of a sheet; newtons where a force or a moment is on it."""
    for one in assignments:
        for name in unit_names(one.exercise.units.values()):
            if name.startswith("N"):
                return "metres, radians, seconds and newtons"
    return "metres, radians and seconds"
