"""What to bring back from a submission, and what bringing it back may use."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from ...solutions.errors import KinegradeError

MAX_CALLS = 200
MAX_DEPTH = 8


class AskError(KinegradeError):
    """A call is asked for that cannot be made."""


@dataclass(frozen=True)
class Ask:
    """One variable to bring back; `calls` are the arguments of each call of a function.

    An argument is a number, text, or a list or dict of arguments, with text as names. Numbers in
    equal rows reach the function as a new float array, in dicts and lists too; all other lists
    stay lists. `hindrance` says why the calls cannot be made: then nothing is brought back, and
    the part waits for the instructor.

    Raises:
        AskError: another kind of argument, more than eight lists and dicts inside one another, or
            more than 200 calls.
    """

    name: str
    calls: tuple[tuple[Any, ...], ...] = ()
    hindrance: str = ""

    def __post_init__(self) -> None:
        """Refuses arguments here, where it is our mistake and not yet the student's."""
        if len(self.calls) > MAX_CALLS:
            raise AskError(
                f"{self.name}: at most {MAX_CALLS} calls can be asked for, got {len(self.calls)}"
            )
        for number, call in enumerate(self.calls, 1):
            where = f"{self.name}, call {number}"
            for argument in _arguments(where, call):
                _check(where, argument)


@dataclass(frozen=True)
class Limits:
    """What one notebook may use.

    A cell that does nothing but wait may wait three times as long as it may compute. A call of an
    asked function has the time of a cell; after the first that runs out of it, all others share
    as much again. To simplify the Jacobian of a Puma frame by frame takes sympy about 7 s.
    """

    cell_seconds: float = 30.0  # of the processor, for each cell
    notebook_seconds: float = 180.0  # on the clock, for all cells
    memory_mb: int = 2048
    file_mb: int = 16  # of each file that it writes


def _arguments(where: str, call: Any) -> Iterable[Any]:
    """The arguments of a call; an exercise file may have forgotten the tuple around one."""
    if not isinstance(call, tuple | list):
        raise AskError(
            f"{where}: a call takes a tuple of its arguments, such as (q,), got {call!r:.60}"
        )
    return cast("Iterable[Any]", call)


def _check(where: str, argument: Any, depth: int = MAX_DEPTH) -> None:
    """Refuses what would not reach the function as it stands here."""
    if isinstance(argument, str):
        return
    if isinstance(argument, int | float | np.ndarray | np.generic):
        _check_numbers(where, argument)
        return

    if depth == 0:
        raise AskError(
            f"{where}: an argument takes up to {MAX_DEPTH} lists and dicts inside one another, "
            "got more"
        )
    if isinstance(argument, dict):
        _check_named(where, cast("dict[Any, Any]", argument), depth)
        return
    if isinstance(argument, list | tuple):
        for item in cast("list[Any] | tuple[Any, ...]", argument):
            _check(where, item, depth - 1)
        return

    kinds = "numbers, text, and lists and dicts of them"
    raise AskError(
        f"{where}: an argument takes {kinds}, got {argument!r:.60} ({type(argument).__name__})"
    )


def _check_named(where: str, arguments: dict[Any, Any], depth: int) -> None:
    for name, value in arguments.items():
        if not isinstance(name, str):
            raise AskError(
                f"{where}: a dict takes text as names, such as {str(name)!r}, got {name!r}"
            )
        _check(f"{where}, {name}", value, depth - 1)


def _check_numbers(where: str, argument: Any) -> None:
    array = np.asarray(argument)
    if array.dtype.kind not in "biuf":  # complex ones, objects, and integers that no float can hold
        raise AskError(
            f"{where}: an argument takes real numbers, got {argument!r:.60} ({array.dtype})"
        )
