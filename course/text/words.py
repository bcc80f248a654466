"""Small words that sheets, pages and lists share."""

from ..language.speech import later, phrase, phrase_count
from ..language.writing import number_text


def points_text(points: float) -> str:
    """Points in words: "1 point", "2.5 points"."""
    # one and a half are not one, in any language
    plural = 1 if points == 1 else 2
    return phrase_count("{points} point", "{points} points", plural, points=number_text(points))


SHARES = {
    0.0: later("nothing"),
    0.25: later("a quarter"),
    0.5: later("half"),
    0.75: later("three quarters"),
    1.0: later("all"),
}


def share_text(share: float) -> str:
    """A share of the points in words: "a quarter", "30 %"."""
    if share in SHARES:
        return phrase(SHARES[share])
    return f"{number_text(100 * share)} %"
