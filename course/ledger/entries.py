"""Entries: when a change was made, by whom and why."""

import getpass
from dataclasses import dataclass
from datetime import UTC, datetime

from sqlalchemy import Connection, func, select

from .damage import plain
from .tables import entry


def user() -> str:
    """The name under which this process runs, as far as the machine knows one."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # a number alone, as in some containers; Windows
        return "unknown"


@dataclass(frozen=True)
class Change:
    """Who changes something, else the user of this process, and why."""

    author: str = ""
    reason: str = ""


def enter(connection: Connection, change: Change) -> int:
    """Adds an entry of now and returns its number.

    Numbers follow the order of the changes, since nobody else writes meanwhile.
    """
    (number,) = enter_all(connection, change, 1)
    return number


def enter_all(connection: Connection, change: Change, count: int) -> range:
    """Adds as many entries of now as there are changes of one kind, and returns their numbers."""
    newest = connection.scalar(select(func.max(entry.c.id))) or 0
    numbers = range(newest + 1, newest + 1 + count)
    about = {
        "at": datetime.now(UTC).isoformat(timespec="milliseconds"),
        "author": plain(change.author or user()),
        "reason": plain(change.reason),
    }
    if count:
        connection.execute(entry.insert(), [{"id": number, **about} for number in numbers])
    return numbers
