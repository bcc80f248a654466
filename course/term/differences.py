"""What changes between two states of a sheet: whose points, from what to what, in which parts."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from .result import Result


@dataclass(frozen=True)
class Move:
    """One student whose marks are other ones than before."""

    before: Result
    after: Result

    def line(self) -> str:
        """As "ada  jacobian  10 -> 11.5 of 20  (rrt_J 1 -> 2.5)"."""
        after = self.after
        whose = f"{after.student.id}  {after.sheet}"
        points = f"{_shown(self.before)} -> {_shown(after)} of {_worth(self):g}"
        parts = ", ".join(self._parts())
        return f"{whose}  {points}" + (f"  ({parts})" if parts else "")

    def _parts(self) -> Iterator[str]:
        before = self.before.earned
        after = self.after.earned
        for part in {**before, **after}:
            was, now = before.get(part), after.get(part)
            if was != now:
                yield f"{part} {_number(was)} -> {_number(now)}"


def moves(before: Iterable[Result], after: Iterable[Result]) -> list[Move]:
    """Those whose points, parts or status are others, in the order of the roster."""
    was = {result.student.id: result for result in before}
    found: list[Move] = []
    for result in after:
        earlier = was.get(result.student.id)
        if earlier is not None and not earlier.tells_the_same_as(result):
            found.append(Move(earlier, result))
    return found


def today(results: Iterable[Result]) -> list[Result]:
    """Results as they are now, whatever was published."""
    return [result.by_now or result for result in results]


def _worth(move: Move) -> float:
    return move.after.out_of or move.before.out_of


def _shown(result: Result) -> str:
    if result.points is None:
        return result.status.replace("_", " ")
    return f"{result.points:g}"


def _number(points: float | None) -> str:
    return "?" if points is None else f"{points:g}"
