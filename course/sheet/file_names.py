"""Which sheet a file is called after, as such or as a later version of it."""

import re
from collections.abc import Iterable

VERSION = re.compile(
    r"(?:[\s_.-]+|(?=\())"
    r"(?:final|new|neu|fixed|korrigiert|corrected|v[0-9]{1,3}"
    r"|\(?(?:copy|kopie|copie|copia)?[\s_-]*[0-9]{0,3}\)?)",
    re.IGNORECASE,
)
"""What systems and people put behind a name: (1), -2, " - Copy", -Copy1, _final, _v2."""


def called_after(stem: str, sheets: Iterable[str]) -> str:
    """The sheet that a file of this name belongs to; empty where it is called after none.

    A sheet of exactly that name goes before one whose later version it may be.
    """
    small = stem.casefold()
    ordered = sorted(sheets, key=len, reverse=True)
    for sheet in ordered:
        if small == sheet.casefold():
            return sheet
    for sheet in ordered:
        rest = small.removeprefix(sheet.casefold())
        if rest != small and _is_version(rest):
            return sheet
    return ""


def looks_like(stem: str, sheet: str) -> bool:
    """Whether a name begins as that of a sheet, whatever comes behind it."""
    return stem.casefold().startswith(sheet.casefold())


def _is_version(rest: str) -> bool:
    """Whether all of what stands behind the name of a sheet is of that kind."""
    while rest:
        found = VERSION.match(rest)
        if not found or not found.end():
            return False
        rest = rest[found.end() :]
    return True
