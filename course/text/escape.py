"""Text from others, made harmless for where it goes: a page, a terminal, a spreadsheet, Markdown.

What no page, table or terminal is given: control characters such as NUL and ESC, marks that turn
the direction of writing about, halves of characters.
"""

MARKUP = "*_`<>[]\\$&#|~"
FORMULA_STARTS = tuple("=+-@\t\r\n＝＋－＠")
SEEN = "\u00a0\u200c\u200d"  # within names: a space that does not break, and joiners of letters


def printable(text: str) -> str:
    """One line without control characters, which a terminal would obey, or halves of characters."""
    if text.isprintable():
        return text
    return "".join(_printable(char) for char in text)


def _printable(char: str) -> str:
    if char.isprintable() or char in SEEN:
        return char
    return "\N{REPLACEMENT CHARACTER}"


def printable_lines(text: str) -> str:
    """Lines, and tabs within them, without any other control characters."""
    if text.isprintable():
        return text
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    return "\n".join(_with_tabs(line) for line in lines)


def _with_tabs(line: str) -> str:
    return "\t".join(printable(piece) for piece in line.split("\t"))


def for_spreadsheet(text: str) -> str:
    """Printable lines, with an apostrophe before what a spreadsheet would run as a formula.

    So that `from_spreadsheet` knows which apostrophe is ours, it stands before others, too.
    """
    shown = printable_lines(text)
    return f"'{shown}" if _starts_a_formula(shown) else shown


def from_spreadsheet(cell: str) -> str:
    """The text that `for_spreadsheet` was given, where that was printable."""
    text = printable_lines(cell)
    if text.startswith("'") and _starts_a_formula(text):
        return text[1:]
    return text


def _starts_a_formula(text: str) -> bool:
    return text.lstrip("'").startswith(FORMULA_STARTS)


def no_markup(text: str) -> str:
    """Text without what Markdown or HTML would read as markup, and single spaces in it."""
    kept = printable(text).translate(str.maketrans("", "", MARKUP))
    return " ".join(kept.split())
