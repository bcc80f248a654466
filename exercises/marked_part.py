"""One part of an exercise, as it is marked: what is asked, what is right, known mistakes."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from numpy.typing import ArrayLike

from .answers import Answer, Variant

Given = Mapping[str, Any]
"""Earlier answers by variable, each of its declared type: the reference's, or the student's."""
Credit = Literal["entry", "column", "block", "all"]
Fault = Literal["slip", "presentation", "concept"]
"""What kind of mistake it is, which decides what it costs."""


@dataclass(frozen=True)
class Outcome:
    """What a part's own `check` found: what is right, how the answer was read, and a finding.

    `right` is None where the usual comparison with the reference shall decide. `share` of the
    points is earned where the right entries alone do not say it; unless it is `final`, a mistake
    that has a name leaves what it leaves elsewhere. Of a function, `right` has a flag for every
    group of calls (`Results`), or a list of flags, one for each of its calls.
    """

    right: ArrayLike | Sequence[bool | Sequence[bool]] | None = None
    reading: str = ""
    finding: str = ""
    share: float | None = None
    final: bool = True


@dataclass(frozen=True)
class Step:
    """One step of a worked solution.

    It is text with the general formula, a closed form, then the student's numbers. `text` is
    Markdown with LaTeX between dollar signs; `symbol` is the LaTeX left-hand side of `formula`
    (sympy, or formulas) and of `numbers` (an array, printed to `decimals`, by default those of its
    part).
    """

    text: str
    symbol: str = ""
    formula: Any = None
    numbers: ArrayLike | None = None
    decimals: int | None = None


@dataclass(frozen=True)
class Mistake:
    """A known mistake: the sentence that names the step to look at again, and its wrong answer.

    `fault` says what it costs: a slip of the pen, a right answer presented otherwise, or a concept;
    with None such an answer earns nothing by itself.
    """

    sentence: str
    solve: Callable[[Variant, Given], Any]
    fault: Fault | None = "concept"


@dataclass(frozen=True, eq=False)
class Part:
    """One question.

    `solve(v, given)` returns the reference answer from the variant and the parts in `needs`. An
    unasked part (`asked=False`) is an intermediate that is rounded for the tolerance but never
    printed. `follow` is the share of the points for an answer that is right from the student's own,
    wrong, earlier answers. `credit` says whether marks go to entries, to whole columns, to blocks
    of three rows (linear ones, angular ones), or to the whole answer only. `tolerance` overrides
    the derived one, and `tolerance_factor` is a course's own on whichever holds.
    """

    variable: str
    prompt: str
    points: float
    answer: Answer
    solve: Callable[[Variant, Given], Any]
    needs: tuple[str, ...] = ()
    check: Callable[[Variant, Given, Any], Outcome] | None = None
    asked: bool = True
    follow: float = 1.0
    credit: Credit = "entry"
    tolerance: float | None = None
    tolerance_factor: float = 1.0
    hints: tuple[str, ...] = ()
    mistakes: tuple[Mistake, ...] = ()
    explain: Callable[[Variant, Given], Sequence[Step]] | None = None

    @property
    def beside(self) -> dict[str, str]:
        """Variables in which a student declares something beside the answer, by what it is."""
        return {name: f"{self.variable}_{name}" for name in self.answer.declared_beside}
