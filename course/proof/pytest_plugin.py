# pyright: reportUnknownMemberType=false
"""pytest where exercises lie: every file of an exercises/ folder that defines one is validated.

It takes no set-up. Draws of each are the option --kinegrade-draws, or the ini value
`kinegrade_draws` (before: `kinegrade_seeds`), or 20. The exercises of this package are not
collected: its own tests prove them, and theirs is another folder.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator

OPTION = "--kinegrade-draws"
INI = ("kinegrade_draws", "kinegrade_seeds")
DRAWS = "20"
OURS = Path(__file__).resolve().parents[2] / "exercises"


class InvalidExercise(Exception):
    """What a failed item shows in place of a traceback."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Declares the option and the ini values."""
    group = parser.getgroup("kinegrade", "robotics exercises")
    group.addoption(
        OPTION, metavar="N", default="", help="Draws of every exercise that are validated."
    )
    parser.addini(
        INI[0], f"Draws of every exercise that are validated ({DRAWS} when not given).", default=""
    )
    parser.addini(INI[1], f"The older name of {INI[0]}.", default="")


def pytest_configure(config: pytest.Config) -> None:
    """Refuses a number of draws that is none, before anything is collected."""
    draws(config)


def draws(config: pytest.Config) -> int:
    """Draws of every exercise: the first that is given of the option and the ini values.

    Raises:
        pytest.UsageError: it is no positive whole number.
    """
    given: dict[str, Any] = {OPTION: config.getoption(OPTION)}
    for name in INI:
        given[name] = config.getini(name)
    for name, value in given.items():
        text = str(value).strip()
        if text:
            return _positive(name, text)
    return int(DRAWS)


def _positive(name: str, given: str) -> int:
    if not given.isascii() or not given.isdigit() or int(given) == 0:
        raise pytest.UsageError(f"{name} takes a positive whole number, got {given!r}")
    return int(given)


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> "ExerciseFile | None":
    """A file in an exercises/ folder with an EXERCISE, unless it is one of this package."""
    if file_path.suffix != ".py" or file_path.parent.name != "exercises":
        return None
    if file_path.resolve().is_relative_to(OURS):
        return None
    from ...exercises.files.finding import defines_exercise

    if not defines_exercise(file_path):
        return None
    found: ExerciseFile = ExerciseFile.from_parent(parent, path=file_path)
    return found


class ExerciseFile(pytest.File):
    """One file, one item."""

    def collect(self) -> "Iterator[ExerciseItem]":
        """The item that validates the file."""
        yield ExerciseItem.from_parent(self, name="is_valid")


class ExerciseItem(pytest.Item):
    """Validates its file."""

    def runtest(self) -> None:
        """Raises InvalidExercise with all that failed."""
        from .validate import validate_file
        from .validation import summary

        validation = validate_file(self.path, draws(self.config))
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
