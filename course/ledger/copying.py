"""A gradebook copied to another place: for a backup, or from one database to the other."""

from sqlalchemy import Connection, func, select

from ..settings.config import CourseError
from .database import Database
from .tables import LEDGER, entry, version

AT_ONCE = 1000  # rows


def copy_ledger(source: Database, target: Database) -> int:
    """Copies all rows, as they are at one moment, into a gradebook that holds nothing yet.

    Returns:
        How many changes it holds.

    Raises:
        CourseError: the other gradebook holds something, or one of them cannot be used.
    """
    with source.reading() as reader, target.writing() as writer:
        if _changes(writer):
            raise CourseError(f"{target.place} holds a gradebook already; name a new place")
        for table in LEDGER.sorted_tables:
            if table is version:
                continue
            for rows in reader.execute(select(table)).mappings().partitions(AT_ONCE):
                writer.execute(table.insert(), [dict(row) for row in rows])
        return _changes(writer)


def _changes(connection: Connection) -> int:
    return connection.scalar(select(func.count()).select_from(entry)) or 0
