"""What students handed in: found by name, read as bytes, turned into raw values."""

import logging
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...exercises.exercise import Exercise, Function, Part, Variant
from ...grader.collecting.ask import Ask, AskError, Limits
from ...grader.collecting.collect import cannot_run, collect
from ...grader.collecting.mat_file import cannot_read, from_mat
from ...grader.collecting.named_matrices import from_csv, from_json
from ...grader.collecting.wire import Raw
from ..config import CourseError
from ..escape import printable

log = logging.getLogger(__name__)
MAX_BYTES = 25 << 20
Reader = Callable[[bytes, Sequence[Ask], Limits], dict[str, Raw]]
READERS: dict[str, Reader] = {
    ".ipynb": collect,
    ".json": lambda data, asks, _: from_json(data, asks),
    ".csv": lambda data, asks, _: from_csv(data, asks),
    ".mat": lambda data, asks, _: from_mat(data, asks),
}
HINDRANCES: dict[str, Callable[[], str]] = {".ipynb": cannot_run, ".mat": cannot_read}
"""Why files of an ending cannot be marked on this machine: no fault of the student's, so never a zero."""


@dataclass(frozen=True)
class Submission:
    """One file as it was handed in."""

    path: Path
    data: bytes

    def asks(self, exercise: Exercise, v: Variant) -> list[Ask]:
        """What to bring back: functions of a notebook are called, a file holds the results of the published calls.

        A part whose calls cannot be made has an Ask that says why; all others are asked for.
        """
        return [_ask(part, v, published=self.path.suffix != ".ipynb") for part in exercise.asked]

    def raws(self, asks: Sequence[Ask], limits: Limits) -> dict[str, Raw]:
        """The asked values; runs the notebook, or reads the file of matrices."""
        found = {ask.name: Raw("unasked", ask.hindrance) for ask in asks if ask.hindrance}
        asked = [ask for ask in asks if not ask.hindrance]
        found |= READERS[self.path.suffix](self.data, asked, limits)
        if self.path.suffix == ".ipynb":
            return found | {ask.name: _called(found[ask.name]) for ask in asked if ask.calls}
        return found


def _called(raw: Raw) -> Raw:
    """In a notebook a function is asked for; results that are listed there were not computed before our eyes."""
    if raw.kind in ("num", "text") or raw.listed:
        return Raw("error", "takes a function of this name in a notebook, not its results")
    return raw


def _ask(part: Part, v: Variant, *, published: bool) -> Ask:
    if not isinstance(part.answer, Function):
        return Ask(part.variable)
    inputs = part.answer.published if published and part.answer.published else part.answer.inputs
    try:
        return Ask(part.variable, tuple(call for group in inputs(v).values() for call in group))
    except AskError as error:
        return Ask(part.variable, hindrance=str(error))
    except Exception as error:  # an exercise may fail in any way on a student's numbers
        log.exception("%s: its inputs could not be made", part.variable)
        return Ask(
            part.variable, hindrance=f"its inputs stopped with {type(error).__name__}: {error}"
        )


def find_submission(folder: Path, student: str, sheet: str) -> Submission | None:
    """The student's file for a sheet, a notebook before .json before .csv before .mat; None when there is none.

    Raises:
        CourseError: the file is there and cannot be read.
    """
    for suffix in READERS:
        path = folder / "submitted" / student / f"{sheet}{suffix}"
        if path.exists() or path.is_symlink():
            return read_submission(path)
    return None


def misnamed(folder: Path, student: str, sheets: Collection[str]) -> str:
    """The first of a student's files that belongs to no sheet by its name; empty when there is none."""
    try:
        names = sorted(path.name for path in (folder / "submitted" / student).iterdir())
    except OSError:
        return ""
    known = {f"{sheet}{suffix}" for sheet in sheets for suffix in READERS}
    return next((name for name in names if name not in known and not name.startswith(".")), "")


def strangers(folder: Path, students: Collection[str]) -> list[str]:
    """Names in submitted/ that are nobody's of the roster."""
    try:
        names = sorted(path.name for path in (folder / "submitted").iterdir())
    except OSError:
        return []
    return [printable(name) for name in names if name not in students and not name.startswith(".")]


def read_submission(path: Path) -> Submission:
    """The bytes of one file.

    Raises:
        CourseError: it cannot be read, is too large, or has an ending that cannot be marked, at all or on this machine.
    """
    if path.suffix not in READERS:
        raise CourseError(
            f"{path}: a submission takes one of the endings {', '.join(READERS)}, got {path.suffix!r}"
        )
    hindrance = HINDRANCES.get(path.suffix, str)()
    if hindrance:
        raise CourseError(f"{path}: {hindrance}")
    try:
        if path.is_symlink():
            raise CourseError(f"{path} is a link; a submission takes a file of its own")
        if path.exists() and not path.is_file():  # a pipe would be waited for
            raise CourseError(f"{path} cannot be read: it is not a file")
        size = path.stat().st_size
        if size > MAX_BYTES:
            raise CourseError(
                f"{path} has {size >> 20} MB; a submission may have {MAX_BYTES >> 20} MB"
            )
        return Submission(path, path.read_bytes())
    except OSError as error:
        raise CourseError(f"{path} cannot be read: {error.strerror}") from error
