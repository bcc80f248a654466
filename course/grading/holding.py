"""Which recorded answers are still those of today: looked at once for every state of the code."""

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from ...exercises.files.finding import exercise_files
from ...exercises.files.text import exercise_text
from ..machine.code import installed
from ..machine.kept import keep, kept
from ..settings.config import Course
from ..variants.record import Record, canonical, digest
from .check import Check
from .place import Place
from .rules import rules_hash
from .task import CHECK

HOLDING = "holding"
AT_ONCE = 16  # records that are looked at as one piece of work
Name = tuple[str, str]
"""Student and exercise."""


class Holding:
    """What is known of the records of one sheet."""

    def __init__(self, course: Course, sheet: str, slugs: Sequence[str]) -> None:
        """Takes what was found out before, as far as it is about the code of today.

        Raises:
            ExerciseError: a file of an exercise cannot be read.
        """
        self._course = course.folder
        self._sheet = sheet
        own = course.folder / "exercises"
        files = exercise_files(own)
        self._files = {slug: files[slug] for slug in slugs}
        self.rules = {slug: rules_hash(path) for slug, path in self._files.items()}
        self._code = {slug: _state(rules, own) for slug, rules in self.rules.items()}
        self._known: dict[str, set[str]] = {}
        before = kept(HOLDING, self._course, sheet)
        for slug, code in self._code.items():
            self._known[slug] = set(before.get(f"{slug} {code}", ()))
        self._new = False

    def moved(self, records: Sequence[Record], place: Place) -> dict[Name, tuple[str, ...]]:
        """Variables whose reference is no longer the recorded one, of those records where it is so.

        What is not known is looked at in `place`.

        Raises:
            KinegradeError: an exercise cannot be looked at, there.
        """
        unknown = [record for record in records if not self._holds(record)]
        found: dict[Name, tuple[str, ...]] = {}
        pieces = list(self._pieces(unknown))
        for some, result in place.run(CHECK, zip(pieces, pieces, strict=True), len(pieces)):
            if isinstance(result, BaseException):
                raise result
            for record, moved in zip(some.records, result.moved, strict=True):
                if moved:
                    found[record.student, record.exercise] = moved
                else:
                    self.add(record)
        self.save()
        return found

    def add(self, record: Record) -> None:
        """A record holds: its answers were computed just now."""
        self._known[record.exercise].add(_name(record))
        self._new = True

    def save(self) -> None:
        """Keeps what was found out."""
        if not self._new:
            return
        known = {f"{slug} {self._code[slug]}": sorted(own) for slug, own in self._known.items()}
        keep(HOLDING, self._course, self._sheet, known)
        self._new = False

    def _holds(self, record: Record) -> bool:
        return _name(record) in self._known[record.exercise]

    def _pieces(self, records: Sequence[Record]) -> Iterator[Check]:
        by_exercise: dict[str, list[Record]] = {}
        for record in records:
            by_exercise.setdefault(record.exercise, []).append(record)
        for slug, own in by_exercise.items():
            text = exercise_text(self._files[slug])
            for start in range(0, len(own), AT_ONCE):
                yield Check(text, tuple(own[start : start + AT_ONCE]))


def _name(record: Record) -> str:
    return digest(canonical([record.numbers, record.answers]).encode())


def _state(rules: str, own: Path) -> str:
    """A hash of what answers follow from besides the numbers: code, libraries, files of data."""
    libraries = [installed(name) for name in ("kinegrade", "numpy", "sympy")]
    files: list[tuple[str, int, int]] = []
    for path in sorted(own.rglob("*")):
        if path.suffix != ".py" and path.is_file():
            about = path.stat()
            files.append((path.name, about.st_size, about.st_mtime_ns))
    return digest(canonical([rules, sys.version, libraries, files]).encode())
