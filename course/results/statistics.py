"""What numbers tell of a class: means, medians, and how hard and how telling each part was."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import StatisticsError, correlation, mean, median

from ...exercises.exercise import Part
from .grades import SheetResults

FEWEST = 5  # marks, below which a correlation says nothing
BINS = 10  # of a histogram, of ten per cent each


@dataclass(frozen=True)
class Spread:
    """Shares of the points that a class reached, in [0, 1].

    Attributes:
        count: How many have points.
        mean: Of the shares; None where there are none.
        median: The same.
        bins: How many are in each tenth; the last holds those who have all.
    """

    count: int
    mean: float | None
    median: float | None
    bins: tuple[int, ...]


@dataclass(frozen=True)
class PartNumbers:
    """One part of a sheet.

    Attributes:
        part: The part.
        count: How many have points for it.
        mean: Mean points; None where nobody has any.
        facility: The mean as a share of the points.
        discrimination: The correlation with the points of the rest of the sheet: near 1 where
            those who are good at the rest are good at it, below 0 where it is the other way round.
            None where it cannot be told.
    """

    part: Part
    count: int
    mean: float | None
    facility: float | None
    discrimination: float | None


def spread(shares: Sequence[float]) -> Spread:
    """Mean, median and histogram of shares in [0, 1]."""
    bins = [0] * BINS
    for share in shares:
        bins[min(int(share * BINS + 1e-9), BINS - 1)] += 1
    if not shares:
        return Spread(0, None, None, tuple(bins))
    return Spread(len(shares), mean(shares), median(shares), tuple(bins))


def sheet_shares(sheet: SheetResults) -> list[float]:
    """The share of the points of everybody who has them for a sheet."""
    points = [result.points for result in sheet.results if result.points is not None]
    return [earned / sheet.out_of for earned in points]


def part_numbers(sheet: SheetResults) -> list[PartNumbers]:
    """Every part of a sheet, in its order."""
    earned: dict[str, list[float | None]] = {name: [] for name in sheet.parts}
    for result in sheet.results:
        own = result.earned
        for name, column in earned.items():
            column.append(own.get(name))

    found: list[PartNumbers] = []
    for exercise in sheet.exercises:
        for part in exercise.asked:
            others = [earned[name] for name in earned if name != part.variable]
            found.append(_part(part, earned[part.variable], others))
    return found


def _part(
    part: Part, own: Sequence[float | None], others: Sequence[Sequence[float | None]]
) -> PartNumbers:
    points: list[float] = []
    rest: list[float] = []
    for i, mark in enumerate(own):
        if mark is not None:
            points.append(mark)
            rest.append(sum(other[i] or 0.0 for other in others))
    if not points:
        return PartNumbers(part, 0, None, None, None)
    average = mean(points)
    return PartNumbers(
        part, len(points), average, average / part.points, _correlation(points, rest)
    )


def _correlation(one: Sequence[float], other: Sequence[float]) -> float | None:
    """None for so few, or where all have the same."""
    if len(one) < FEWEST:
        return None
    try:
        return correlation(one, other)
    except StatisticsError:
        return None
