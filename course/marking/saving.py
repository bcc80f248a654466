"""Grades on their way into the gradebook: those that come at the same time go together."""

import time
from collections.abc import Sequence
from typing import Self

from ...grader.marking.verdict import Verdict
from ..ledger.gradebook import Gradebook, GradeKey

PAUSE = 0.25  # [s] a transaction for each would take longer than to mark a small submission
MOST = 50


class Saving:
    """A context manager: at its end, be it by Ctrl-C, all that was added is saved.

    Who kills the process loses what waits: what came right behind a transaction, until the next
    grade comes. It is marked again.
    """

    def __init__(self, gradebook: Gradebook) -> None:
        """Nothing is waiting yet."""
        self._gradebook = gradebook
        self._waiting: dict[GradeKey, Sequence[Verdict]] = {}
        self._last = 0.0

    def add(self, key: GradeKey, verdicts: Sequence[Verdict]) -> None:
        """Takes a grade, and saves it with those that wait, unless some were saved just now.

        Raises:
            CourseError: the gradebook cannot be written.
        """
        self._waiting[key] = verdicts
        if time.monotonic() - self._last >= PAUSE or len(self._waiting) >= MOST:
            self._save()

    def _save(self) -> None:
        waiting, self._waiting = self._waiting, {}
        self._gradebook.save_grades(waiting)
        self._last = time.monotonic()

    def __enter__(self) -> Self:
        """Itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Saves what is left."""
        self._save()
