"""The contract: everything an exercise file may use. Read this first, then any one exercise.

An exercise draws plain numbers for one student (a `Variant`) and lists the parts asked about them.
Each part names the variable it is handed in as, the kind of its answer, and how the answer follows
from the variant and from the earlier parts it needs. Sheets, worked solutions, tolerances, marks
and feedback are derived from that.
"""

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from keyword import iskeyword
from typing import Any, Literal, cast, get_args

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
from .units import UnitError, refuse_unknown_unit

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

Given = Mapping[str, Any]
"""Earlier answers by variable, each of its declared type: the reference's, or the student's."""
Credit = Literal["entry", "column", "block", "all"]
Fault = Literal["slip", "presentation", "concept"]
"""What kind of mistake it is, which decides what it costs."""
Rows = Literal["linear, angular", "angular, linear"]
"""Which rows of a Jacobian, and which half of a twist, stand above the others."""


class ExerciseError(KinegradeError):
    """An exercise file breaks the contract."""


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
            _check_units(f"exercise {self.slug}: units of {name}", unit)

        known: dict[str, Part] = {}
        for part in self.parts:
            _check_part(self.slug, part, known)
            if isinstance(part.answer, Numbers | Configurations):
                _check_answer_units(f"exercise {self.slug}: units of {part.variable}", part.answer)
            known[part.variable] = part

    @property
    def asked(self) -> tuple[Part, ...]:
        """The parts that a student answers, in order."""
        return tuple(part for part in self.parts if part.asked)

    @property
    def points(self) -> float:
        """Points of all asked parts."""
        return sum(part.points for part in self.asked)


def _check_part(slug: str, part: Part, known: Mapping[str, Part]) -> None:
    """Refuses a part that could not be collected, computed, printed or marked behind the known."""
    _check_variable(slug, part.variable, known)
    for need in part.needs:
        _check_need(slug, part.variable, need, known)
    if part.asked and not (part.points > 0 and part.prompt):
        raise ExerciseError(
            f"exercise {slug}: {part.variable} takes a prompt, in an exercise file the docstring "
            "of its function, and positive points"
        )
    _check_marking(slug, part)


def _check_variable(slug: str, name: str, known: Collection[str]) -> None:
    if not name.isidentifier() or iskeyword(name) or not name.startswith(f"{slug}_"):
        raise ExerciseError(
            f"exercise {slug}: a variable takes a Python name that starts with {slug}_, "
            f"got {name!r}"
        )
    if name in known:
        raise ExerciseError(
            f"exercise {slug}: two parts are called {name}; a sheet collects answers by name"
        )


def _check_need(slug: str, name: str, need: str, known: Mapping[str, Part]) -> None:
    if need not in known:
        raise ExerciseError(f"exercise {slug}: {name} needs {need}, which is not an earlier part")
    if isinstance(known[need].answer, Function | Manual):
        raise ExerciseError(
            f"exercise {slug}: {name} cannot need {need}: nothing can be computed from it"
        )


def _check_marking(slug: str, part: Part) -> None:
    name, answer = part.variable, part.answer
    if isinstance(answer, Configurations) and part.check is None:
        raise ExerciseError(
            f"exercise {slug}: {name} asks for configurations, which take a check that judges them"
        )
    if isinstance(answer, Manual):
        rubric = sum(points for points, _ in answer.rubric)
        if not math.isclose(rubric, part.points):
            raise ExerciseError(
                f"exercise {slug}: {name} has {part.points:g} points, its rubric {rubric:g}"
            )


def _check_units(where: str, units: Any) -> None:
    """Refuses a text among nested units that is none."""
    if isinstance(units, list | tuple | np.ndarray):
        for inner in cast("Sequence[Any]", units):
            _check_units(where, inner)
        return
    try:
        refuse_unknown_unit(units)
    except UnitError as error:
        raise ExerciseError(f"{where}: {error}") from error


def _check_answer_units(where: str, answer: Numbers | Configurations) -> None:
    _check_units(where, answer.units)
    if isinstance(answer, Numbers):
        try:
            answer.unit_of_entries()
        except ValueError as error:
            raise ExerciseError(
                f"{where} take the shape of its entries, {answer.shape}, or one unit"
            ) from error


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
