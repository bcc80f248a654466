"""The cell of a sheet that needs nothing installed: which answers are there, finite, in shape."""

from collections.abc import Collection, Sequence
from importlib.resources import files

from ...exercises.exercise import Part
from ...exercises.kinds.manual import is_on_paper
from ..language.speech import later, phrase

TEMPLATE = "self_check.txt"
FOR = "# for "  # begins a line of the template that says of what kinds the next lines are
SENTENCES = (
    later("not answered yet"),
    later("takes a function"),
    later("takes one of {', '.join(map(repr, form))}, or the text of an option"),
    later("takes text in quotes"),
    later("takes a list of conditions in quotes"),
    later("not a table: takes a list of rows"),
    later("takes {form} rows of theta, d, a, alpha, got rows of {rows}"),
    later("takes formulas of shape {form}, got {shape}"),
    later("ready: typed text, read when the sheet is marked"),
    later("not numbers, or rows of different lengths"),
    later("takes rows of {form} numbers"),
    later("takes shape {form}, got {array.shape}"),
    later("holds NaN or infinity"),
    later("ready"),
)
"""What the cell says, as it stands in the template; what is in braces is Python."""


def self_check(parts: Sequence[Part]) -> str:
    """Python that says of every answer whether it is there; nothing of what is right."""
    lines: list[str] = []
    kinds: set[str] = {"all"}
    for part in parts:
        if is_on_paper(part.answer):
            continue
        kind, form = part.answer.self_check
        kinds.add(kind)
        lines.append(f"    {part.variable!r}: {(kind, form)!r},")

    template = files("kinegrade.course.sheet").joinpath(TEMPLATE).read_text(encoding="utf-8")
    program = _for_kinds(template, kinds)
    for sentence in SENTENCES:
        program = program.replace(f'"{sentence}"', f'"{phrase(sentence)}"')
    return program.replace("@ANSWERS@", "\n".join(lines)).rstrip("\n")


def _for_kinds(template: str, kinds: Collection[str]) -> str:
    """The lines that answers of some kinds need: a cell that is read, and run for every student."""
    kept: list[str] = []
    needed = True
    for line in template.splitlines():
        if line.startswith(FOR):
            needed = any(kind in kinds for kind in line.removeprefix(FOR).split())
        elif needed:
            kept.append(line)
    return "\n".join(kept)
