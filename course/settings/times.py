"""Times of a sheet in words, and how late something is by them."""

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta, tzinfo
from math import ceil

from ..errors import CourseError
from ..language.speech import phrase, phrase_count
from ..language.writing import number_text, time_text
from .toml_tables import Sheet

__all__ = [
    "IN_TIME",
    "Lateness",
    "days_text",
    "late_text",
    "lateness",
    "read_time",
    "rules_text",
    "time_text",
]
DAY = timedelta(days=1)
TAKES = "a time takes a form such as 2026-10-08T23:59 or 2026-10-08T23:59+02:00"


@dataclass(frozen=True)
class Lateness:
    """How late a submission came, and what that costs.

    Attributes:
        days: Begun after deadline and grace.
        percent: Of the points, which is taken off.
        too_late: Whether it came after the sheet was closed, and does not count.
    """

    days: int = 0
    percent: float = 0.0
    too_late: bool = False

    @property
    def share(self) -> float:
        """What is left of the points."""
        return 1 - self.percent / 100


IN_TIME = Lateness()


def lateness(sheet: Sheet, received: datetime, deadline: datetime | None) -> Lateness:
    """How late a submission is for a student whose deadline that is.

    With an extension, a sheet closes later by as much as the deadline moved.
    """
    if deadline is None or sheet.deadline is None:
        over = sheet.closes is not None and received > sheet.closes
        return Lateness(too_late=over)
    grace = timedelta(minutes=sheet.grace_minutes)
    late = received - deadline - grace
    if late <= timedelta():
        return IN_TIME
    days = ceil(late / DAY)
    percent = min(days * sheet.late_percent, sheet.late_most)
    closes = sheet.closes
    if closes is not None:
        closes += max(deadline - sheet.deadline, timedelta())
    return Lateness(days, percent, too_late=closes is not None and received > closes)


def late_text(late: Lateness) -> str:
    """What is said of a submission that came late; empty where it did not."""
    if late.too_late:
        return phrase("It came in after the sheet was closed, and does not count.")
    if not late.days:
        return ""
    days = days_text(late.days)
    if not late.percent:
        return phrase("It came in late, {days} begun; that costs nothing here.", days=days)
    return phrase(
        "It came in late, {days} begun; that takes {percent} % off the points.",
        days=days,
        percent=number_text(late.percent),
    )


def days_text(days: int) -> str:
    """Days in words: "1 day", "3 days"."""
    return phrase_count("{number} day", "{number} days", days)


def rules_text(sheet: Sheet) -> str:
    """When a sheet is to be handed in, and what being late costs; empty where nothing is set."""
    said: list[str] = []
    if sheet.deadline is not None:
        said.append(phrase("Hand in until {time}.", time=time_text(sheet.deadline)))
        said += _late_rule(sheet)
    if sheet.closes is not None:
        closed = time_text(sheet.closes)
        said.append(phrase("Nothing that comes in after {time} counts.", time=closed))
    said += _attempts(sheet)
    return " ".join(said)


def _late_rule(sheet: Sheet) -> list[str]:
    if not sheet.late_percent:
        return []
    grace = ""
    if sheet.grace_minutes:
        minutes = sheet.grace_minutes
        grace = phrase(", once {minutes} minutes have passed,", minutes=minutes)
    most = ""
    if sheet.late_most < 100:
        most = phrase(", at most {percent} %", percent=number_text(sheet.late_most))
    each = phrase(
        "Each day begun after that{grace} takes {percent} % off the points{most}.",
        grace=grace,
        percent=number_text(sheet.late_percent),
        most=most,
    )
    return [each]


def _attempts(sheet: Sheet) -> list[str]:
    if sheet.most_attempts == 1:
        return [phrase("You may hand in once; later files are not marked.")]
    number = phrase("as often as you like")
    if sheet.most_attempts is not None:
        number = phrase("up to {number} times", number=sheet.most_attempts)
    if sheet.attempts == "best":
        return [phrase("You may hand in {often}; the best counts.", often=number)]
    if sheet.most_attempts is not None:
        return [phrase("You may hand in {often}; the last one counts.", often=number)]
    return []


def read_time(text: str, zone: tzinfo = UTC) -> datetime:
    """A time as people and programs write it; `zone` is that of one that names none.

    Raises:
        CourseError: it cannot be read.
    """
    try:
        time = datetime.fromisoformat(text.strip())
    except ValueError as error:
        raise CourseError(f"{TAKES}, got {text[:40]!r}") from error
    if time.tzinfo is None:
        return time.replace(tzinfo=zone)
    return time
