"""What marking a part says: data that feedback, gradebook and report only read."""

from dataclasses import dataclass
from typing import Any, Literal

Status = Literal["correct", "follows", "partly", "incorrect", "missing", "failed", "not_graded"]
"""`follows` is right from own wrong answers; `failed` is the submission's own fault, with a reason;
`not_graded` is ours or unfinished, and never a zero."""
STATUS_WORDS: dict[Status, str] = {
    "correct": "correct",
    "follows": "right from your own answers",
    "partly": "partly correct",
    "incorrect": "incorrect",
    "missing": "not answered",
    "failed": "could not be read",
    "not_graded": "not graded yet",
}
FOLLOWS = "It follows"
ENTRIES_FOLLOW = "The entries marked right follow"
COMPARED = "It was compared with what follows"
NOTHING_FOLLOWS = "Nothing follows"
CHARGED = "It was charged in"
GUESSABLE = "By itself it may be guessed"
ASIDES = (FOLLOWS, ENTRIES_FOLLOW, COMPARED, NOTHING_FOLLOWS, CHARGED, GUESSABLE)
"""How findings start that say what an answer was compared with, not what is wrong with it."""


@dataclass(frozen=True)
class Finding:
    """One sentence about an answer.

    `private` ones are for the instructor only; what is `by_person` was written by a marker.
    """

    text: str
    private: bool = False
    by_person: bool = False


@dataclass(frozen=True)
class Verdict:
    """The judgement of one part: points, which entries are right, and what was found.

    `points` is None exactly when nothing was judged. `right` and `answer` are nested lists of the
    answer's shape.
    """

    part: str
    status: Status
    points: float | None
    out_of: float
    findings: tuple[Finding, ...] = ()
    reading: str = ""
    right: Any = None
    answer: Any = None

    def to_json(self) -> dict[str, Any]:
        """Plain data for the gradebook."""
        return vars(self) | {"findings": [dict(vars(finding)) for finding in self.findings]}

    @staticmethod
    def from_json(data: dict[str, Any]) -> "Verdict":
        """The verdict that `to_json` wrote."""
        findings = tuple(Finding(**finding) for finding in data["findings"])
        fields: dict[str, Any] = {**data, "findings": findings}
        return Verdict(**fields)


def not_graded(part: str, out_of: float, reason: str) -> Verdict:
    """A part that waits for the instructor; it counts neither for nor against the student."""
    return Verdict(part, "not_graded", None, out_of, (Finding(reason),))
