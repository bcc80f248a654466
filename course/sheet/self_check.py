"""The cell of a sheet that needs nothing installed: which answers are there, of the right shape and finite."""

from collections.abc import Sequence
from importlib.resources import files

from ...exercises.exercise import Part
from ...exercises.kinds.manual import is_on_paper


def self_check(parts: Sequence[Part]) -> str:
    """Python that says of every answer whether it is there; nothing of what is right."""
    expected = {
        part.variable: part.answer.self_check for part in parts if not is_on_paper(part.answer)
    }
    listed = "\n".join(f"    {variable!r}: {kind!r}," for variable, kind in expected.items())
    template = (
        files("kinegrade.course").joinpath("templates/self_check.txt").read_text(encoding="utf-8")
    )
    return template.replace("@ANSWERS@", listed).rstrip("\n")
