"""What students ask to have looked at again: a text file beside what they handed in."""

import re
from pathlib import Path

from ..language.speech import later, phrase
from ..ledger.gradebook import Gradebook
from ..ledger.term import Request
from ..settings.asked import asked_parts, exercises_of
from ..settings.config import Course, Sheet
from ..sheet.about import REQUEST
from ..sheet.upload import is_own_file
from ..text.escape import printable_lines

MOST = 20_000  # bytes that are read of a file
WHOLE = "the whole sheet"
NAMED = re.compile(r"^\W*([A-Za-z]\w*)\s*:\s*(.*)", re.ASCII)
HOW = later(
    "To have a part looked at again, hand in a text file {file} with a line for each: "
    "the name of the part, a colon, and why."
)


def how_to_ask(sheet: str) -> str:
    """A sentence for students."""
    return phrase(HOW, file=f"{sheet}{REQUEST}")


def read_requests(course: Course, gradebook: Gradebook, sheet: Sheet) -> list[Request]:
    """What was asked so far, with the files that lie there now."""
    names = list(asked_parts(exercises_of(course, sheet)))
    asked: dict[tuple[str, str], str] = {}
    for student in course.students:
        path = course.folder / "submitted" / student.id / f"{sheet.name}{REQUEST}"
        for part, text in _read(path, names).items():
            asked[student.id, part] = text
    gradebook.term.note_requests(sheet.name, asked)
    known = {student.id for student in course.students}
    return [one for one in gradebook.term.requests(sheet.name) if one.student in known]


def _read(path: Path, names: list[str]) -> dict[str, str]:
    """The text of each part; what stands before the first is about the whole sheet.

    Other people's files, pipes and what is no text ask for nothing; a file that cannot be read
    asks for somebody to look.
    """
    if path.parent.is_symlink() or not is_own_file(path):
        return {}
    try:
        with path.open("rb") as file:
            text = file.read(MOST).decode("utf-8-sig", errors="replace")
    except OSError as error:
        return {WHOLE: f"{path.name} cannot be read: {error.strerror}"}

    found: dict[str, list[str]] = {}
    part = WHOLE
    for line in printable_lines(text).split("\n"):
        named = NAMED.match(line)
        said = line
        if named and named[1] in names:
            part, said = named[1], named[2]
        found.setdefault(part, []).append(said)
    joined = {part: " ".join(" ".join(lines).split()) for part, lines in found.items()}
    return {part: text for part, text in joined.items() if text}
