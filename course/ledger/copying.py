"""A gradebook copied to another place: for a backup, or from one database to the other."""

from sqlalchemy import Connection, RowMapping, Table, func, select
from sqlalchemy.exc import StatementError

from ..settings.config import CourseError
from .damage import is_whole
from .database import Database
from .tables import LEDGER, entry, version

AT_ONCE = 1000  # rows
PLACE = ("student", "sheet", "part", "entry", "grade", "place", "number", "id")
"""Columns by which a row is found."""


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
        try:
            for table in _tables():
                for rows in reader.execute(select(table)).mappings().partitions(AT_ONCE):
                    writer.execute(table.insert(), [dict(row) for row in rows])
        except StatementError as error:
            damage = _damage(reader)
            if not damage:
                raise
            raise CourseError(
                f"{source.place}: {damage} is damaged, and nothing was copied; "
                "put a backup back, or mend that row"
            ) from error
        return _changes(writer)


def _tables() -> list[Table]:
    return [table for table in LEDGER.sorted_tables if table is not version]


def _damage(connection: Connection) -> str:
    """The first row that cannot be copied, in words; empty where all can."""
    for table in _tables():
        for row in connection.execute(select(table)).mappings():
            if not is_whole(row, table):
                return _named(table, row)
        for key in table.foreign_keys:
            lost = select(table).where(key.parent.not_in(select(key.column)))
            row = connection.execute(lost.limit(1)).mappings().first()
            if row is not None:
                return _named(table, row)
    return ""


def _named(table: Table, row: RowMapping) -> str:
    found = dict(row)
    named = [f"{name} {found[name]}" for name in PLACE if name in found]
    return f"the row of table {table.name} with {', '.join(named)}"


def _changes(connection: Connection) -> int:
    return connection.scalar(select(func.count()).select_from(entry)) or 0
