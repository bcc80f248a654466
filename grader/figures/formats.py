"""The formats of figures, and what is said where there is none."""

from ...solutions.errors import KinegradeError

SUFFIXES = (".png", ".svg", ".pdf")


class FigureError(KinegradeError):
    """A figure that cannot be drawn."""


def suffix_of(name: str) -> str:
    """The suffix of a format that figures have, in small letters.

    Raises:
        FigureError: it is another one.
    """
    suffix = name.lower()
    if suffix not in SUFFIXES:
        raise FigureError(f"A figure takes a name in .png, .svg or .pdf, got one in {name!r}.")
    return suffix
