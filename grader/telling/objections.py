"""Why a draw is refused: it hides a mistake or a number that draws of its structure show."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Literal

from .factors import too_many_near_zero
from .look import Look
from .siblings import pool, siblings


@dataclass(frozen=True)
class Objection:
    """What a draw cannot tell.

    Attributes:
        kind: A mistake that gives the right answer; a printed number that hardly matters; a second
            factor of the determinant that is nearly zero.
        part: The variable of the part where it is seen; empty for a factor.
        what: The sentence of the mistake, or the number.
    """

    kind: Literal["rule", "number", "factor"]
    part: str
    what: str

    def __str__(self) -> str:
        """As a person reads it."""
        told = {
            "rule": f"{self.part}: this mistake gives the right answer: {self.what}",
            "number": f"{self.part}: {self.what} hardly matters",
            "factor": self.what,
        }
        return told[self.kind]


FACTOR = Objection("factor", "", "more factors of the determinant are nearly zero than usual")


def objections(look: Look) -> Iterator[Objection]:
    """What speaks against handing out a draw, one by one, so that the first may do.

    What no other draw of the same structure shows speaks against none: a mistake that cannot show,
    a point on the axis that it is measured from.
    """
    if too_many_near_zero(look):
        yield FACTOR
    draws = pool(look.exercise)
    for sight in chain(look.rules(), look.numbers(draws.used)):
        if sight.shows:
            continue
        if any(draws.shows(other, sight) for other in siblings(look)):
            yield Objection(sight.kind, sight.part, sight.what)
