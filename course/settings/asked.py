"""What a sheet asks for: its exercises, and their parts by variable."""

from collections.abc import Iterable, Mapping

from ...exercises.exercise import Exercise, Part
from .adjusting import exercises_on
from .config import Course, CourseError, Sheet, hint


def exercises_of(course: Course, sheet: Sheet) -> list[Exercise]:
    """The exercises of a sheet, in order.

    Raises:
        ExerciseError: one is unknown or broken.
        CourseError: two exercises ask for variables of the same name.
    """
    exercises = exercises_on(sheet, course.folder / "exercises")
    _refuse_equal_names(sheet, exercises)
    _check_pins(sheet, {exercise.slug: exercise for exercise in exercises})
    return exercises


def asked_parts(exercises: Iterable[Exercise]) -> dict[str, Part]:
    """All parts that the exercises ask for, by variable, in the order of the sheet."""
    parts: dict[str, Part] = {}
    for exercise in exercises:
        parts |= {part.variable: part for part in exercise.asked}
    return parts


def _refuse_equal_names(sheet: Sheet, exercises: Iterable[Exercise]) -> None:
    names: list[str] = []
    for exercise in exercises:
        names += [part.variable for part in exercise.asked]
    for name in names:
        if names.count(name) > 1:
            raise CourseError(
                f"sheet {sheet.name}: {name} is asked twice; answers are collected by name"
            )


def _check_pins(sheet: Sheet, exercises: Mapping[str, Exercise]) -> None:
    """Refuses to pin what is no choice of form of an exercise on the sheet."""
    for slug, pins in sheet.pinned.items():
        if slug not in exercises:
            raise CourseError(
                f"sheet {sheet.name} pins {slug!r}{hint(slug, exercises)}, "
                "which is not on the sheet"
            )
        structure = exercises[slug].structure
        for name in pins:
            if name not in structure:
                choices = ", ".join(structure) or "none"
                raise CourseError(
                    f"sheet {sheet.name} pins {name!r} of {slug}{hint(name, structure)}; "
                    f"its choices of form are: {choices}"
                )
