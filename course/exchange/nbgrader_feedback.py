"""For nbgrader: feedback/<student>/<assignment>/<notebook>.html, and grades as it exports them."""

import csv
import io
from pathlib import Path

from ..machine.files import write_atomically
from .marked import Marked

COLUMNS = (
    "assignment", "duedate", "timestamp", "student_id", "last_name", "first_name", "email",
    "raw_score", "late_submission_penalty", "score", "max_score",
)  # fmt: skip


def hand_back(marked: Marked, folder: Path) -> list[Path]:
    """Writes a page for everybody who has results, and a table of scores; their paths.

    nbgrader's `release_feedback` takes the pages from there. A score that is not there is empty.
    """
    paths: list[Path] = []
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for result in marked.results:
        line = {"assignment": marked.sheet.name, "student_id": result.student.id}
        line["max_score"] = f"{marked.out_of:g}"
        if result.points is not None:
            line |= {"raw_score": f"{result.points:g}", "score": f"{result.points:g}"}
        writer.writerow([line.get(column, "") for column in COLUMNS])
    for student, page in marked.pages():
        path = folder / "feedback" / student.id / marked.sheet.name / page.name
        write_atomically(path, page.read_bytes())
        paths.append(path)
    grades = folder / f"{marked.sheet.name}-nbgrader.csv"
    write_atomically(grades, out.getvalue())
    return [grades, *paths]
