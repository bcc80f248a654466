"""What one honest mistake costs: `python benchmarks/fairness.py [--draws N]`.

Students each make one mistake of the field in one part and carry on rightly from their own answer,
rounded to the asked decimals. The marks are held against a fair marker, who takes a quarter of the
part's points for a slip or a unit, half of them for a concept, and nothing from the parts after it.
"""

import argparse
import json
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from kinegrade.exercises.answers import Formulas, Numbers, TableOf, Variant
from kinegrade.exercises.exercise import Exercise, Part, references
from kinegrade.exercises.files.finding import exercise_files, find
from kinegrade.grader.kinds.markers import handed_in
from kinegrade.grader.marking.answer_key import AnswerKey
from kinegrade.grader.marking.guesses import counted
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.expression import parse
from kinegrade.solutions.expression_array import ExpressionArray
from kinegrade.solutions.table import read_table

FAIR = {"slip": 0.25, "presentation": 0.25, "concept": 0.5}
Wrong = Callable[[Part, Any, np.random.Generator], Any]


@dataclass(frozen=True)
class Slip:
    """A mistake of any part: `wrong(part, value, rng)` is None where it shows nothing."""

    name: str
    kind: str
    wrong: Wrong


@dataclass(frozen=True)
class Run:
    """One student: where the mistake was made, what it cost, and what a fair marker takes."""

    exercise: str
    part: str
    mistake: str
    lost: float
    fair: float
    out_of: float
    named: bool
    carried_on: bool
    lost_all_after: bool


def largest(value: np.ndarray) -> tuple[int, ...]:
    """The place of the largest entry that is no 0, 1 or -1."""
    sizes = np.where(np.isin(np.round(np.abs(value), 6), (0, 1)), 0, np.abs(value))
    return np.unravel_index(int(sizes.argmax()), value.shape)


def one_sign(part: Part, value: Any, _: np.random.Generator) -> Any:
    if not isinstance(part.answer, Numbers) or not value.size:
        return None
    changed = np.array(value, dtype=float)
    changed[largest(changed)] *= -1
    return changed


def miscopied(part: Part, value: Any, rng: np.random.Generator) -> Any:
    """Two neighbouring digits of one entry are exchanged."""
    if not isinstance(part.answer, Numbers):
        return None
    changed = np.array(np.round(value, part.answer.decimals), dtype=float)
    place = largest(changed)
    digits = list(f"{abs(changed[place]):.{part.answer.decimals}f}")
    for i in range(len(digits) - 2):
        a, b = digits[i], digits[i + 1]
        if "." not in (a, b) and a != b:
            digits[i], digits[i + 1] = b, a
            changed[place] = np.copysign(float("".join(digits)), changed[place])
            return changed
    return None


def short(part: Part, value: Any, _: np.random.Generator) -> Any:
    if not isinstance(part.answer, Numbers) or part.answer.decimals < 2:
        return None
    return np.round(value, part.answer.decimals - 1)


def in_units(unit: str, factor: float) -> Wrong:
    def wrong(part: Part, value: Any, _: np.random.Generator) -> Any:
        if not isinstance(part.answer, Numbers):
            return None
        mine = np.char.startswith(part.answer.unit_of_entries(), unit)
        return np.where(mine, factor * np.asarray(value), value)

    return wrong


def transposed(part: Part, value: Any, _: np.random.Generator) -> Any:
    if not isinstance(part.answer, Numbers) or value.ndim != 2 or value.shape[0] != value.shape[1]:
        return None
    return value.T


def blocks(part: Part, value: Any, _: np.random.Generator) -> Any:
    if not isinstance(part.answer, Numbers) or not part.answer.has_blocks:
        return None
    return np.concatenate([value[3:], value[:3]])


def exchanged(axis: int) -> Wrong:
    def wrong(part: Part, value: Any, rng: np.random.Generator) -> Any:
        if not isinstance(part.answer, Numbers) or value.ndim != 2 or value.shape[axis] < 2:
            return None
        order = np.arange(value.shape[axis])
        order[:2] = (1, 0)
        return np.take(value, order, axis=axis)

    return wrong


def formula_sign(part: Part, value: Any, _: np.random.Generator) -> Any:
    if not isinstance(part.answer, Formulas):
        return None
    entries = list(value.entries)
    place = max(range(len(entries)), key=lambda i: len(entries[i].nodes))
    entries[place] = parse(f"-({entries[place]})", sorted(value.names))
    return ExpressionArray(tuple(entries), value.shape)


def table_cell(column: int, change: str) -> Wrong:
    def wrong(part: Part, value: Any, _: np.random.Generator) -> Any:
        if not isinstance(part.answer, TableOf):
            return None
        rows = [[str(cell) for cell in row] for row in value.rows]
        for row in rows:
            if row[column] != "0":
                row[column] = change.format(row[column])
                break
        names = sorted({name for row in value.rows for cell in row for name in cell.names})
        return read_table(rows, names, value.convention)

    return wrong


SLIPS = (
    Slip("one sign", "slip", one_sign),
    Slip("two digits exchanged", "slip", miscopied),
    Slip("one decimal short", "slip", short),
    Slip("millimetres", "presentation", in_units("m", 1000.0)),
    Slip("degrees", "presentation", in_units("rad", 180 / np.pi)),
    Slip("transposed", "presentation", transposed),
    Slip("blocks exchanged", "presentation", blocks),
    Slip("two rows exchanged", "slip", exchanged(0)),
    Slip("two columns exchanged", "slip", exchanged(1)),
    Slip("one sign in a formula", "slip", formula_sign),
    Slip("sign of alpha", "slip", table_cell(3, "-({})")),
    Slip("quarter turn of theta", "concept", table_cell(0, "{} + pi/2")),
)


