"""What a named mistake costs: once, where it happens, whatever the number of entries."""

from dataclasses import dataclass, field

from ...exercises.exercise import Fault, Part
from ..kinds.marker import Named
from ..kinds.markers import marker_of


@dataclass(frozen=True)
class Price:
    """Shares of a part's points that a named mistake costs."""

    slip: float = 0.25
    presentation: float = 0.25
    concept: float = 0.5

    def of(self, fault: Fault) -> float:
        """The share that a mistake of this kind costs."""
        costs: dict[Fault, float] = {
            "slip": self.slip,
            "presentation": self.presentation,
            "concept": self.concept,
        }
        return costs[fault]


PRICE = Price()


@dataclass(frozen=True)
class Bill:
    """What one student has been charged for: each mistake once a sheet."""

    price: Price = PRICE
    charged: dict[str, str] = field(default_factory=dict[str, str])

    def share(self, part: Part, named: Named, value: object) -> tuple[float, str]:
        """The share of the points that a named mistake leaves, and where it was charged before.

        It leaves nothing where the mistake has no price, or where the answer could be guessed.
        """
        if named.fault is None or not marker_of(part.answer).priced(part.answer, value):
            return 0.0, ""
        before = "" if named.local else self.charged.get(_key(named), "")
        if before and before != part.variable:
            return 1.0, before
        return 1.0 - self.price.of(named.fault), ""

    def charge(self, part: Part, named: Named) -> None:
        """Writes down that a part's points were taken for a mistake; the first part stays."""
        self.charged.setdefault(_key(named), part.variable)


def _key(named: Named) -> str:
    return named.key or named.sentence
