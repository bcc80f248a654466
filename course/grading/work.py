"""One submission collected and marked: what that takes, and what comes of it, as plain data."""

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from threading import Lock
from typing import Any

from pydantic import ConfigDict

from ...exercises.exercise import Exercise, Part
from ...exercises.files.text import Text, exercise_of
from ...grader.collecting.ask import Ask, Limits
from ...grader.collecting.wire import Raw
from ...grader.jail.jail import Jail
from ...grader.jail.level import Level, Permission
from ...grader.jail.packages import is_importable
from ...grader.marking.guesses import counted
from ...grader.marking.mark import mark
from ...grader.marking.price import Bill, Price
from ...grader.marking.verdict import Verdict, not_graded
from ...solutions.errors import KinegradeError
from ..settings.adjusting import adjusted_by
from ..sheet.submissions import RUN, Submission
from .overheard import Complaint
from .values import from_text, to_text

log = logging.getLogger(__name__)
AS_JSON = ConfigDict(ser_json_bytes="base64", val_json_bytes="base64", ser_json_inf_nan="constants")
"""Bytes that are no text, and numbers that are none, are kept as they are."""
_MARKING = Lock()  # numpy's settings and an exercise's modules are the process's


@dataclass(frozen=True)
class Walls:
    """Behind what a notebook is run.

    Attributes:
        permission: How far down it may go.
        packages: What can be imported besides the usual.
        level: The one that was found to work; none where each machine finds its own.
    """

    permission: Permission
    packages: tuple[str, ...] = ()
    level: Level | None = None

    def jail(self) -> Jail:
        """A jail that is made so."""
        return Jail(self.permission, self.packages, level=self.level)


@dataclass(frozen=True)
class Came:
    """What came out of a submission.

    Attributes:
        values: By variable, as text.
        level: Behind which walls it was run; None where nothing was.
    """

    values: str
    level: Level | None = None


@dataclass(frozen=True)
class Work:
    """All that the verdicts of one submission follow from.

    Attributes:
        student: Whose it is, for complaints.
        sheet: Of which sheet.
        name: The name of the file.
        data: What it holds.
        beside: The files that go with it, by name.
        exercises: The text of every exercise.
        adjustments: What the sheet sets otherwise than these.
        numbers: What was drawn of each.
        limits: What a notebook may use.
        price: What mistakes cost.
        walls: Behind what a notebook is run.
        others: Reference answers that are somebody else's, by exercise and student.
        peers: What somebody else handed in, too, by student.
        came: What came out of it before; None where it is still to be collected.
    """

    __pydantic_config__ = AS_JSON

    student: str
    sheet: str
    name: str
    data: bytes
    beside: dict[str, bytes]
    exercises: tuple[Text, ...]
    adjustments: dict[str, Any]
    numbers: tuple[dict[str, Any], ...]
    limits: Limits
    price: Price
    walls: Walls
    others: dict[str, dict[str, dict[str, Any]]]
    peers: dict[str, dict[str, Any]]
    came: Came | None = None

    @property
    def is_run(self) -> bool:
        """Whether it is a notebook or a script, and no file of values."""
        return Path(self.name).suffix.lower() in RUN


@dataclass(frozen=True)
class Done:
    """What came of a submission.

    Attributes:
        verdicts: Of all parts; none where the grader failed.
        failure: Why there are none.
        came: What came out of the submission.
        absent: Packages that it would have taken.
        complaints: What was said on the way in another process.
    """

    verdicts: tuple[Verdict, ...] = ()
    failure: str = ""
    came: Came = Came("{}")
    absent: tuple[str, ...] = ()
    complaints: tuple[Complaint, ...] = ()


def do(work: Work, jail_of: Callable[[Walls], Jail]) -> Done:
    """Collects and marks one submission; whatever happens on the way is part of what is done."""
    try:
        with _MARKING:
            exercises = adjusted_by(work.adjustments, map(exercise_of, work.exercises))
        came = work.came or _collected(work, exercises, jail_of)
        raws = from_text(came.values)
        with _MARKING:
            verdicts = _verdicts(work, exercises, raws)
    except Exception as error:
        log.exception("%s, sheet %s: the submission could not be marked", work.student, work.sheet)
        return Done(failure=failed(error))
    return Done(tuple(verdicts), "", came, _absent(raws, work.walls.packages))


def _collected(work: Work, exercises: Iterable[Exercise], jail_of: Callable[[Walls], Jail]) -> Came:
    jail: Jail | None = None
    level: Level | None = None
    if work.is_run:
        jail = jail_of(work.walls)
        level = jail.level
    submission = Submission(Path(work.name), work.data)
    asks: list[Ask] = []
    for exercise, numbers in zip(exercises, work.numbers, strict=True):
        asks += submission.asks(exercise, numbers)
    return Came(to_text(submission.raws(asks, work.limits, jail, work.beside)), level)


def _absent(raws: Mapping[str, Raw], allowed: tuple[str, ...]) -> tuple[str, ...]:
    """Packages that a notebook says it misses, without those that are there."""
    said = {raw.absent for raw in raws.values() if raw.absent}
    return tuple(sorted(name for name in said if not is_importable(name, allowed)))


def _verdicts(work: Work, exercises: Iterable[Exercise], raws: Mapping[str, Raw]) -> list[Verdict]:
    bill = Bill(work.price)
    verdicts: list[Verdict] = []
    for exercise, numbers in zip(exercises, work.numbers, strict=True):
        others = work.others.get(exercise.slug)
        try:
            found = mark(exercise, numbers, raws, others, peers=work.peers, bill=bill)
            verdicts += counted(exercise, found)
        except Exception as error:
            log.exception(
                "%s, sheet %s: %s could not be marked", work.student, work.sheet, exercise.slug
            )
            why = f"exercise {exercise.slug} failed with {type(error).__name__}"
            verdicts += waiting(exercise.asked, f"{why}; your answer is kept")
    return verdicts


def failed(error: BaseException) -> str:
    """Why there are no verdicts."""
    if isinstance(error, KinegradeError):  # it is a sentence by itself
        return str(error)
    return f"the grader failed with {type(error).__name__}"


def waiting(parts: Iterable[Part], reason: str) -> list[Verdict]:
    """Verdicts of parts that nobody could judge yet."""
    return [not_graded(part.variable, part.points, reason) for part in parts]