def mistakes_in(exercise: Exercise, part: Part, v: Variant, key: AnswerKey) -> Iterator[Slip]:
    """The slips of anybody, then what the exercise knows of this part."""
    yield from SLIPS
    for mistake in part.mistakes:
        wrong = part.answer.declared(mistake.solve(v, key.wanted(part).given), v)
        yield Slip(mistake.sentence, "concept", lambda *_, wrong=wrong: wrong)


def runs_of(exercise: Exercise, seed: int) -> Iterator[Run]:
    """A student for every mistake of every part of one draw."""
    v: Variant = json.loads(json.dumps(exercise.draw(np.random.default_rng(seed))))
    key = AnswerKey(exercise, v)
    rng = np.random.default_rng(seed)
    for part in exercise.asked:
        for slip in mistakes_in(exercise, part, v, key):
            wrong = slip.wrong(part, key.reference[part.variable], rng)
            if wrong is None or is_right(key, part, wrong):
                continue
            answers, affected = carried_on(exercise, v, part, wrong)
            yield marked(exercise, v, key, part, slip, answers, affected)


def is_right(key: AnswerKey, part: Part, wrong: Any) -> bool:
    """Whether the mistake does not show in this draw."""
    raws = {part.variable: handed_in(part.answer, wrong, key.v)}
    (verdict,) = [x for x in mark(key.exercise, key.v, raws, key=key) if x.part == part.variable]
    return verdict.status == "correct"


def carried_on(
    exercise: Exercise, v: Variant, where: Part, wrong: Any
) -> tuple[dict[str, Any], set[str]]:
    """Answers of somebody who goes on rightly, and the parts that came out otherwise."""
    right = references(exercise, v)
    given: dict[str, Any] = {}
    affected = {where.variable}
    for part in exercise.parts:
        if part.variable == where.variable:
            given[part.variable] = wrong
            continue
        if not affected & set(part.needs):
            given[part.variable] = part.answer.rounded(right[part.variable])
            continue
        try:
            value = part.answer.declared(
                part.solve(v, {name: given[name] for name in part.needs}), v
            )
        except Exception:  # noqa: BLE001 - nothing follows from such an answer
            value = right[part.variable]
        else:
            affected.add(part.variable)
        given[part.variable] = part.answer.rounded(value)
    return given, affected


def marked(
    exercise: Exercise,
    v: Variant,
    key: AnswerKey,
    where: Part,
    slip: Slip,
    answers: dict[str, Any],
    affected: set[str],
) -> Run:
    raws = {
        part.variable: handed_in(part.answer, answers[part.variable], v) for part in exercise.asked
    }
    found = counted(exercise, mark(exercise, v, raws, key=key))
    verdicts = {verdict.part: verdict for verdict in found}
    lost, later, kept = 0.0, 0.0, 0.0
    for part in exercise.asked:
        points = verdicts[part.variable].points
        if points is None:
            continue
        lost += part.points - points
        if part.variable in affected and part is not where:
            later += part.points
            kept += points
    own = verdicts[where.variable]
    return Run(
        exercise.slug,
        where.variable,
        slip.name,
        lost,
        FAIR[slip.kind] * where.points,
        exercise.points,
        named=bool(own.findings or own.reading),
        carried_on=later > 0,
        lost_all_after=later > 0 and kept == 0,
    )


def row(name: str, runs: list[Run]) -> str:
    """Figures of some runs."""
    lost, fair = sum(run.lost for run in runs), sum(run.fair for run in runs)
    points = sum(run.out_of for run in runs)
    named = sum(run.named for run in runs)
    on = [run for run in runs if run.carried_on]
    nothing = sum(run.lost_all_after for run in on)
    return (
        f"{name:46.46}{len(runs):6}{100 * lost / points:8.1f}{100 * fair / points:8.1f}"
        f"{lost / fair:8.2f}{100 * named / len(runs):8.0f}{nothing:6} of {len(on)}"
    )


def main() -> None:
    """Prints a row for every exercise, for every slip, and for all."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--draws", type=int, default=2, help="variants of each exercise")
    draws = parser.parse_args().draws
    files = exercise_files()
    runs: list[Run] = []
    for slug in sorted(files):
        exercise = find(slug, files)
        for seed in range(draws):
            runs += runs_of(exercise, seed)
    print(f"{'':46}{'runs':>6}{'lost %':>8}{'fair %':>8}{'times':>8}{'named %':>8}  all lost after")
    for attribute in ("exercise", "mistake"):
        groups: dict[str, list[Run]] = defaultdict(list)
        for run in runs:
            groups[getattr(run, attribute)].append(run)
        for name, group in sorted(
            groups.items(), key=lambda item: -sum(r.lost - r.fair for r in item[1])
        ):
            if attribute == "exercise" or name in {slip.name for slip in SLIPS}:
                print(row(name, group))
        print()
    known = [run for run in runs if run.mistake not in {slip.name for slip in SLIPS}]
    print(row("known mistakes of the exercises", known))
    print(row("all", runs))


if __name__ == "__main__":
    main()
