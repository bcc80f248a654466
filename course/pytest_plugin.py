"""pytest in a course repository: every file of the course's exercises/ folder is validated, with no other set-up.

Draws per exercise are the ini value `kinegrade_seeds`, 100 by default.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator


class InvalidExercise(Exception):
    """What a failed item shows in place of a traceback."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Declares the ini value."""
    parser.addini("kinegrade_seeds", "Draws of every exercise of a course that are validated.", default="100")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> "ExerciseFile | None":
    """An exercise file in the exercises/ folder beside a course.toml."""
    if file_path.suffix != ".py" or file_path.parent.name != "exercises":
        return None
    if not (file_path.parent.parent / "course.toml").exists():
        return None
    from ..exercises.catalogue import defines_exercise

    if not defines_exercise(file_path):
        return None
    found: ExerciseFile = ExerciseFile.from_parent(parent, path=file_path)  # pyright: ignore[reportUnknownMemberType]
    return found


class ExerciseFile(pytest.File):
    """One file, one item."""

    def collect(self) -> "Iterator[ExerciseItem]":
        """The item that validates the file."""
        yield ExerciseItem.from_parent(self, name="is_valid")  # pyright: ignore[reportUnknownMemberType]


class ExerciseItem(pytest.Item):
    """Validates its file."""

    def runtest(self) -> None:
        """Raises InvalidExercise with all that failed."""
        from .validate import summary, validate_file

        validation = validate_file(self.path, int(self.config.getini("kinegrade_seeds")))
        if validation.failures:
            raise InvalidExercise("\n".join(summary(validation)))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """The sentences alone; anything unexpected with its traceback."""
        if isinstance(excinfo.value, InvalidExercise):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, None, str]:
        """Where the item is, as pytest prints it."""
        return self.path, None, f"exercise {self.path.stem}"
