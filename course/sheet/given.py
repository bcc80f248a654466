"""The numbers drawn for a student, as a sheet prints them: named in Python, and as formulas."""

from collections.abc import Iterator
from typing import Any, cast

from ...exercises.exercise import Exercise
from ...exercises.kinds.kind import listed_rows
from ...solutions.expression import latex_name
from ..language.speech import phrase
from ..text.formulas import given_number


def printed(exercise: Exercise, v: dict[str, Any]) -> dict[str, Any]:
    """What the sheet prints of the drawn numbers: those with a unit, and the choices of form."""
    shown: dict[str, Any] = {}
    for name in (*exercise.units, *exercise.structure):
        if name in v:
            shown[name] = v[name]
    return shown


def given(exercise: Exercise, v: dict[str, Any]) -> Iterator[tuple[str, Any, Any]]:
    """Name, value and unit of every number that is printed, in the order of the units.

    The unit of a vector or matrix may be a list of units, or of such lists.
    """
    for name, unit in exercise.units.items():
        if name in v:
            yield name, v[name], unit


def unit_names(unit: Any) -> list[str]:
    """The units in a unit, each once: "m, rad" of a vector whose entries have these."""
    if isinstance(unit, str):
        return [unit]
    names: list[str] = []
    for inner in unit:
        names += unit_names(inner)
    return [*dict.fromkeys(names)]


def given_cell(exercise: Exercise, v: dict[str, Any]) -> str:
    """Python that sets every printed number under a name of its own, such as rrt_d1."""
    head = phrase(
        "# Your numbers for {slug}, in metres, radians and seconds. "
        "Run this cell, do not change it.",
        slug=exercise.slug,
    )
    lines = [head]
    for name, value, unit in given(exercise, v):
        units = ", ".join(unit_names(unit))
        lines.append(f"{exercise.slug}_{name} = {_python(value)}  # [{units}]")
    return "\n".join(lines)


def _python(value: Any) -> str:
    """A number or text as it is, a list as an array; a matrix has a line for every row."""
    if not isinstance(value, list):
        return repr(value)
    entries = cast("list[Any]", value)
    if isinstance(entries[0], list):
        return f"np.array({listed_rows(entries)})"
    return f"np.array({entries!r})"


def given_numbers(exercise: Exercise, v: dict[str, Any]) -> list[str]:
    """Markdown: numbers and vectors in one line, every matrix on its own."""
    inline, displayed = given_formulas(exercise, v)
    line = r", $\quad$ ".join(f"${latex}$" for latex in inline)
    return [f"**{phrase('Your numbers:')}** {line}", *[f"$${latex}$$" for latex in displayed]]


def given_formulas(exercise: Exercise, v: dict[str, Any]) -> tuple[list[str], list[str]]:
    """LaTeX of every printed number: of numbers and vectors, and of matrices."""
    inline: list[str] = []
    displayed: list[str] = []
    for name, value, unit in given(exercise, v):
        symbol = exercise.symbols.get(name) or _symbol(name, value)
        latex = given_number(symbol, value, unit)
        if "bmatrix" in latex:
            displayed.append(latex)
        else:
            inline.append(latex)
    return inline, displayed


def given_form(exercise: Exercise, v: dict[str, Any]) -> str:
    """Markdown of the choices of form, in one line; empty where an exercise has none."""
    chosen = [f"`{name} {_plainly(v[name])}`" for name in exercise.structure if name in v]
    if not chosen:
        return ""
    form = ", ".join(chosen)
    return phrase(
        "*Your variant of this exercise, to name when you ask about it: {form}.*", form=form
    )


def _plainly(value: Any) -> str:
    """A choice of form without brackets and quotes."""
    if isinstance(value, list):
        return ", ".join(_plainly(inner) for inner in cast("list[Any]", value))
    return str(value)


def _symbol(name: str, value: Any) -> str:
    """LaTeX of a printed name; vectors and matrices are bold, their indices are not."""
    latex = latex_name(name)
    if not isinstance(value, list):
        return latex
    stem, underscore, index = latex.partition("_")
    # \mathbf has no Greek letters
    bold = r"\boldsymbol" if stem.startswith("\\") else r"\mathbf"
    return f"{bold}{{{stem}}}{underscore}{index}"
