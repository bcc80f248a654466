"""A sheet as a .py file in blocks, for who writes no notebooks; the same cells as the notebook."""

from collections.abc import Iterator, Sequence
from typing import Any

from ..settings.config import LimitsTable, PackagesTable, Sheet, Student
from .about import about_line
from .assignment import Assignment
from .notebook import handout_cells, self_description

IMAGE = "| <img "
ABOUT = "What `kinegrade check` reads; leave the line below as it is."


def script(
    course: str,
    sheet: Sheet,
    student: Student,
    assignments: Sequence[Assignment],
    limits: LimitsTable | None = None,
    packages: PackagesTable | None = None,
) -> str:
    """The text of a script in the percent format, the same every time.

    Spyder, Visual Studio Code and Jupytext run its blocks one by one; `python` runs all of it.

    Raises:
        ExerciseError: an exercise fails on the student's numbers.
    """
    lines: list[str] = []
    for cell in handout_cells(course, sheet, student, assignments, limits, own=f"{sheet.name}.py"):
        lines += [*_block(cell, sheet), ""]
    about = self_description(sheet, student, assignments, limits, packages)
    lines += ["# %% [markdown]", f"# {ABOUT}", about_line(about)]
    return "\n".join(lines) + "\n"


def _block(cell: Any, sheet: Sheet) -> Iterator[str]:
    if cell["cell_type"] == "code":
        yield "# %%"
        yield from cell["source"].split("\n")
        return
    yield "# %% [markdown]"
    for line in _without_images(cell["source"].split("\n"), sheet):
        yield f"# {line}".rstrip()


def _without_images(lines: Sequence[str], sheet: Sheet) -> Iterator[str]:
    """Markdown with a line that says where its figures are; their captions stay."""
    for number, line in enumerate(lines):
        if line.startswith(IMAGE):
            yield f"*Figures, which {sheet.name}.ipynb shows:*"
        elif number == 0 or not lines[number - 1].startswith(IMAGE):
            yield line
