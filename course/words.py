"""Small words that sheets, pages and lists share."""


def points_text(points: float) -> str:
    """Points in words: "1 point", "2.5 points"."""
    return f"{points:g} point" if points == 1 else f"{points:g} points"
