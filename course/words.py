"""Small words that sheets, pages and lists share."""


def points_text(points: float) -> str:
    """Points in words: "1 point", "2.5 points"."""
    if points == 1:
        return "1 point"
    return f"{points:g} points"
