"""Points in time as systems write them, in several languages, with the zone that they leave out."""

import re
from datetime import datetime, tzinfo
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from ..errors import CourseError

MONTHS: dict[int, tuple[str, ...]] = {
    1: ("jan", "jän", "ene", "gen"),
    2: ("feb", "fév", "fev"),
    3: ("mar", "mär", "mrt", "maa"),
    4: ("apr", "avr", "abr"),
    5: ("may", "mai", "mei", "mag"),
    6: ("jun", "juin", "giu"),
    7: ("jul", "juil", "lug"),
    8: ("aug", "aoû", "ago"),
    9: ("sep", "set"),
    10: ("oct", "okt", "ott", "out"),
    11: ("nov",),
    12: ("dec", "dez", "déc", "dic"),
}
"""How names of months begin in English, German, French, Spanish, Italian, Dutch, Portuguese."""
WRITTEN = re.compile(
    r"(\d{1,2})\.?\s+(?:de\s+)?([^\W\d_]+)\.?\s+(?:de\s+)?(\d{4}),?\s+"
    r"(\d{1,2})[:h.](\d{2})(?:\s*([AaPp])\.?\s?[Mm]\.?)?"
)
"""Such as Monday, 23 November 2026, 11:59 PM or Montag, 23. November 2026, 23:59."""
PLAIN = re.compile(
    r"(\d{4}-\d{2}-\d{2})[ T](\d{2}:\d{2}(?::\d{2})?)(?:\.\d+)?\s*"
    r"(Z|UTC|[+-]\d{2}:?\d{2}|[A-Z][A-Za-z_]+(?:/[A-Za-z_/+-]+)?)?"
)
"""Such as 2026-11-23 23:59:00.123 UTC; a zone of a name that nobody knows makes it no time."""


def zone_named(name: str) -> tzinfo | None:
    """A zone such as Europe/Berlin; None, the machine's own, where none is named.

    Raises:
        CourseError: there is no zone of that name.
    """
    if not name:
        return None
    try:
        return ZoneInfo(name)
    except (ZoneInfoNotFoundError, ValueError) as error:
        raise CourseError(
            f"--zone takes the name of a time zone such as Europe/Berlin, got {name!r}"
        ) from error


def time_given(text: str, zone: tzinfo | None) -> datetime | None:
    """The time of --received; None where none is given.

    Raises:
        CourseError: it is no time.
    """
    if not text:
        return None
    found = moment(text, zone)
    if found is None:
        raise CourseError(f"--received takes a time such as 2026-11-23T23:59, got {text!r}")
    return found


def moment(text: str, zone: tzinfo | None) -> datetime | None:
    """The time that a text says, in its own zone, else in `zone`; None where it says none."""
    plain = PLAIN.search(text)
    if plain is not None:
        return _plain(plain, zone)
    written = WRITTEN.search(text)
    if written is None:
        return None
    day, month_name, year, hour, minute, half = written.groups()
    month = _month(month_name)
    if month is None:
        return None
    hours = int(hour)
    if half:
        hours = hours % 12 + (12 if half in "pP" else 0)
    try:
        found = datetime(int(year), month, int(day), hours, int(minute))  # noqa: DTZ001
    except ValueError:
        return None
    return in_zone(found, zone)


def in_zone(found: datetime, zone: tzinfo | None) -> datetime:
    """A time without a zone, in one; None is the machine's own."""
    if zone is None:
        return found.astimezone()
    return found.replace(tzinfo=zone)


def _plain(found: re.Match[str], zone: tzinfo | None) -> datetime | None:
    date, time, own = found.groups()
    try:
        if own in ("Z", "UTC"):
            return datetime.fromisoformat(f"{date}T{time}+00:00")
        if own and own[0] in "+-":
            return datetime.fromisoformat(f"{date}T{time}{own}")
        if own:
            zone = ZoneInfo(own)
        return in_zone(datetime.fromisoformat(f"{date}T{time}"), zone)
    except (ValueError, ZoneInfoNotFoundError):
        return None


def _month(name: str) -> int | None:
    small = name.casefold()
    for month, starts in MONTHS.items():
        if small.startswith(starts):
            return month
    return None
