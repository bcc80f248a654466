"""The database of a gradebook: transactions that read, and those that write, one at a time."""

import os
from collections.abc import Generator
from contextlib import contextmanager
from typing import Any

from sqlalchemy import URL, Connection, Engine, create_engine, event, text
from sqlalchemy.exc import DBAPIError

from ..settings.config import CourseError
from .address import POSTGRES, shown

WAIT = 30  # seconds for another kinegrade; each of its changes takes milliseconds
BUSY = ("SQLITE_BUSY", "SQLITE_LOCKED")
FULL = ("SQLITE_FULL",)
LOCK_NOT_AVAILABLE = "55P03"  # PostgreSQL's codes
DISK_FULL = "53100"
ALONE = "SELECT pg_advisory_xact_lock(hashtextextended('kinegrade ' || current_schema(), 0))"


class Database:
    """A SQLite file or a PostgreSQL database."""

    def __init__(self, url: URL) -> None:
        """Looks up the driver; nothing is opened yet.

        Raises:
            CourseError: the driver is not installed.
        """
        self.place = shown(url)
        self._postgres = url.get_backend_name() == POSTGRES
        if self._postgres:
            self._engine = _postgres(url)
        else:
            self._engine = _sqlite(url)

    def close(self) -> None:
        """Lets go of the database."""
        self._engine.dispose()

    @contextmanager
    def reading(self) -> Generator[Connection]:
        """One state of the gradebook, whatever others write meanwhile.

        Raises:
            CourseError: it cannot be read.
        """
        with self._sentences(), self._engine.connect() as connection:
            if self._postgres:
                connection.execution_options(isolation_level="REPEATABLE READ")
            yield connection

    @contextmanager
    def writing(self) -> Generator[Connection]:
        """All of what is done inside, or nothing; nobody else writes meanwhile.

        Raises:
            CourseError: it cannot be written, or somebody else writes for too long.
        """
        with self._sentences(), self._engine.connect() as connection:
            connection.execution_options(writes=True)
            with connection.begin():
                if self._postgres:
                    connection.execute(text(f"SET LOCAL lock_timeout = '{WAIT}s'"))
                    connection.execute(text(ALONE))
                yield connection

    @contextmanager
    def _sentences(self) -> Generator[None]:
        try:
            yield
        except DBAPIError as error:
            if _is(error.orig, BUSY, LOCK_NOT_AVAILABLE):
                raise CourseError(
                    f"{self.place}: another kinegrade is at work on this course; "
                    "what was done is kept, so run the command again when that one has ended"
                ) from error
            if _is(error.orig, FULL, DISK_FULL):
                raise CourseError(
                    f"{self.place}: the disk is full; what was recorded before is whole, "
                    "so make room and run the command again"
                ) from error
            why = " ".join(str(error.orig).split())
            raise CourseError(f"{self.place}: not a gradebook that can be used: {why}") from error


def _is(error: Any, names: tuple[str, ...], code: str) -> bool:
    """Whether SQLite gives an error one of these names, or PostgreSQL this code."""
    name = getattr(error, "sqlite_errorname", None) or ""
    return name.startswith(names) or getattr(error, "sqlstate", None) == code


def _postgres(url: URL) -> Engine:
    try:
        return create_engine(url)
    except ModuleNotFoundError as error:
        raise CourseError(
            "a gradebook on PostgreSQL takes psycopg: pip install 'kinegrade[postgres]'"
        ) from error


def _sqlite(url: URL) -> Engine:
    _make_private(str(url.database))
    engine = create_engine(url, connect_args={"timeout": WAIT})
    event.listen(engine, "connect", _set_up)
    event.listen(engine, "begin", _begin)
    return engine


def _make_private(path: str) -> None:
    """A new file is its owner's alone: what it holds is worth as much as the secret."""
    try:
        os.close(os.open(path, os.O_CREAT | os.O_EXCL, 0o600))
    except OSError:
        return  # it is there; or it cannot be made, which SQLite says better


def _set_up(connection: Any, _: Any) -> None:
    connection.isolation_level = None  # sqlite3 begins nothing by itself: _begin does
    connection.text_factory = _text
    connection.execute("PRAGMA foreign_keys = ON")


def _text(data: bytes) -> str:
    """Bytes that are no text spoil their own row, and not the reading of all."""
    return data.decode("utf-8", errors="replace")


def _begin(connection: Connection) -> None:
    how = "BEGIN"
    if connection.get_execution_options().get("writes"):
        how = "BEGIN IMMEDIATE"  # waits for others here, and not half way
    connection.exec_driver_sql(how)
