"""What is complained about in another process, said in the one that people look at."""

import logging
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass

from ...exercises.files.loading import place, stopped


@dataclass(frozen=True)
class Complaint:
    """A warning or an error.

    Attributes:
        logger: Who complains.
        level: As logging counts them.
        said: In one line.
        kind: What makes it equal to others, whoever's submission it was.
    """

    logger: str
    level: int
    said: str
    kind: tuple[str, ...]


@contextmanager
def overheard() -> Generator[list[Complaint]]:
    """Collects complaints of this process while it works, which nobody would see."""
    ear = _Ear()
    root = logging.getLogger()
    root.addHandler(ear)
    try:
        yield ear.heard
    finally:
        root.removeHandler(ear)


def repeat(complaint: Complaint) -> None:
    """Complains here."""
    logger = logging.getLogger(complaint.logger)
    logger.log(complaint.level, "%s", complaint.said, extra={"complaint": complaint.kind})


class _Ear(logging.Handler):
    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.heard: list[Complaint] = []

    def emit(self, record: logging.LogRecord) -> None:
        said = record.getMessage()
        kind = [record.name, record.msg]
        error = record.exc_info[1] if record.exc_info else None
        if error is not None:
            said = f"{said}: {stopped(error)}"
            kind += [type(error).__name__, place(error)]
        self.heard.append(Complaint(record.name, record.levelno, said, tuple(kind)))
