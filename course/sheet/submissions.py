"""What students handed in: found by name, read as bytes, turned into raw values."""

import logging
import os
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

from ...exercises.exercise import Exercise, Function, Part, Variant
from ...grader.collecting.ask import Ask, AskError, Limits
from ...grader.collecting.collect import cannot_run, collect
from ...grader.collecting.machine_paths import without_paths
from ...grader.collecting.mat_file import cannot_read, from_mat
from ...grader.collecting.named_matrices import every, from_csv, from_json
from ...grader.collecting.other_formats import other_format
from ...grader.collecting.wire import Raw
from ...grader.jail.jail import Jail
from ..config import CourseError
from ..escape import printable

log = logging.getLogger(__name__)
KEY = "kinegrade"
"""What a notebook says of itself stands under this key of its metadata."""
MAX_BYTES = 25 << 20
MAX_NOTEBOOK = 200 << 20  # outputs included, which are dropped before anything else
MAX_BESIDE = 32 << 20  # of the files beside a notebook
NOTEBOOK = ".ipynb"
REQUEST = ".request.txt"
"""How the files end in which students ask to have something looked at again."""
OWN_FILE = "a submission takes a file of its own"
Reader = Callable[[bytes, Sequence[Ask], Limits], dict[str, Raw]]
READERS: dict[str, Reader] = {
    NOTEBOOK: collect,
    ".json": lambda data, asks, _: from_json(data, asks),
    ".csv": lambda data, asks, _: from_csv(data, asks),
    ".mat": lambda data, asks, _: from_mat(data, asks),
}
HINDRANCES: dict[str, Callable[[], str]] = {NOTEBOOK: cannot_run, ".mat": cannot_read}
"""Why files of an ending cannot be marked on this machine.

It is no fault of the student's, so never a zero.
"""


@dataclass(frozen=True)
class Submission:
    """One file as it was handed in."""

    path: Path
    data: bytes

    def asks(self, exercise: Exercise, v: Variant) -> list[Ask]:
        """What to bring back: a notebook's functions are called, a file holds results of calls.

        A part whose calls cannot be made has an Ask that says why; all others are asked for.
        """
        published = self.path.suffix != NOTEBOOK
        asks: list[Ask] = []
        for part in exercise.asked:
            asks.append(_ask(part, v, published=published))
            asks += map(Ask, part.beside.values())
        return asks

    def beside(self) -> dict[str, bytes]:
        """Files in the same folder that the notebook mentions, by name: data, modules.

        No links, as these may lead anywhere, and no more than a jail holds.
        """
        found: dict[str, bytes] = {}
        left = MAX_BESIDE
        if self.path.suffix != NOTEBOOK or not self.data:
            return found
        for name in _visible_names(self.path.parent):
            path = self.path.parent / name
            if name == self.path.name or path.stem.encode() not in self.data:
                continue
            if path.is_symlink() or not path.is_file() or path.stat().st_nlink > 1:
                continue
            if path.stat().st_size > left:
                continue
            found[name] = path.read_bytes()
            left -= len(found[name])
        return found

    def raws(self, asks: Sequence[Ask], limits: Limits, jail: Jail | None = None) -> dict[str, Raw]:
        """The asked values; runs the notebook, or reads the file of matrices.

        Raises:
            JailError: no notebook can run on this machine as it should.
        """
        found: dict[str, Raw] = {}
        asked: list[Ask] = []
        for ask in asks:
            if ask.hindrance:
                found[ask.name] = Raw("unasked", ask.hindrance)
            else:
                asked.append(ask)

        other = other_format(self.data)
        if other:
            return found | every(asked, other.sentence)
        if self.path.suffix != NOTEBOOK:
            return found | READERS[self.path.suffix](self.data, asked, limits)
        if asked:
            found |= collect(self.data, asked, limits, jail=jail, beside=self.beside())
            for ask in asked:
                if ask.calls:
                    found[ask.name] = _called(found[ask.name])
        return found


def _called(raw: Raw) -> Raw:
    """What a call in a notebook brought back; results that are listed there are no answer.

    Those were not computed before our eyes.
    """
    if raw.kind in ("num", "text") or raw.listed:
        return Raw("error", "takes a function of this name in a notebook, not its results")
    return raw


