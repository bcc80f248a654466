"""Opening a gradebook: new tables where there are none, a migration where they are older."""

import os
from pathlib import Path

from sqlalchemy import Connection, inspect, text

from ..settings.config import CourseError
from .database import Database
from .tables import LEDGER, VERSION, version

FIRST = "1"  # before Alembic, the format stood in a table of its own
NEW = ""


def open_ledger(database: Database) -> None:
    """Sees to it that the tables are those of today.

    Raises:
        CourseError: the gradebook is of a later version, or no gradebook at all.
    """
    with database.reading() as connection:
        found = _format(connection)
    if found == VERSION:
        return
    with database.writing() as connection:
        found = _format(connection)  # another kinegrade may have been first
        if found == VERSION:
            return
        if found == NEW:
            LEDGER.create_all(connection)
            connection.execute(version.insert().values(version_num=VERSION))
            return
        _migrate(connection, found, database.place)


def _format(connection: Connection) -> str:
    """The version of the tables; nothing where there are none."""
    tables = inspect(connection).get_table_names()
    if version.name in tables:
        return str(connection.scalar(text("SELECT version_num FROM alembic_version")))
    if "meta" in tables:
        return str(connection.scalar(text("SELECT value FROM meta WHERE key = 'format'")))
    return NEW


def _migrate(connection: Connection, found: str, place: str) -> None:
    """Turns older tables into those of today, in the transaction of the connection."""
    from alembic import command  # not needed by any later run
    from alembic.config import Config
    from alembic.script import ScriptDirectory

    config = Config()
    config.set_main_option("script_location", _escaped(Path(__file__).with_name("migrations")))
    config.set_main_option("path_separator", "os")
    steps = ScriptDirectory.from_config(config).walk_revisions()
    if found not in {FIRST, *(step.revision for step in steps)}:
        raise CourseError(
            f"{place}: the gradebook has format {found}; this version reads {VERSION} and older"
        )
    config.attributes["connection"] = connection
    command.upgrade(config, "head")
    if Path(place).is_file():
        os.chmod(place, 0o600)  # noqa: PTH101 - the first format left that to the umask


def _escaped(path: Path) -> str:
    return str(path).replace("%", "%%")
