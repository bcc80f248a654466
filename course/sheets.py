"""Handing out: draw what is not drawn yet, write what is not written yet, never touch what is released."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ..exercises.exercise import Exercise
from ..exercises.files.finding import exercise_files, find
from .check import read_handout
from .config import Course, CourseError, Sheet, Student, hint
from .files import write_atomically
from .gradebook import Gradebook
from .secret import read_secret
from .sheet.matlab import starter
from .sheet.notebook import notebooks, printed
from .variant import Record, canonical, draw_record


@dataclass(frozen=True)
class Released:
    """What `generate` did for one student's sheet."""

    student: str
    sheet: str
    path: Path
    new: bool


def exercises_of(course: Course, sheet: Sheet) -> list[Exercise]:
    """The exercises of a sheet, in order.

    Raises:
        ExerciseError: one is unknown or broken.
        CourseError: two exercises ask for variables of the same name.
    """
    own = course.folder / "exercises"
    files = exercise_files(own)
    exercises = [find(slug, files, own) for slug in sheet.exercises]
    names = [part.variable for exercise in exercises for part in exercise.asked]
    for name in names:
        if names.count(name) > 1:
            raise CourseError(
                f"sheet {sheet.name}: {name} is asked twice; answers are collected by name"
            )
    _check_pins(sheet, {exercise.slug: exercise for exercise in exercises})
    return exercises


def _check_pins(sheet: Sheet, exercises: Mapping[str, Exercise]) -> None:
    """Refuses to pin what is no choice of form of an exercise on the sheet."""
    for slug, pins in sheet.pinned.items():
        if slug not in exercises:
            raise CourseError(
                f"sheet {sheet.name} pins {slug!r}{hint(slug, exercises)}, which is not on the sheet"
            )
        structure = exercises[slug].structure
        for name in pins:
            if name not in structure:
                raise CourseError(
                    f"sheet {sheet.name} pins {name!r} of {slug}{hint(name, structure)}; its choices of form are: "
                    f"{', '.join(structure) or 'none'}"
                )


def generate(
    course: Course,
    gradebook: Gradebook,
    sheets: tuple[Sheet, ...],
    step: Callable[[], None] = lambda: None,
) -> list[Released]:
    """A notebook, a solution and, where asked, a MATLAB script for every student on every sheet.

    `step` is called after each.
    """
    done: list[Released] = []
    secret = cache(lambda: read_secret(course))  # not asked for where all is drawn
    for sheet in sheets:
        exercises = exercises_of(course, sheet)
        drawn = {
            (record.student, record.exercise): record for record in gradebook.records(sheet.name)
        }
        taken: dict[str, set[str]] = {exercise.slug: set() for exercise in exercises}
        for record in drawn.values():
            taken.setdefault(record.exercise, set()).add(canonical(record.numbers))
        for student in course.students:
            fresh = _draw_missing(secret, sheet, student, exercises, drawn, taken)
            records = [drawn[student.id, exercise.slug] for exercise in exercises]
            if fresh:
                _agree(_released(course, sheet, student), exercises, records)
                gradebook.save_records(fresh)
            done.append(_release(course, sheet, student, exercises, records))
            step()
    return done


def _draw_missing(
    secret: Callable[[], str],
    sheet: Sheet,
    student: Student,
    exercises: list[Exercise],
    drawn: dict[tuple[str, str], Record],
    taken: dict[str, set[str]],
) -> list[Record]:
    """What was not drawn for the student before, also put into `drawn` and into `taken`.

    `taken` are the recorded numbers of each exercise as `canonical` text.
    """
    fresh: list[Record] = []
    for exercise in exercises:
        key = (student.id, exercise.slug)
        if key in drawn:
            continue
        pinned = sheet.pinned.get(exercise.slug)
        record = draw_record(
            secret(), sheet.name, student.id, exercise, taken[exercise.slug], pinned
        )
        drawn[key] = record
        taken[exercise.slug].add(canonical(record.numbers))
        fresh.append(record)
    return fresh


def _agree(path: Path, exercises: list[Exercise], records: list[Record]) -> None:
    """Refuses to record numbers for a notebook that was handed out with others."""
    if not path.exists():
        return
    pairs = zip(exercises, records, strict=True)
    try:
        same = read_handout(path).numbers == {
            e.slug: printed(e, record.numbers) for e, record in pairs
        }
    except CourseError:
        same = False
    if not same:
        raise CourseError(
            f"{path} was handed out with other exercises or numbers than would be drawn now, so nothing was recorded; "
            "give new exercises a sheet of their own, or bring back the gradebook and the secret of that day"
        )


def _released(course: Course, sheet: Sheet, student: Student) -> Path:
    return course.folder / "released" / student.id / f"{sheet.name}.ipynb"


def _release(
    course: Course, sheet: Sheet, student: Student, exercises: list[Exercise], records: list[Record]
) -> Released:
    path = _released(course, sheet, student)
    solution = course.folder / "solutions" / student.id / f"{sheet.name}.ipynb"
    pairs = list(zip(exercises, (record.numbers for record in records), strict=True))
    new = not path.exists()
    script = path.with_name(f"{sheet.name}.m")
    if sheet.matlab and not script.exists():
        write_atomically(script, starter(course.settings.title, sheet, student, pairs))
    if new or not solution.exists():
        handout, worked = notebooks(course.settings.title, sheet, student, pairs)
        write_atomically(solution, worked)
        if new:  # last: what is released was released in full
            write_atomically(path, handout)
    return Released(student.id, sheet.name, path, new)
