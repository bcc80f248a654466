"""Numbers and days as the language spoken writes them."""

from datetime import date, datetime

from .speech import ENGLISH, language_spoken


def number_text(number: float) -> str:
    """A number in a sentence: 2.5, in German 2,5.

    Numbers that are computed with keep their point, in every language: so does what students type.
    """
    return with_comma(f"{number:g}", language_spoken())


def with_comma(number: str, language: str) -> str:
    """A number that is written with a point, with the sign of the language in its place."""
    if language == ENGLISH:
        return number
    from babel import Locale

    return number.replace(".", Locale(language).number_symbols["latn"]["decimal"])


def day_text(day: date) -> str:
    """As "8 October 2026"."""
    language = language_spoken()
    if language == ENGLISH:
        return f"{day.day} {day:%B %Y}"
    from babel.dates import format_date

    return format_date(day, "long", locale=language)


def time_text(time: datetime) -> str:
    """As "Thursday, 8 October 2026, 23:59 (Europe/Berlin)"."""
    weekday = f"{time:%A}"
    language = language_spoken()
    if language != ENGLISH:
        from babel.dates import format_date

        weekday = format_date(time, "EEEE", locale=language)
    return f"{weekday}, {day_text(time)}, {time:%H:%M} ({time.tzinfo})"
