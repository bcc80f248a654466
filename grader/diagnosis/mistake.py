"""A known mistake: which switch is set otherwise, what kind it is, and what the student is told."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from ...exercises.exercise import Fault
from .switches import Edit

Kind = Literal["slip", "presentation", "convention", "concept"]
Stage = Literal["numbers", "frames", "columns", "output"]
STAGES: tuple[Stage, ...] = ("numbers", "frames", "columns", "output")
NUMBERS = ("constants", "gains", "q")  # of which one place may be wrong beside another


@dataclass(frozen=True, eq=False)
class Mistake:
    """One known mistake of one arm.

    Attributes:
        title: What it is, for reports; no other mistake of the arm has it.
        family: The title of all that differ in the row or column only.
        sentence: What the student is told; it names the step and no value.
        clause: The same in "either ..., or ...".
        edits: The switches that are set otherwise.
        kind: What kind of mistake it is, for reports.
        stage: Where in the computation it happens.
        prior: How unlikely it is beside others that explain an answer as well: 0 is common.
        topic: The entry of the conventions page that says it, if there is one.
    """

    title: str
    family: str
    sentence: str
    clause: str
    edits: tuple[Edit, ...]
    kind: Kind
    stage: Stage
    prior: float = 0.0
    topic: str = ""

    @property
    def fault(self) -> Fault:
        """What it is priced as: conventions are learned as concepts are."""
        return "concept" if self.kind == "convention" else self.kind

    @cached_property
    def slots(self) -> frozenset[str]:
        """What it touches; two mistakes that touch the same are no pair."""
        found: set[str] = set()
        for edit in self.edits:
            places = tuple(edit.at) if edit.switch in NUMBERS else ()
            found.update(f"{edit.switch} {place}" for place in places)
            if not places:
                found.add(edit.switch)
        return frozenset(found)


@dataclass(frozen=True)
class Known:
    """A known mistake of any arm, before it is put into the words of one row or column.

    `{...}` in its texts are filled in; its family is what stands before a colon in its title.
    """

    title: str
    sentence: str
    clause: str
    kind: Kind
    stage: Stage
    prior: float = 0.0
    topic: str = ""

    def of(self, *edits: Edit, less_likely: float = 0.0, **names: object) -> Mistake:
        """The mistake in this place."""
        family = self.title.partition(":")[0]
        place = ", ".join(str(name) for name in names.values())
        title = f"{self.title}: {place}" if place else self.title
        return Mistake(
            title,
            family,
            self.sentence.format(**names),
            self.clause.format(**names),
            edits,
            self.kind,
            self.stage,
            self.prior + less_likely,
            self.topic,
        )
