"""The first cell of a notebook: whose sheet it is, how it is handed in, its units and row order."""

from collections.abc import Sequence

from ...exercises.exercise import Rows
from ..config import LimitsTable, Sheet, Student
from ..escape import no_markup
from ..words import points_text
from .given import Pair, unit_names

STACKED: dict[Rows, str] = {
    "linear, angular": "the linear rows stand above the angular ones",
    "angular, linear": "the angular rows stand above the linear ones",
}
HANDING_IN = (
    "The numbers on this sheet are yours alone. Replace each `...` by your answer and keep the "
    "names of the variables: answers are collected by name. At the end restart the kernel and run "
    "all cells - the sheet is marked in that way, from top to bottom - then save and hand in this "
    "file."
)
TIME = (
    "When it is marked, a cell may compute for {cell:g} s, and all cells together may take "
    "{notebook:g} s."
)
ROUNDING = "Round only what you hand in, and compute on with all digits."


def heading(
    course: str, sheet: Sheet, student: Student, pairs: Sequence[Pair], limits: LimitsTable
) -> str:
    """Markdown of a sheet's title, its student, its points, and what holds for all exercises."""
    points = sum(exercise.points for exercise, _ in pairs)
    minutes = sum(exercise.minutes for exercise, _ in pairs)
    name = no_markup(student.name) or student.id
    about = (
        f"{course} · sheet `{sheet.name}` · **{name}** (`{student.id}`) · "
        f"{points_text(points)} · about {minutes} minutes"
    )

    conventions = [f"Units are {_units(pairs)}."]
    orders = row_orders(pairs)
    if len(orders) == 1:  # else each exercise says its own
        conventions.append(f"In every Jacobian and twist {STACKED[orders.pop()]}.")
    conventions.append(ROUNDING)
    time = TIME.format(cell=limits.cell_seconds, notebook=limits.notebook_seconds)
    title = f"# {sheet.title or sheet.name}"
    return "\n\n".join([title, about, f"{HANDING_IN} {time}", " ".join(conventions)])


def row_orders(pairs: Sequence[Pair]) -> set[Rows]:
    """The orders of the rows of Jacobians and twists that the exercises of a sheet take."""
    return {exercise.rows for exercise, _ in pairs}


def _units(pairs: Sequence[Pair]) -> str:
    """The basic units of a sheet; newtons where a force or a moment is on it."""
    for exercise, _ in pairs:
        for name in unit_names(exercise.units.values()):
            if name.startswith("N"):
                return "metres, radians, seconds and newtons"
    return "metres, radians and seconds"
