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
    newest = connection.scalar(select(func.max(entry.c.id))) or 0
    row = {
        "id": newest + 1,
        "at": datetime.now(UTC).isoformat(timespec="milliseconds"),
        "author": plain(change.author or user()),
        "reason": plain(change.reason),
    }
    connection.execute(entry.insert().values(**row))
    return newest + 1
