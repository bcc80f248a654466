"""The cell of a sheet that needs nothing installed: which answers are there, finite, in shape."""

from collections.abc import Sequence
from importlib.resources import files

from ...exercises.exercise import Part
from ...exercises.kinds.manual import is_on_paper

TEMPLATE = "templates/self_check.txt"


def self_check(parts: Sequence[Part]) -> str:
    """Python that says of every answer whether it is there; nothing of what is right."""
    lines: list[str] = []
    for part in parts:
        if is_on_paper(part.answer):
            continue
        lines.append(f"    {part.variable!r}: {part.answer.self_check!r},")

    template = files("kinegrade.course").joinpath(TEMPLATE).read_text(encoding="utf-8")
    return template.replace("@ANSWERS@", "\n".join(lines)).rstrip("\n")
