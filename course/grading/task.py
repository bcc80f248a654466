"""Kinds of work, as they travel: text in, text out, and nothing in it that is run."""

import atexit
import json
from base64 import urlsafe_b64encode
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from threading import Lock
from typing import Any, Generic, TypeVar

from pydantic import TypeAdapter

from ...grader.jail.jail import Jail
from .check import Check, Checked, checked
from .overheard import overheard
from .work import Done, Walls, Work, do

T = TypeVar("T")
R = TypeVar("R")
JailOf = Callable[[Walls], Jail]
_STARTING = Lock()


@dataclass(frozen=True)
class Task(Generic[T, R]):
    """A kind of work: what goes in, what it does, what comes out.

    What comes out is a dataclass with `complaints`. A task itself travels by the names of these.
    """

    takes: type[T]
    does: Callable[[T, JailOf], R]
    gives: type[R]


MARK = Task(Work, do, Done)
CHECK = Task(Check, checked, Checked)


def packed(data: Any) -> bytes:
    """Plain data as JSON; half characters become question marks, as in the gradebook."""
    text = json.dumps(data, default=_plain, ensure_ascii=False)
    return text.encode(errors="replace")


def _plain(data: object) -> str | dict[str, Any]:
    """The fields of a dataclass, and bytes as text."""
    if isinstance(data, bytes):
        return urlsafe_b64encode(data).decode()
    return vars(data)


def unpacked(kind: type[T], text: bytes) -> T:
    """The data that `packed` wrote.

    Raises:
        ValidationError: it is something else.
    """
    return _adapter(kind).validate_json(text)


@cache
def _adapter(kind: type[Any]) -> TypeAdapter[Any]:
    return TypeAdapter(kind)


def there(task: Task[Any, Any], text: bytes) -> bytes:
    """Does a piece of work in a process that people do not look at."""
    with overheard() as complaints:
        result = task.does(unpacked(task.takes, text), jail_there)
    return packed(replace(result, complaints=tuple(complaints)))


def jail_there(walls: Walls) -> Jail:
    """The jail of this process, kept as long as it lives."""
    with _STARTING:
        return _jail(walls)


@cache
def _jail(walls: Walls) -> Jail:
    jail = walls.jail()
    atexit.register(jail.close)
    return jail
