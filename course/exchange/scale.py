"""Points on the scale of another system, which may take another number of points for a sheet."""

from dataclasses import dataclass

from ...solutions.plain_number import plain_number
from ..errors import CourseError


@dataclass(frozen=True)
class Scale:
    """How points are written; `factor` is 1 unless it was asked to convert them."""

    factor: float = 1.0
    comma: bool = False

    def text(self, points: float | None) -> str:
        """Points as a cell; empty, never a zero, where there are none."""
        if points is None:
            return ""
        written = f"{round(points * self.factor, 2):g}"
        return written.replace(".", ",") if self.comma else written


def scale(out_of: float, cell: str, place: str, *, convert: bool) -> Scale:
    """The scale of a column in which `cell` says how many points there are at most.

    Raises:
        CourseError: they are others than those of the sheet, and nobody asked to convert.
    """
    comma = "," in cell
    most = plain_number(cell.strip().replace(",", "."))
    if most is None or most == out_of:
        return Scale(comma=comma)
    if not convert:
        raise CourseError(
            f"{place}: there are {most:g} points to be had there, and {out_of:g} on the sheet; "
            "change one of them, or convert with --scale"
        )
    return Scale(most / out_of, comma)
