"""A fresh variant of an exercise to practise on: no course, no secret, no gradebook, any seed.

The numbers follow from the seed alone, which is printed. Those of a graded sheet follow from the
secret of the course and are drawn under the name of their sheet; the name used here has a blank in
it, as no sheet's can. So no seed gives a graded sheet but by chance, and none tells of one.
"""

import secrets
from dataclasses import dataclass
from pathlib import Path

from ...exercises.exercise import Exercise
from ...exercises.files.finding import exercise_files, find
from ..machine.files import write_atomically
from ..settings.config import CourseError, LimitsTable, PackagesTable, Sheet, Student
from ..sheet.assignment import Assignment
from ..sheet.notebook import handout_notebook, solution_notebook
from ..variants.variant import Record, draw_record
from .own_exercises import exercise_folders

COURSE = "Practice"
DRAWN_FOR = "practice of"
SEEDS = 10**6  # few digits are typed again without a mistake
ENDINGS = (".ipynb", ".pdf")


@dataclass(frozen=True)
class Practice:
    """A sheet with one exercise and the numbers of a seed."""

    exercise: Exercise
    seed: int
    record: Record

    @property
    def sheet(self) -> Sheet:
        """A sheet of which everything is told but the reference values."""
        slug = self.exercise.slug
        return Sheet(name=slug, title=self.exercise.title, mode="practice", exercises=(slug,))

    @property
    def student(self) -> Student:
        """Nobody in particular."""
        return Student("", f"seed {self.seed}")


def practice(slug: str, seed: int | None = None, exercises: Path | None = None) -> Practice:
    """The variant of a seed; of one that nobody knows, where none is given.

    A course's own exercises are looked for in the folder `exercises`, else in exercises/ here.

    Raises:
        CourseError: the folder is none.
        ExerciseError: there is no such exercise, or it cannot be drawn.
    """
    folders = exercise_folders(Path(), exercises)
    exercise = find(slug, exercise_files(*folders), *folders)
    if seed is None:
        seed = secrets.randbelow(SEEDS)
    record = draw_record(f"seed {seed}", DRAWN_FOR, f"seed {seed}", exercise, ())
    return Practice(exercise, seed, record)


def write_practice(
    made: Practice, path: Path | None = None, *, solution: bool = False
) -> list[Path]:
    """Writes the sheet, and with `solution` the worked one beside it; PDFs where the name ends so.

    Returns:
        The files that were written.

    Raises:
        CourseError: a file of that name is there already, or its name ends otherwise.
    """
    path = path or Path(f"{made.exercise.slug}-{made.seed}.ipynb")
    if path.suffix not in ENDINGS:
        raise CourseError(f"{path}: a sheet to practise on ends in {' or '.join(ENDINGS)}")
    paths = [path]
    if solution:
        paths.append(path.with_stem(f"{path.stem}-solution"))
    for one in paths:
        if one.exists():
            raise CourseError(
                f"{one} is already there, and your answers may be in it; -o names another"
            )
    contents = _pdfs(made) if path.suffix == ".pdf" else _notebooks(made)
    for one, content in zip(paths, contents, strict=False):  # the solution may not be wanted
        write_atomically(one, content)
    return paths


def _notebooks(made: Practice) -> tuple[bytes, bytes]:
    assignments = [Assignment(made.exercise, made.record.numbers)]
    about = (COURSE, made.sheet, made.student, assignments)
    sheet = handout_notebook(*about, LimitsTable(), PackagesTable())
    return sheet, solution_notebook(*about)


def _pdfs(made: Practice) -> tuple[bytes, bytes]:
    from ..typeset.document import Front, handout_data, solution_data
    from ..typeset.pdf import pdf

    assignments = [Assignment(made.exercise, made.record.numbers)]
    front = Front(COURSE, made.sheet, made.student, f"seed {made.seed}")
    return pdf(handout_data(front, assignments)), pdf(solution_data(front, assignments))
