"""A file as it was handed in: what to ask of it, and the raw values that come out of it."""

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...exercises.exercise import Exercise, Function, Part, Variant
from ...grader.collecting.ask import Ask, AskError, Limits
from ...grader.collecting.collect import cannot_run, collect
from ...grader.collecting.machine_paths import without_paths
from ...grader.collecting.mat_file import cannot_read, from_mat
from ...grader.collecting.matlab_file import from_m
from ...grader.collecting.named_matrices import every, from_csv, from_json
from ...grader.collecting.other_formats import other_format
from ...grader.collecting.wire import Raw
from ...grader.jail.jail import Jail
from ..errors import CourseError
from .about import NOTEBOOK, SCRIPT
from .upload import Upload, is_own_file, mentions, on_disk, visible_names

__all__ = ["NOTEBOOK", "READERS", "RUN", "SCRIPT", "Submission", "read_submission"]

log = logging.getLogger(__name__)
MAX_BESIDE = 32 << 20  # of the files beside a notebook
RUN = (NOTEBOOK, SCRIPT)
"""Endings of files that are run."""
Reader = Callable[[bytes, Sequence[Ask], Limits], dict[str, Raw]]
READERS: dict[str, Reader] = {
    NOTEBOOK: collect,
    SCRIPT: lambda data, asks, limits: collect(data, asks, limits, script=f"sheet{SCRIPT}"),
    ".json": lambda data, asks, _: from_json(data, asks),
    ".csv": lambda data, asks, _: from_csv(data, asks),
    ".mat": lambda data, asks, _: from_mat(data, asks),
    ".m": lambda data, asks, _: from_m(data, asks),
}
"""Endings of files that can be marked; of two files of one age, the first one counts."""
HINDRANCES: dict[str, Callable[[], str]] = {
    NOTEBOOK: cannot_run,
    SCRIPT: cannot_run,
    ".mat": cannot_read,
}
"""Why files of an ending cannot be marked on this machine.

It is no fault of the student's, so never a zero.
"""


@dataclass(frozen=True)
class Submission:
    """One file as it was handed in.

    Attributes:
        path: Where it lies; of a file in a zip archive, the path begins with that of the archive.
        data: What it holds.
        packed: The files beside it in an archive that it mentions; None on the disk.
        handed_in: The archive that it came in; None where it came alone.
        unread: Other files that look like versions of it, which were not read.
    """

    path: Path
    data: bytes
    packed: Mapping[str, bytes] | None = None
    handed_in: Path | None = None
    unread: tuple[str, ...] = ()

    @property
    def ending(self) -> str:
        """What the file is by its name, in small letters."""
        return self.path.suffix.lower()

    @property
    def is_run(self) -> bool:
        """Whether it is a notebook or a script, and no file of values."""
        return self.ending in RUN

    def asks(self, exercise: Exercise, v: Variant) -> list[Ask]:
        """What to bring back: a notebook's functions are called, a file holds results of calls.

        A part whose calls cannot be made has an Ask that says why; all others are asked for.
        """
        published = not self.is_run
        asks: list[Ask] = []
        for part in exercise.asked:
            asks.append(_ask(part, v, published=published))
            asks += map(Ask, part.beside.values())
        return asks

    def beside(self) -> dict[str, bytes]:
        """Files in the same folder that the notebook mentions, by name: data, modules.

        No links, as these may lead anywhere, and no more than a jail holds.

        Raises:
            CourseError: one of them cannot be read.
        """
        if self.packed is not None:
            return dict(self.packed)
        found: dict[str, bytes] = {}
        left = MAX_BESIDE
        if not self.is_run or not self.data:
            return found
        for name in visible_names(self.path.parent):
            path = self.path.parent / name
            if name == self.path.name or not mentions(self.data, path.stem):
                continue
            upload = on_disk(path)
            if not is_own_file(path) or upload.size > left:
                continue
            found[name] = upload.read()
            left -= len(found[name])
        return found

    def raws(
        self,
        asks: Sequence[Ask],
        limits: Limits,
        jail: Jail | None = None,
        beside: Mapping[str, bytes] | None = None,
    ) -> dict[str, Raw]:
        """The asked values; runs the notebook or script, or reads the file of matrices.

        Files `beside` the notebook are looked for where they are not given.

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
        if not self.is_run:
            return found | READERS[self.ending](self.data, asked, limits)
        if asked:
            if beside is None:
                beside = self.beside()
            script = self.path.name if self.ending == SCRIPT else ""
            found |= collect(self.data, asked, limits, jail=jail, beside=beside, script=script)
            for ask in asked:
                if ask.calls:
                    found[ask.name] = _called(found[ask.name])
        return found


def _called(raw: Raw) -> Raw:
    """What a call in a notebook brought back; results that are listed there are no answer.

    Those were not computed before our eyes.
    """
    if raw.kind in ("num", "text") or raw.listed:
        return Raw("error", "takes a function of this name, not its results, in a file that is run")
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


def read_submission(path: Path) -> Submission:
    """The bytes of one file.

    Raises:
        CourseError: it cannot be read, is too large, or has an ending that cannot be marked, at all
            or on this machine.
    """
    return submission_of(on_disk(path))


def submission_of(upload: Upload) -> Submission:
    """What was handed in, read. Raises CourseError as `read_submission`."""
    upload.raise_refusal()
    if upload.ending not in READERS:
        raise CourseError(
            f"{upload.path}: a submission takes one of the endings {', '.join(READERS)}, "
            f"got {upload.path.suffix!r}"
        )
    if upload.ending in HINDRANCES:
        hindrance = HINDRANCES[upload.ending]()
        if hindrance:
            raise CourseError(f"{upload.path}: {hindrance}")
    return Submission(upload.path, upload.data)
