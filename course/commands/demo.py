"""A course of twelve students who hand in what a class would, marked."""

import json
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from ...exercises.exercise import Numbers, Part, references
from ...grader.jail.level import ANY
from ..handing_out.generate import generate
from ..ledger.gradebook import Gradebook, gradebook_of
from ..machine.console import progress
from ..machine.files import write_atomically
from ..marking.how import How, this_machine
from ..marking.sheets import mark_sheets
from ..marking.written import level_line, show, write_results
from ..results.marks import by_hand
from ..settings.asked import exercises_of
from ..settings.config import Course, CourseError, Sheet, read_course
from ..variants.secret import FILE
from .habits import HABITS, Answers, Code, Habit, Spoil

__all__ = ["HABITS", "Code", "Habit", "Spoil", "fill_in", "hand_in", "mark_by_hand", "run_demo"]
SECRET = "a demonstration keeps no secrets: its numbers are the same everywhere"  # noqa: S105
SHEETS = (
    ("first_steps", "Positions, transforms, turning bodies",
     "planar_2r dh_transforms cross_products small_rotations"),
    ("jacobian", "The manipulator Jacobian",
     "three_axis rrt puma_velocities"),
    ("columns", "Columns in every frame",
     "articulated_derivatives last_frame_columns prismatic_columns frames"),
    ("velocities", "Inverse velocities",
     "inverse_velocities pseudoinverse find_the_mistake implement_it"),
    ("wishes", "Forces and wished poses",
     "statics desired_pose"),
)  # fmt: skip
"""Name, title and exercises of every sheet."""
COMMENT = "The key says it shorter; both parts of the argument are there."


def run_demo(folder: Path) -> None:
    """Builds the course in `folder`, hands in, marks, and says where to look.

    Run again, it gives the same marks.

    Raises:
        CourseError: the folder holds another course.
    """
    _prepare(folder)
    course = read_course(folder)
    with gradebook_of(course) as gradebook:
        with progress("Writing sheets", len(course.students) * len(SHEETS)) as step:
            generate(course, gradebook, course.settings.sheet, step)
        for sheet in course.settings.sheet:
            hand_in(course, gradebook, sheet)
        # The notebooks are ours: a demonstration asks for nothing to be installed.
        how = How(permission=ANY)
        with this_machine(course, how.permission) as machine:
            mark_sheets(course, gradebook, course.settings.sheet, machine, how)
            mark_by_hand(course, gradebook)
            marked = mark_sheets(course, gradebook, course.settings.sheet, machine, how)
            write_results(course, gradebook, machine, marked)
        show(course, marked, level_line(gradebook.noted_level()))
    first = course.students[0].id
    sys.stderr.write(
        f"A sheet:  {folder}/released/{first}/jacobian.ipynb\n"
        f"Feedback: {folder}/feedback/student03/jacobian.html\n"
        f"Solution: {folder}/solutions/{first}/jacobian.ipynb\n"
    )


def _prepare(folder: Path) -> None:
    settings = folder / "course.toml"
    if settings.exists():
        if SECRET not in _text(settings) + _text(folder / FILE):
            raise CourseError(
                f"{folder} holds a course that is not the demonstration; name another folder"
            )
        return
    if _text(folder / FILE).strip() not in ("", SECRET):
        raise CourseError(
            f"{folder / FILE} holds a secret that is not the demonstration's; name another folder"
        )
    write_atomically(folder / "roster.csv", _roster())
    write_atomically(folder / FILE, SECRET + "\n", mode=0o600)
    write_atomically(settings, _settings())  # last: with it, the folder is the demonstration


def _roster() -> str:
    """A student for every habit, whose title stands in place of a name."""
    lines = ["student,name"]
    for number, habit in enumerate(HABITS, 1):
        lines.append(f"student{number:02},{habit.title}")
    return "\n".join(lines) + "\n"


def _settings() -> str:
    blocks = ['title = "Kinegrade demonstration"\n']
    for name, title, slugs in SHEETS:
        exercises = json.dumps(slugs.split())
        blocks.append(f'[[sheet]]\nname = "{name}"\ntitle = "{title}"\nexercises = {exercises}\n')
    blocks.append("[limits]\ncell_seconds = 2\n")
    return "\n".join(blocks)


def _text(path: Path) -> str:
    if not path.is_file():
        return ""
    return path.read_text(encoding="utf-8", errors="replace")


def hand_in(course: Course, gradebook: Gradebook, sheet: Sheet) -> None:
    """Every student's notebook with the answer cells filled in as the student's habit has it."""
    numbers: dict[tuple[str, str], dict[str, Any]] = {}
    for record in gradebook.records(sheet.name):
        numbers[record.student, record.exercise] = record.numbers

    for student, habit in zip(course.students, HABITS, strict=True):
        source = student
        if habit.title.startswith("somebody"):
            source = course.students[0]
        cells: dict[str, str] = {}
        for exercise in exercises_of(course, sheet):
            v = numbers[source.id, exercise.slug]
            answers = habit.spoil(exercise, v, references(exercise, v))
            cells |= _cells(exercise.asked, answers)
        released = course.folder / "released" / student.id / f"{sheet.name}.ipynb"
        submitted = course.folder / "submitted" / student.id / released.name
        write_atomically(submitted, fill_in(released.read_bytes(), cells))


def _cells(parts: Iterable[Part], answers: Answers) -> dict[str, str]:
    """The code of every part's answer, by variable; no cell for what is left out."""
    cells: dict[str, str] = {}
    for part in parts:
        if part.variable in answers:
            cells[part.variable] = _code(part, answers[part.variable])
    return cells


def _code(part: Part, answer: Any) -> str:
    if isinstance(answer, Code):
        return answer.text
    code = part.answer.code(part.variable, answer)
    if isinstance(part.answer, Numbers):
        code = code.replace("nan", "np.nan")  # a repr that is no Python
    return code


def mark_by_hand(course: Course, gradebook: Gradebook) -> None:
    """Full points for every argument but the last student's, which stays to be marked."""
    last = course.students[-1].id
    waiting = [one for one in by_hand(course, gradebook, course.settings.sheet) if one.waits]
    for one in waiting:
        if one.student == last:
            continue
        gradebook.save_marks([one.new_mark(one.part.points, COMMENT)])


def fill_in(notebook: bytes, answers: Mapping[str, str]) -> bytes:
    """A handed-out notebook with the blank cell of every named answer replaced by code."""
    content: Any = json.loads(notebook)
    for cell in content["cells"]:
        if cell["cell_type"] != "code":
            continue
        blank = "".join(cell["source"])
        for name, code in answers.items():
            if blank.startswith((f"{name} = ...", f"def {name}(")):
                cell["source"] = code
    return (json.dumps(content, indent=1, ensure_ascii=False) + "\n").encode("utf-8")
