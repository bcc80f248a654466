"""What goes wrong in the middle of a long run, said once and in one line."""

import logging
import os
from collections import Counter
from collections.abc import Generator
from contextlib import contextmanager

from .console import say

MARKING = "kinegrade.grader.marking.unjudged"


def debugging() -> bool:
    """Whether exceptions are wanted with their tracebacks."""
    return bool(os.environ.get("KINEGRADE_DEBUG"))


@contextmanager
def marking_failures() -> Generator[list[tuple[str, BaseException]]]:
    """Collects the exceptions that leave a part unmarked instead of logging them.

    The list that is given fills with the part's variable and the exception.
    """
    found: list[tuple[str, BaseException]] = []

    def collected(record: logging.LogRecord) -> bool:
        error = _error_of(record)
        if error is not None and isinstance(record.args, tuple):
            found.append((str(record.args[0]), error))
        return debugging()

    logger = logging.getLogger(MARKING)
    logger.addFilter(collected)
    try:
        yield found
    finally:
        logger.removeFilter(collected)


def _error_of(record: logging.LogRecord) -> BaseException | None:
    if not record.exc_info:
        return None
    return record.exc_info[1]


@contextmanager
def one_of_each() -> Generator[None]:
    """Complaints of all that runs inside are said once."""
    handler = _OneOfEach()
    logging.getLogger().addHandler(handler)
    try:
        yield
    finally:
        logging.getLogger().removeHandler(handler)
        handler.close()


class _OneOfEach(logging.Handler):
    """Says the first of equal complaints in one line, and when it is closed how many more came."""

    def __init__(self) -> None:
        """Hears warnings and errors."""
        super().__init__(logging.WARNING)
        self._first: dict[tuple[str, ...], str] = {}
        self._more: Counter[tuple[str, ...]] = Counter()

    def emit(self, record: logging.LogRecord) -> None:
        """Says or counts one complaint.

        Equal are those of one kind and place, whoever's sheet it was.
        """
        # These bring numpy, for those who complain only.
        from ...exercises.files.loading import place, stopped

        said = f"{record.levelname}: {record.getMessage()}"
        where = ""
        error = _error_of(record)
        if error is not None:
            said = f"{said}: {stopped(error)}"
            where = place(error)
        kind = (record.name, record.msg, type(error).__name__, where)
        kind = getattr(record, "complaint", kind)  # another process has looked at it already
        if kind in self._first:
            self._more[kind] += 1
            return

        self._first[kind] = said
        say(said)
        if debugging() and record.exc_info:
            say(logging.Formatter().formatException(record.exc_info))

    def close(self) -> None:
        """Says how many of each were left out."""
        for kind, more in self._more.items():
            say(f"{more} more like it: {self._first[kind]}")
        self._more.clear()
        super().close()
