"""Small words that sheets, pages and lists share."""


def points_text(points: float) -> str:
    """Points in words: "1 point", "2.5 points"."""
    if points == 1:
        return "1 point"
    return f"{points:g} points"


SHARES = {0.0: "nothing", 0.25: "a quarter", 0.5: "half", 0.75: "three quarters", 1.0: "all"}


def share_text(share: float) -> str:
    """A share of the points in words: "a quarter", "30 %"."""
    return SHARES.get(share, f"{100 * share:g} %")
