"""Where a gradebook lies: a SQLite file, or a PostgreSQL database by its URL."""

from pathlib import Path

from sqlalchemy import URL, make_url
from sqlalchemy.exc import ArgumentError

from ..settings.config import CourseError

POSTGRES = "postgresql"
TAKES = "a gradebook takes a file, or a URL such as postgresql://user@host/database"


def address(place: Path | str) -> URL:
    """The address of a file, or of what a URL names.

    Raises:
        CourseError: it is no such URL; the sentence never repeats it, as it may hold a password.
    """
    if isinstance(place, Path) or "://" not in place:
        return URL.create("sqlite", database=str(place))
    try:
        url = make_url(place)
    except (ArgumentError, ValueError):
        raise CourseError(f"the gradebook's URL cannot be read; {TAKES}") from None
    backend = url.get_backend_name()
    if backend != POSTGRES:
        raise CourseError(f"{backend}:// is no gradebook; {TAKES}")
    return url.set(drivername=f"{POSTGRES}+psycopg")


def shown(url: URL) -> str:
    """An address in sentences: no user, no password and no option of the connection."""
    if url.get_backend_name() != POSTGRES:
        return str(url.database)
    host = url.host or "this machine"
    return f"{POSTGRES}://{host}/{url.database or ''}"


def without_password(place: str) -> str:
    """A URL of course.toml, which others may read.

    Raises:
        CourseError: it holds a password.
    """
    url = address(place)
    if url.password is not None or "password" in url.query:
        raise CourseError(
            "course.toml: gradebook.url holds a password; leave it out, and put it into the "
            "variable PGPASSWORD or the file ~/.pgpass, where PostgreSQL looks for it"
        )
    return place
