"""The contract: everything an exercise file may use. Read this first, then any one exercise beside it.

An exercise draws plain numbers for one student (a `Variant`) and lists the parts asked about them. Each part names
the variable it is handed in as, the kind of its answer, and how the answer follows from the variant and from the
earlier parts it needs. Sheets, worked solutions, tolerances, marks and feedback are derived from that.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from keyword import iskeyword
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..solutions.errors import KinegradeError
from .drawing import Drawing

Variant = Mapping[str, Any]
"""The drawn numbers of one student, as they come back from JSON."""
Given = Mapping[str, Any]
"""Earlier answers by variable, each of its declared type, whoever gave it: the reference or the student."""
Credit = Literal["entry", "column", "all"]


class ExerciseError(KinegradeError):
    """An exercise file breaks the contract."""


@dataclass(frozen=True)
class Numbers:
    """A real array. `units` are nested strings that broadcast to `shape`; `decimals` are asked of the student."""

    shape: tuple[int, ...]
    units: str | Sequence[Any] = "1"
    decimals: int = 4

    def unit_of_entries(self) -> NDArray[np.str_]:
        """Units of shape `shape`: "m", "m/rad", "rad/s", "1" ..."""
        return np.broadcast_to(np.array(self.units), self.shape)


@dataclass(frozen=True)
class TableOf:
    """A Denavit-Hartenberg table with one row of theta, d, a, alpha per joint of `kinds`, such as "RRP".

    Cells are expressions in `names` and q1 ... qn, or numbers; names that a variant lacks are unknown on its sheet.
    """

    names: tuple[str, ...]
    kinds: str
    convention: Literal["standard", "modified"] = "standard"
    decimals: int = 3


Answer = Numbers | TableOf


@dataclass(frozen=True)
class Outcome:
    """What a part's own `check` found: which entries are right, how the answer was read, and a finding.

    `right` is None where the usual comparison with the reference shall decide.
    """

    right: ArrayLike | None = None
    reading: str = ""
    finding: str = ""


@dataclass(frozen=True)
class Step:
    """One step of a worked solution: text with the general formula, a closed form, then the student's numbers.

    `text` is Markdown with LaTeX between dollar signs; `symbol` is the LaTeX left-hand side of `formula` (sympy) and of
    `numbers` (an array, printed to the decimals of its part).
    """

    text: str
    symbol: str = ""
    formula: Any = None
    numbers: ArrayLike | None = None


@dataclass(frozen=True)
class Mistake:
    """A known mistake: the sentence that names the step to look at again, and the answer it leads to."""

    sentence: str
    solve: Callable[[Variant, Given], Any]


@dataclass(frozen=True, eq=False)
class Part:
    """One question. `solve(v, given)` returns the reference answer from the variant and the parts in `needs`.

    An unasked part (`asked=False`) is an intermediate that is rounded for the tolerance but never printed. `follow` is
    the share of the points for an answer that is right from the student's own, wrong, earlier answers. `credit` says
    whether marks go to entries, to whole columns, or to the whole answer only. `tolerance` overrides the derived one.
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
    hints: tuple[str, ...] = ()
    mistakes: tuple[Mistake, ...] = ()
    explain: Callable[[Variant, Given], Sequence[Step]] | None = None


@dataclass(frozen=True, eq=False)
class Exercise:
    """One exercise file. `draw(rng)` returns plain numbers; they pass through JSON before anything is computed.

    `units` give the unit of every drawn number that is printed (nested like the number itself); what is not listed
    there is not printed. `scale(v)` is a typical length [m] that linear tolerances are measured against.
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
    robot: str | None = None
    drawings: Callable[[Variant], tuple[Drawing, ...]] = field(default=lambda _: ())

    def __post_init__(self) -> None:
        """Refuse what could not be collected, marked or printed.

        Raises:
            ExerciseError: a variable that is not unique, a need that is not an earlier part, points that are not
                positive, or a prompt that is missing.
        """
        known: set[str] = set()
        for part in self.parts:
            _check_part(self.slug, part, known)
            known.add(part.variable)

    @property
    def asked(self) -> tuple[Part, ...]:
        """The parts that a student answers, in order."""
        return tuple(part for part in self.parts if part.asked)

    @property
    def points(self) -> float:
        """Points of all asked parts."""
        return sum(part.points for part in self.asked)


def _check_part(slug: str, part: Part, known: set[str]) -> None:
    name = part.variable
    if not name.isidentifier() or iskeyword(name) or not name.startswith(f"{slug}_"):
        raise ExerciseError(f"exercise {slug}: a variable takes a Python name that starts with {slug}_, got {name!r}")
    if name in known:
        raise ExerciseError(f"exercise {slug}: two parts are called {name}; a sheet collects answers by name")
    missing = [need for need in part.needs if need not in known]
    if missing:
        raise ExerciseError(f"exercise {slug}: {name} needs {missing[0]}, which is not an earlier part")
    if part.asked and not (part.points > 0 and part.prompt):
        raise ExerciseError(f"exercise {slug}: {name} takes a prompt and positive points")


def references(exercise: Exercise, v: Variant) -> dict[str, Any]:
    """Reference answers of all parts, by variable.

    Raises:
        ExerciseError: `solve` returned numbers of another shape than declared, or not finite ones.
    """
    given: dict[str, Any] = {}
    for part in exercise.parts:
        given[part.variable] = solve(exercise.slug, part, v, {name: given[name] for name in part.needs})
    return given


def solve(slug: str, part: Part, v: Variant, given: Given) -> Any:
    """The reference answer of one part, checked against its declaration."""
    value = part.solve(v, given)
    if not isinstance(part.answer, Numbers):
        return value
    array = np.asarray(value, dtype=float)
    if array.shape != part.answer.shape or not np.isfinite(array).all():
        raise ExerciseError(
            f"exercise {slug}: solve of {part.variable} takes finite numbers of shape {part.answer.shape}, "
            f"got shape {array.shape}{'' if array.shape != part.answer.shape else ' with NaN or infinity'}"
        )
    return array
