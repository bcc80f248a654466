"""What marking one exercise of one student refers to, and what was found so far."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ...exercises.exercise import Part
from .answer_key import AnswerKey
from .follow import Others, Peers
from .following import OwnAnswers
from .price import Bill
from .verdict import Verdict


@dataclass(frozen=True)
class Marked:
    """One exercise while it is marked.

    Attributes:
        key: What answers are compared with.
        bill: What was charged for already, on the whole sheet.
        others: The reference answers of other students.
        peers: What other students handed in.
        own: The answers that could be read.
        verdicts: Of all parts so far.
        named: Wrong parts whose mistake has a name and a price.
        suspected: The known mistakes of any arm that may explain each part.
    """

    key: AnswerKey
    bill: Bill = field(default_factory=Bill)
    others: Others = field(default_factory=dict[str, Mapping[str, Any]])
    peers: Peers = field(default_factory=dict[str, Mapping[str, Any]])
    own: OwnAnswers = field(default_factory=OwnAnswers)
    verdicts: dict[str, Verdict] = field(default_factory=dict[str, Verdict])
    named: set[str] = field(default_factory=set[str])
    suspected: dict[str, frozenset[str]] = field(default_factory=dict[str, frozenset[str]])

    def wrong_before(self, part: Part) -> str:
        """The own answers that the part needs and that are not right."""
        own = self.own.needed(part)
        return " and ".join(name for name in own if self.verdicts[name].status != "correct")
