"""A sheet to talk by: who handed in what somebody else did, and what to ask each of them.

Nobody loses a point by it: what is equal may have been computed together.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...exercises.exercise import Part
from ...grader.marking.verdict import Verdict
from ..ledger.gradebook import Gradebook
from ..results.alike import Alike, alike, code_cells, statements
from ..results.hand_ins import HandIns
from ..results.same_numbers import same_numbers
from ..settings.asked import asked_parts, exercises_of
from ..settings.config import Course, CourseError, Sheet
from .entries import Cell, entry_tables
from .page import template, with_formulas, write_page


@dataclass(frozen=True)
class SameAnswer:
    """One part to which some students have the same wrong numbers."""

    part: Part
    students: tuple[str, ...]
    matrices: list[list[list[Cell]]]


@dataclass(frozen=True)
class OralSheet:
    """What there is to talk about on a sheet."""

    numbers: list[SameAnswer]
    code: list[Alike]

    @property
    def students(self) -> list[str]:
        """Everybody whom it names."""
        found: set[str] = set()
        for one in self.numbers:
            found.update(one.students)
        for pair in self.code:
            found.update((pair.one, pair.other))
        return sorted(found)


def write_oral_sheet(course: Course, gradebook: Gradebook, sheet: Sheet) -> tuple[Path, OralSheet]:
    """report/oral-<sheet>.html, and what stands on it."""
    parts = asked_parts(exercises_of(course, sheet))
    known = {student.id for student in course.students}
    current = gradebook.current(sheet.name)
    marked = {student: current[student] for student in current if student in known}
    found = OralSheet(_same_answers(parts, marked), alike(_written(course, sheet)))

    html = template("oral.html").render(
        course=course.settings.title,
        sheet=sheet.title or sheet.name,
        names={student.id: student.name for student in course.students},
        numbers=[_block(one) for one in found.numbers],
        code=found.code,
    )
    path = course.folder / "report" / f"oral-{sheet.name}.html"
    write_page(path, html)
    return path, found


def _same_answers(
    parts: Mapping[str, Part], marked: Mapping[str, Sequence[Verdict]]
) -> list[SameAnswer]:
    """Every group once, in the order of the sheet."""
    groups: dict[tuple[str, tuple[str, ...]], None] = {}
    for student, peers in same_numbers(parts, marked).items():
        shared: dict[str, list[str]] = {}
        for other, answers in peers.items():
            for variable in answers:
                shared.setdefault(variable, [student]).append(other)
        for variable, students in shared.items():
            groups[variable, tuple(sorted(students))] = None

    found: list[SameAnswer] = []
    for variable in parts:
        for of, students in groups:
            if of == variable:
                verdict = _verdict(variable, marked[students[0]])
                found.append(_same_answer(parts[variable], students, verdict))
    return found


def _verdict(variable: str, verdicts: Iterable[Verdict]) -> Verdict:
    (found,) = [verdict for verdict in verdicts if verdict.part == variable]
    return found


def _same_answer(part: Part, students: tuple[str, ...], verdict: Verdict) -> SameAnswer:
    decimals = getattr(part.answer, "decimals", 0)
    return SameAnswer(part, students, entry_tables(verdict.answer, verdict.right, decimals))


def _written(course: Course, sheet: Sheet) -> dict[str, set[str]]:
    """What each student wrote into the notebook, without what was handed out."""
    hand_ins = HandIns(course, sheet)
    found: dict[str, set[str]] = {}
    for student in course.students:
        try:
            submission = hand_ins.of(student.id)
        except CourseError:
            continue
        if submission is None:
            continue
        released = course.folder / "released" / student.id / f"{sheet.name}.ipynb"
        given = code_cells(released.read_bytes()) if released.is_file() else []
        own = statements(code_cells(submission.data)) - statements(given)
        if own:
            found[student.id] = own
    return found


def _block(one: SameAnswer) -> dict[str, Any]:
    return {
        "variable": one.part.variable,
        "prompt": with_formulas(one.part.prompt),
        "students": one.students,
        "matrices": one.matrices,
        "questions": [with_formulas(hint) for hint in one.part.hints],
    }
