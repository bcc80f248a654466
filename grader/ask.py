"""What to bring back from a submission, and what bringing it back may use."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..solutions.errors import KinegradeError

MAX_CALLS = 200


class AskError(KinegradeError):
    """A call is asked for that cannot be made."""


@dataclass(frozen=True)
class Ask:
    """One variable to bring back; `calls` are the arguments of each call, where it shall hold a function.

    An argument is a number, text, or a nested list of numbers, which reaches the function as a new float array.

    Raises:
        AskError: another kind of argument, a list with rows of different lengths, or more than 200 calls.
    """

    name: str
    calls: tuple[tuple[Any, ...], ...] = ()

    def __post_init__(self) -> None:
        """Refuses arguments here, where it is our mistake; in the student's process it would be the student's."""
        if len(self.calls) > MAX_CALLS:
            raise AskError(f"{self.name}: at most {MAX_CALLS} calls can be asked for, got {len(self.calls)}")
        for number, call in enumerate(self.calls, 1):
            for argument in call:
                _check(f"{self.name}, call {number}", argument)


@dataclass(frozen=True)
class Limits:
    """What one notebook may use: processor seconds for a cell, seconds on the clock for all, memory, written files.

    A cell that does nothing but wait may wait three times as long as it may compute. A call of an asked function has
    the time of a cell; after the first that runs out of it, all others share as much again.
    """

    cell_seconds: float = 5.0
    notebook_seconds: float = 60.0
    memory_mb: int = 2048
    file_mb: int = 16


def _check(where: str, argument: Any) -> None:
    if isinstance(argument, int | float | str):
        return
    try:
        if not isinstance(argument, list | tuple | np.ndarray):
            raise TypeError(type(argument).__name__)  # noqa: TRY301 - one sentence for all
        np.array(argument, dtype=float)  # pyright: ignore[reportUnknownArgumentType]
    except (TypeError, ValueError) as error:
        raise AskError(f"{where}: an argument takes a number, text or a list of equal rows, got {error}") from error