def _ask(part: Part, v: Variant, *, published: bool) -> Ask:
    """What to bring back for a part; with `published`, results of the calls that are printed."""
    answer = part.answer
    if not isinstance(answer, Function):
        return Ask(part.variable)
    try:
        return Ask(part.variable, tuple(_calls(answer, v, published=published)))
    except AskError as error:
        return Ask(part.variable, hindrance=str(error))
    except Exception as error:  # an exercise may fail in any way on a student's numbers
        log.exception("%s: its inputs could not be made", part.variable)
        return Ask(
            part.variable,
            hindrance=without_paths(f"its inputs stopped with {type(error).__name__}: {error}"),
        )


def _calls(answer: Function, v: Variant, *, published: bool) -> list[tuple[Any, ...]]:
    if published and answer.published:
        return answer.published_calls(v)
    return answer.calls(v)


def find_submission(folder: Path, student: str, sheet: str) -> Submission | None:
    """The student's file for a sheet; None when there is none.

    A notebook goes before .json, that before .csv, and that before .mat. What it raises names the
    file below the course folder: the student reads it.

    Raises:
        CourseError: the file is there and cannot be read, or is a link to some other file.
    """
    for suffix in READERS:
        path = folder / "submitted" / student / f"{sheet}{suffix}"
        if not path.exists() and not path.is_symlink():  # a link to nowhere does not exist
            continue
        try:
            _refuse_link(path)
            return read_submission(path)
        except CourseError as error:
            raise CourseError(str(error).replace(f"{folder}{os.sep}", "")) from error
    return None


def _refuse_link(path: Path) -> None:
    """Refuses what leads elsewhere: below submitted/ a link may lead to somebody else's file."""
    for place in (path.parent, path):
        if place.is_symlink():
            raise CourseError(f"{place} is a link; {OWN_FILE}")
    if path.is_file() and path.stat().st_nlink > 1:
        raise CourseError(
            f"{path} is a link: the same file stands under another name, too; {OWN_FILE}"
        )


def misnamed(folder: Path, student: str, sheets: Collection[str]) -> str:
    """The first of a student's files that is named after no sheet; empty when there is none."""
    known = {f"{sheet}{suffix}" for sheet, suffix in product(sheets, READERS)}
    for name in _visible_names(folder / "submitted" / student):
        if name not in known and not name.endswith(REQUEST):
            return name
    return ""


def passed_over(
    folder: Path, student: str, sheet: str, sheets: Collection[str], marked: Path
) -> list[str]:
    """Files of a student that look like another version of the one that is marked."""
    known = {f"{other}{suffix}" for other, suffix in product(sheets, READERS) if other != sheet}
    found: list[str] = []
    for name in _visible_names(folder / "submitted" / student):
        if name == marked.name or name in known or Path(name).suffix not in READERS:
            continue
        if name.casefold().startswith(sheet.casefold()):
            found.append(printable(name))
    return found


def strangers(folder: Path, students: Collection[str]) -> list[str]:
    """Names in submitted/ that are nobody's of the roster."""
    found: list[str] = []
    for name in _visible_names(folder / "submitted"):
        if name in students:
            continue
        found.append(printable(name))
    return found


def _visible_names(folder: Path) -> list[str]:
    """What lies in a folder, sorted, without files that systems hide; nothing where none is."""
    try:
        names = sorted(path.name for path in folder.iterdir())
    except OSError:
        return []
    return [name for name in names if not name.startswith(".")]


def read_submission(path: Path) -> Submission:
    """The bytes of one file.

    Raises:
        CourseError: it cannot be read, is too large, or has an ending that cannot be marked, at all
            or on this machine.
    """
    if path.suffix not in READERS:
        raise CourseError(
            f"{path}: a submission takes one of the endings {', '.join(READERS)}, "
            f"got {path.suffix!r}"
        )
    if path.suffix in HINDRANCES:
        hindrance = HINDRANCES[path.suffix]()
        if hindrance:
            raise CourseError(f"{path}: {hindrance}")
    try:
        return Submission(path, _bytes_of(path))
    except OSError as error:
        raise CourseError(f"{path} cannot be read: {error.strerror}") from error


def _bytes_of(path: Path) -> bytes:
    """What a file holds that is one, and not too large. Raises CourseError, OSError."""
    if path.is_symlink():  # it may point at somebody else's
        raise CourseError(f"{path} is a link; {OWN_FILE}")
    if path.exists() and not path.is_file():  # a pipe would be waited for
        raise CourseError(f"{path} cannot be read: it is not a file")
    size = path.stat().st_size
    most = MAX_NOTEBOOK if path.suffix == NOTEBOOK else MAX_BYTES
    if size > most:
        raise CourseError(f"{path} has {size >> 20} MB; a submission may have {most >> 20} MB")
    return path.read_bytes()
