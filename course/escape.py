"""Text from others, made harmless for where it goes: a terminal, a spreadsheet, Markdown."""

MARKUP = "*_`<>[]\\$&#|~"


def printable(text: str) -> str:
    """One line without control characters, which a terminal would obey, or halves of characters."""
    return "".join(char if char.isprintable() else "\N{REPLACEMENT CHARACTER}" for char in text)


def no_formula(text: str) -> str:
    """Spreadsheets run cells that start like a formula."""
    return f"'{text}" if text[:1] in "=+-@\t\r＝＋－＠" else text


def no_markup(text: str) -> str:
    """Text without what Markdown or HTML would read as markup."""
    return " ".join("".join(char for char in printable(text) if char not in MARKUP).split())
