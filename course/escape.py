"""Text from others, made harmless for where it goes: a terminal, a spreadsheet, Markdown."""

MARKUP = "*_`<>[]\\$&#|~"
FORMULA_STARTS = tuple("=+-@\t\r＝＋－＠")


def printable(text: str) -> str:
    """One line without control characters, which a terminal would obey, or halves of characters."""
    return "".join(_printable(char) for char in text)


def _printable(char: str) -> str:
    if char.isprintable():
        return char
    return "\N{REPLACEMENT CHARACTER}"


def no_formula(text: str) -> str:
    """Text with an apostrophe before what a spreadsheet would run as a formula."""
    return f"'{text}" if text.startswith(FORMULA_STARTS) else text


def with_formula(text: str) -> str:
    """The text that `no_formula` was given."""
    kept = text.removeprefix("'")
    return kept if kept.startswith(FORMULA_STARTS) else text


def no_markup(text: str) -> str:
    """Text without what Markdown or HTML would read as markup, and single spaces in it."""
    kept = printable(text).translate(str.maketrans("", "", MARKUP))
    return " ".join(kept.split())
