"""What runs in Gradescope's container: one submission marked as `kinegrade grade` marks it.

Where it cannot be marked as it should be, nothing is written: Gradescope then keeps it ungraded
and shows the instructor the sentence. It is never a zero.
"""

import json
import sys
from collections.abc import Iterable, Mapping
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from shutil import copy, copytree
from tempfile import TemporaryDirectory
from typing import Any

from ...grader.jail.level import Permission
from ...solutions.errors import KinegradeError
from ..errors import CourseError
from ..ledger.gradebook import FILE, Gradebook
from ..machine.files import write_atomically
from ..marking.how import this_machine
from ..marking.marker import SheetMarker
from ..results.result import Result
from ..settings.asked import exercises_of
from ..settings.config import Course, Settings, Sheet, Student
from .archive import opened_download
from .autograder import ABOUT
from .claims import look
from .gradescope_results import gradescope_results
from .marked import Marked
from .people import Owner, People
from .taking import take
from .upload import Upload


def main(root: Path) -> int:
    """Marks the submission below the folder of Gradescope's; 1 where it could not."""
    try:
        results = marked_submission(root)
    except KinegradeError as error:
        sys.stdout.write(f"Not marked: {error}\n")
        return 1
    write_atomically(root / "results" / "results.json", json.dumps(results, indent=2))
    return 0


def marked_submission(root: Path) -> dict[str, Any]:
    """What Gradescope shows of the submission.

    Raises:
        CourseError: it cannot be told whose it is, holds no answers, or could not be marked.
        JailError: the walls that the instructor asked for are not to be had in this container.
    """
    source = root / "source"
    about: Any = json.loads((source / ABOUT).read_text(encoding="utf-8"))
    metadata: Any = json.loads((root / "submission_metadata.json").read_text(encoding="utf-8"))
    student = _submitter(list(_students(about["students"])), metadata.get("users") or [])
    with TemporaryDirectory() as place:
        folder = Path(place)
        copy(source / FILE, folder / FILE)
        if (source / "exercises").is_dir():
            copytree(source / "exercises", folder / "exercises")
        course = Course(folder, Settings.model_validate(about["settings"]), (student,))
        sheet = course.sheet(about["sheet"])
        _hand_in(course, sheet, student, root / "submission")
        with Gradebook(folder / FILE) as gradebook:
            permission = Permission(accept_medium=about["accept_medium"])
            result = _result(course, gradebook, sheet, permission)
            level = gradebook.noted_level()
        marked = Marked(course, sheet, exercises_of(course, sheet), [result])
        results = gradescope_results(marked, result)
        results["extra_data"] |= {"level": level, "kinegrade": version("kinegrade")}
        return results


def _students(listed: Iterable[Any]) -> Iterable[Student]:
    for student, name, more in listed:
        yield Student(student, name, tuple((column, text) for column, text in more))


def _submitter(students: list[Student], users: Iterable[Mapping[str, Any]]) -> Student:
    """The one student of the roster among those who handed in."""
    people = People(students)
    found: list[Student] = []
    for user in users:
        ids = tuple(str(user[key]) for key in ("sid", "email") if user.get(key))
        student = people.find(Owner(ids=ids, name=str(user.get("name") or "")))
        if student is not None and student not in found:
            found.append(student)
    if len(found) != 1:
        raise CourseError(
            f"{len(found)} students of the roster handed this in; a personal sheet takes one"
        )
    return found[0]


def _hand_in(course: Course, sheet: Sheet, student: Student, submission: Path) -> None:
    """Takes the files as `kinegrade collect` does, into a course folder for this one."""
    owner = Owner(ids=(student.id,))
    with opened_download(submission) as contents:
        uploads = [Upload(owner, file.path.name, file) for file in contents.files]
        looked = look(course, People(course.students), uploads, sheet.name)
        taken = take(course, looked)
    if not taken.paths:
        why = " ".join(taken.conflicts) or f"the file takes the name {sheet.name}.ipynb"
        raise CourseError(f"no answers to sheet {sheet.name} were found: {why}")


def _result(course: Course, gradebook: Gradebook, sheet: Sheet, permission: Permission) -> Result:
    with this_machine(course, permission) as machine:
        (result,) = SheetMarker(course, gradebook, sheet, machine).results()
    if all(verdict.points is None for verdict in result.verdicts):
        reasons = {finding.text for one in result.verdicts for finding in one.findings}
        raise CourseError(result.reason or " ".join(sorted(reasons)))
    return replace(result, passed_over=())


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
