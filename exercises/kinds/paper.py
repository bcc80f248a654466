"""Where an answer is written by hand: boxes with labels, lines, or letters to mark."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Paper:
    """The place of one answer on an answer sheet.

    Attributes:
        rows: A label for each row of boxes, in LaTeX; empty ones are not printed.
        columns: A label for each column.
        grids: How many such grids there are, one for each matrix of a stack.
        wide: Whether formulas go into the boxes, which takes more room than numbers.
        lines: How many ruled lines there are, below or instead of boxes.
        letters: Letters of which one is marked.
    """

    rows: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()
    grids: int = 1
    wide: bool = False
    lines: int = 0
    letters: str = ""


def paper_of_shape(shape: tuple[int, ...], *, wide: bool) -> Paper:
    """Boxes for an array: a row of them for a vector, a grid for each matrix of a stack."""
    if not shape:
        return Paper(("",), ("",), wide=wide)
    if len(shape) == 1 and wide:  # formulas, one below the other
        return Paper(counted(shape[0]), ("",), wide=wide)
    if len(shape) == 1:
        return Paper(("",), counted(shape[0]), wide=wide)
    *stack, rows, columns = shape
    grids = 1
    for count in stack:
        grids *= count
    return Paper(counted(rows), counted(columns), grids, wide)


def counted(count: int) -> tuple[str, ...]:
    """Labels 1, 2, 3 ..."""
    return tuple(str(i) for i in range(1, count + 1))
