"""The cell of an answer as it is handed out, with its comments in the language of the sheet."""

from ...exercises.exercise import Part
from ..language.speech import retold

COMMENT = "  # "


def blank_text(part: Part) -> str:
    """Python of the answer's cell."""
    lines: list[str] = []
    for line in part.answer.blank(part.variable).split("\n"):
        code, mark, comment = line.partition(COMMENT)
        lines.append(f"{code}{mark}{retold(comment)}")
    return "\n".join(lines)
