"""For Gradescope: an autograder that gives everybody what was marked here."""

import json
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

from ..machine.files import write_atomically
from ..settings.config import Student
from .gradescope_results import gradescope_results
from .marked import Marked
from .packing import packed

SETUP = "#!/bin/sh\nset -e\napt-get update\napt-get install -y python3\n"
RUN = "#!/bin/sh\nexec python3 /autograder/source/handed_back.py /autograder\n"
PROGRAMS = frozenset({"setup.sh", "run_autograder"})


def hand_back(marked: Marked, folder: Path) -> list[Path]:
    """Writes the zip; upload it as the autograder and rerun it for all submissions.

    It holds complete results only: who waits for a mark stays ungraded.
    """
    results: dict[str, Any] = {}
    for result in marked.results:
        if result.points is not None:
            results[result.student.id] = gradescope_results(marked, result)
    known = {"students": _ids(marked.course.students), "results": results}
    script = files("kinegrade.course.exchange").joinpath("handed_back.py").read_bytes()
    path = folder / f"{marked.sheet.name}-gradescope-results.zip"
    contents = {
        "setup.sh": SETUP.encode(),
        "run_autograder": RUN.encode(),
        "handed_back.py": script,
        "results.json": json.dumps(known, indent=2).encode(),
    }
    write_atomically(path, packed(contents, PROGRAMS))
    return [path]


def _ids(students: Sequence[Student]) -> dict[str, str]:
    """What Gradescope may call somebody, to the student; what several are called is left out."""
    owners: dict[str, set[str]] = {}
    for student in students:
        for text in (student.id, *(text for _, text in student.more)):
            owners.setdefault(text.casefold(), set()).add(student.id)
    return {text: next(iter(who)) for text, who in owners.items() if text and len(who) == 1}
