"""The contract: everything an exercise file may use. Read this first, then any one exercise.

An exercise draws plain numbers for one student (a `Variant`) and lists the parts asked about them.
Each part names the variable it is handed in as, the kind of its answer, and how the answer follows
from the variant and from the earlier parts it needs. Sheets, worked solutions, tolerances, marks
and feedback are derived from that.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from ..solutions.errors import KinegradeError
from .answers import (
    Answer,
    Choice,
    Conditions,
    Configurations,
    Formulas,
    Function,
    Manual,
    Numbers,
    Results,
    TableOf,
    Variant,
)
from .drawing import Drawing
from .errors import ExerciseError
from .marked_part import Credit, Fault, Given, Mistake, Outcome, Part, Step
from .well_formed import check_part, check_units

__all__ = [
    "Answer",
    "Choice",
    "Conditions",
    "Configurations",
    "Credit",
    "Exercise",
    "ExerciseError",
    "Fault",
    "Formulas",
    "Function",
    "Given",
    "Manual",
    "Mistake",
    "Numbers",
    "Outcome",
    "Part",
    "Results",
    "Rows",
    "Step",
    "TableOf",
    "Variant",
    "references",
    "solve",
]

Rows = Literal["linear, angular", "angular, linear"]
"""Which rows of a Jacobian, and which half of a twist, stand above the others."""


@dataclass(frozen=True, eq=False)
class Exercise:
    """One exercise file.

    `draw(rng)` returns plain numbers; they pass through JSON before anything is computed. `units`
    give the unit of every drawn number that is printed (nested like the number itself); what is not
    listed there is not printed. `hidden` names drawn numbers that stay with the instructor, such as
    the inputs of a function; `structure` names drawn choices of form, which tell no answer, stand
    on the sheet in a line of their own, and can be pinned for a whole class, as hidden ones can.
    `symbols` are the LaTeX of printed names that are more than letters and an index. `scale(v)` is
    a typical length [m] that linear tolerances are measured against. `named` are the names of which
    every one is drawn for some student. `robot` names a robot of the catalogue whose map stands in
    the report; `arm(v)` is the robot as one student has it, from which known mistakes of any arm
    are computed. `rows` is the order of rows in every Jacobian and twist of the exercise: what the
    sheet says of it and what findings say follow it; `solve` and the units of an answer stand in
    that order themselves. `factors(v)` are values of the factors of the robot's determinant at the
    drawn q. `harder` gives, by names in `structure`, the choices that take more work than the
    others, for the instructor to know. `solved_drawings` are the figures that only
    the worked solution shows.
    """

    slug: str
    title: str
    source: str
    draw: Callable[[np.random.Generator], dict[str, Any]]
    parts: tuple[Part, ...]
    statement: Callable[[Variant], str]
    units: Mapping[str, Any]
    scale: Callable[[Variant], float]
    objectives: tuple[str, ...] = ()
    minutes: int = 30
    symbols: Mapping[str, str] = field(default_factory=dict[str, str])
    hidden: tuple[str, ...] = ()
    structure: tuple[str, ...] = ()
    robot: str | None = None
    drawings: Callable[[Variant], tuple[Drawing, ...]] = field(default=lambda _: ())
    arm: Callable[[Variant], Any] | None = None
    rows: Rows = "linear, angular"
    named: tuple[str, ...] = ()
    factors: Callable[[Variant], ArrayLike] | None = None
    harder: Mapping[str, Sequence[Any]] = field(default_factory=dict[str, Sequence[Any]])
    solved_drawings: Callable[[Variant], tuple[Drawing, ...]] = field(default=lambda _: ())

    def __post_init__(self) -> None:
        """Refuse what could not be collected, marked or printed.

        Raises:
            ExerciseError: a variable that is not unique, a need that is not an earlier part, points
                that are not positive, a prompt that is missing, a unit that is unknown, another
                order of rows, or choices called harder under a name that is not in structure.
        """
        if self.rows not in get_args(Rows):
            orders = " or ".join(map(repr, get_args(Rows)))
            raise ExerciseError(f"exercise {self.slug}: rows takes {orders}, got {self.rows!r}")

        for name in self.harder:
            if name not in self.structure:
                raise ExerciseError(
                    f"exercise {self.slug}: harder takes names that stand in structure, got {name}"
                )

        for name, unit in self.units.items():
            check_units(f"exercise {self.slug}: units of {name}", unit)

        known: dict[str, Part] = {}
        for part in self.parts:
            check_part(self.slug, part, known)
            known[part.variable] = part

    @property
    def asked(self) -> tuple[Part, ...]:
        """The parts that a student answers, in order."""
        return tuple(part for part in self.parts if part.asked)

    @property
    def points(self) -> float:
        """Points of all asked parts."""
        return sum(part.points for part in self.asked)


def references(exercise: Exercise, v: Variant) -> dict[str, Any]:
    """Reference answers of all parts, by variable.

    Raises:
        ExerciseError: `solve` returned something else than declared, such as numbers of another
            shape.
    """
    given: dict[str, Any] = {}
    for part in exercise.parts:
        needed = {name: given[name] for name in part.needs}
        given[part.variable] = solve(exercise.slug, part, v, needed)
    return given


def solve(slug: str, part: Part, v: Variant, given: Given) -> Any:
    """The reference answer of one part, checked against its declaration."""
    try:
        return part.answer.declared(part.solve(v, given), v)
    except KinegradeError as error:
        raise ExerciseError(f"exercise {slug}: solve of {part.variable}: {error}") from error
