"""Feedback for a class: the pages that would show something new, written on all cores."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass
from itertools import chain, islice
from pathlib import Path
from typing import Any

from ...exercises.files.finding import exercise_files
from ...exercises.files.text import Text, exercise_of, exercise_text
from ..grading.overheard import Complaint
from ..grading.place import Place
from ..grading.processes import WORTH
from ..grading.task import JailOf, Task, packed, unpacked
from ..grading.work import AS_JSON
from ..ledger.gradebook import Gradebook
from ..machine.code import code_hash, installed
from ..machine.kept import keep, kept
from ..results.grades import SheetResults
from ..results.result import Result
from ..settings.adjusting import adjusted
from ..settings.config import Course, Settings
from ..variants.record import Record, digest

PAGES = "pages"
LIBRARIES = ("kinegrade", "numpy", "jinja2", "latex2mathml", "markdown-it-py")
"""What pages are made with."""


@dataclass(frozen=True)
class Page:
    """All that a student's page follows from, but for the sheet as it was handed out.

    Attributes:
        folder: The course folder.
        settings: Of the course, as far as a page shows them, with this sheet alone.
        exercises: Their texts.
        result: What the student got.
        records: What was drawn, by exercise.
    """

    __pydantic_config__ = AS_JSON

    folder: str
    settings: dict[str, Any]
    exercises: tuple[Text, ...]
    result: Result
    records: dict[str, Record]

    @property
    def path(self) -> Path:
        """Where it is written."""
        return Path(self.folder, "feedback", self.result.student.id, f"{self.result.sheet}.html")

    @property
    def released(self) -> Path:
        """The sheet as it was handed out, whose questions it repeats."""
        return Path(self.folder, "released", self.result.student.id, f"{self.result.sheet}.ipynb")


@dataclass(frozen=True)
class Written:
    """That a page is written, and what was said on the way."""

    complaints: tuple[Complaint, ...] = ()


def write_page_of(page: Page, _: JailOf) -> Written:
    """Writes one page."""
    from .feedback import write_feedback  # with templates and figures: most runs write no page

    settings = Settings.model_validate(page.settings)
    exercises = adjusted(list(map(exercise_of, page.exercises)), settings.sheet[0])
    course = Course(Path(page.folder), settings, ())
    write_feedback(course, settings.sheet[0], exercises, page.result, page.records)
    return Written()


WRITE = Task(Page, write_page_of, Written)


def write_all_feedback(
    course: Course,
    gradebook: Gradebook,
    marked: SheetResults,
    place: Place,
    step: Callable[[], None] = lambda: None,
) -> None:
    """A page for everybody who has verdicts on the sheet; `step` is called after each.

    A page that would show what it showed when it was written is left as it is.

    Raises:
        Exception: of any kind, where a page cannot be written.
    """
    before = kept(PAGES, course.folder, marked.sheet.name)
    shown: dict[str, Any] = {}

    def changed() -> Iterator[tuple[str, Page]]:
        for page in _pages(course, gradebook, marked):
            student = page.result.student.id
            shows = _shows(page)
            if before.get(student) == [shows, _content(page.path)]:
                shown[student] = before[student]
                step()
            else:
                yield shows, page

    pages = changed()
    first = list(islice(pages, WORTH))  # the others are looked for while these are written
    pieces = (((shows, page), page) for shows, page in chain(first, pages))
    try:
        with closing(place.run(WRITE, pieces, len(first))) as written:
            for (shows, page), result in written:
                if isinstance(result, BaseException):
                    raise result
                shown[page.result.student.id] = [shows, _content(page.path)]
                step()
    finally:
        if first:
            keep(PAGES, course.folder, marked.sheet.name, before | shown)


def _pages(course: Course, gradebook: Gradebook, marked: SheetResults) -> Iterator[Page]:
    files = exercise_files(course.folder / "exercises")
    texts = tuple(exercise_text(files[slug]) for slug in marked.sheet.exercises)
    records: dict[str, dict[str, Record]] = {}
    for record in gradebook.records(marked.sheet.name):
        records.setdefault(record.student, {})[record.exercise] = record
    settings = {
        "title": course.settings.title,
        "marking": course.settings.marking.model_dump(),
        "sheet": [marked.sheet.model_dump(mode="json")],
    }
    folder = str(course.folder.resolve())
    for result in marked.results:
        if result.verdicts:
            own = records.get(result.student.id, {})
            yield Page(folder, settings, texts, result, own)


def _shows(page: Page) -> str:
    """A hash of all that a page shows."""
    about: Mapping[str, Any] = vars(page) | {
        "result": unpacked(Result, packed(page.result)),  # 2 points are 2.0 points
        "exercises": [text.hash for text in page.exercises],
        "code": code_hash(),
        "libraries": [installed(name) for name in LIBRARIES],
        "released": _content(page.released),
    }
    return digest(packed(about))


def _content(path: Path) -> str:
    """A hash of a file; empty where there is none."""
    try:
        return digest(path.read_bytes())
    except OSError:
        return ""
