"""What goes wrong in the middle of a long run, said once and in one line."""

import logging
import os
from collections import Counter
from collections.abc import Generator
from contextlib import contextmanager

from .console import say

MARKING = "kinegrade.grader.marking.mark"


def debugging() -> bool:
    """Whether exceptions are wanted with their tracebacks."""
    return bool(os.environ.get("KINEGRADE_DEBUG"))


@contextmanager
def marking_failures() -> Generator[list[tuple[str, BaseException]]]:
    """Collects the exceptions that leave a part unmarked, with the part's variable, instead of logging them."""
    found: list[tuple[str, BaseException]] = []

    def collected(record: logging.LogRecord) -> bool:
        if record.exc_info and record.exc_info[1] and isinstance(record.args, tuple):
            found.append((str(record.args[0]), record.exc_info[1]))
        return debugging()

    logger = logging.getLogger(MARKING)
    logger.addFilter(collected)
    try:
        yield found
    finally:
        logger.removeFilter(collected)


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
    """Says the first of equal complaints on stderr, in one line, and when it is closed how many more there were."""

    def __init__(self) -> None:
        """Hears warnings and errors."""
        super().__init__(logging.WARNING)
        self._first: dict[tuple[str, ...], str] = {}
        self._more: Counter[tuple[str, ...]] = Counter()

    def emit(self, record: logging.LogRecord) -> None:
        """Says or counts one complaint. Equal are those of one kind and place, whoever's sheet it was."""
        from ..exercises.files.loading import (
            place,
            stopped,
        )  # which brings numpy, for those who complain

        error = record.exc_info[1] if record.exc_info else None
        kind = (record.name, record.msg, type(error).__name__, place(error) if error else "")
        if kind in self._first:
            self._more[kind] += 1
            return
        said = f"{record.levelname}: {record.getMessage()}{f': {stopped(error)}' if error else ''}"
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
