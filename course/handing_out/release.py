"""Files of one student's sheet: those that are not there yet are written, in every format."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ...exercises.exercise import Exercise
from ..language.speech import speaking
from ..language.translated import translated, translations
from ..machine.cores import worker_processes
from ..machine.files import write_atomically
from ..settings.adjusting import exercises_on
from ..settings.config import Format, LimitsTable, PackagesTable, Sheet, Student
from ..sheet.assignment import Assignment
from ..sheet.matlab import starter
from ..sheet.notebook import handout_notebook, solution_notebook
from ..sheet.python_script import script
from ..typeset.document import Front, handout_data, solution_data
from ..typeset.pdf import pdf

WORTH = 12  # sheets to write that are worth starting processes for


@dataclass(frozen=True)
class Order:
    """All that the files of one student's sheet follow from, besides the exercises themselves.

    It is plain data, so that another process can write them. `numbers` are those drawn, in the
    order of the exercises.
    """

    folder: Path
    course: str
    formats: tuple[Format, ...]
    sheet: Sheet
    student: Student
    numbers: tuple[dict[str, Any], ...]
    code: str
    limits: LimitsTable
    packages: PackagesTable

    def released(self, suffix: str) -> Path:
        """The student's file of that format."""
        return self.folder / "released" / self.student.id / f"{self.sheet.name}.{suffix}"

    def solution(self, suffix: str) -> Path:
        """The worked solution in that format."""
        return self.folder / "solutions" / self.student.id / f"{self.sheet.name}.{suffix}"

    def missing(self) -> list[Path]:
        """The files that are not there; what is released comes last, once all else is there."""
        wanted: list[Path] = []
        if self.sheet.matlab:
            wanted.append(self.released("m"))
        if self.sheet.python:
            wanted.append(self.released("py"))
        wanted += [self.solution(suffix) for suffix in self.formats]
        wanted += [self.released(suffix) for suffix in reversed(self.formats)]
        return [path for path in wanted if not path.exists()]


def write_solutions(order: Order, exercises: Sequence[Exercise]) -> None:
    """Writes the worked solutions of an order that are not there, and nothing else.

    Raises:
        ExerciseError: as `write`.
        FormulaError: as `write`.
    """
    solutions = {order.solution(suffix) for suffix in order.formats}
    _write(order, exercises, [path for path in order.missing() if path in solutions])


def write(order: Order, exercises: Sequence[Exercise]) -> None:
    """Writes the files of an order that are not there.

    Raises:
        ExerciseError: an exercise fails on the student's numbers, or explains a part by no steps.
        FormulaError: a formula cannot be set in a PDF.
    """
    _write(order, exercises, order.missing())


def _write(order: Order, exercises: Sequence[Exercise], paths: Sequence[Path]) -> None:
    language = order.sheet.language
    beside = translations(order.sheet.exercises, language, order.folder / "exercises")
    assignments: list[Assignment] = []
    for exercise, numbers in zip(exercises, order.numbers, strict=True):
        shown = translated(exercise, language, beside.get(exercise.slug))
        assignments.append(Assignment(shown, numbers))

    makers = _makers(order, assignments)
    with speaking(language, tuple(beside.values())):
        for path in paths:
            write_atomically(path, makers[path]())


def _makers(
    order: Order, assignments: Sequence[Assignment]
) -> dict[Path, Callable[[], bytes | str]]:
    """What makes the content of each file."""
    about = (order.course, order.sheet, order.student, assignments)
    front = Front(order.course, order.sheet, order.student, order.code)
    return {
        order.released("m"): lambda: starter(*about),
        order.released("py"): lambda: script(*about, order.limits, order.packages),
        order.released("ipynb"): lambda: handout_notebook(*about, order.limits, order.packages),
        order.solution("ipynb"): lambda: solution_notebook(*about),
        order.released("pdf"): lambda: pdf(handout_data(front, assignments)),
        order.solution("pdf"): lambda: pdf(solution_data(front, assignments)),
    }


def write_all(
    orders: Iterable[Order], exercises: Sequence[Exercise], *, expected: int
) -> Iterator[None]:
    """Writes the files of all orders of one sheet, and yields after each order.

    Orders are taken in turn, on as many cores as there are where `expected` of them are worth it.

    Raises:
        ExerciseError: as `write`; what is finished by then stays.
        FormulaError: as `write`.
    """
    if expected < WORTH:
        for order in orders:
            write(order, exercises)
            yield
        return

    with worker_processes() as pool:
        try:
            futures = [pool.submit(_write_there, order) for order in orders]
            for future in as_completed(futures):
                future.result()
                yield
        finally:
            pool.shutdown(cancel_futures=True)


def _write_there(order: Order) -> None:
    """Writes an order in a process that loads the exercises itself."""
    write(order, _loaded(order.folder / "exercises", order.sheet.model_dump_json()))


@cache
def _loaded(own: Path, sheet: str) -> list[Exercise]:
    """The exercises of a sheet, loaded once in a process that lives no longer than one run."""
    return exercises_on(Sheet.model_validate_json(sheet), own)
