"""How well known mistakes of any arm are told apart: `python benchmarks/diagnosis.py [--draws N]`.

For every robot: how long the bank of single mistakes and of pairs takes, and a diagnosis; which
share of the mistakes that show has one name, or a class of several; how many are named wrongly.
Then, of answers without such a mistake, how many have a name.
"""

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from kinegrade.exercises.arm import Arm
from kinegrade.grader.diagnosis.bank import Bank
from kinegrade.grader.diagnosis.explain import Alternatives, Seen, explained, hinted
from kinegrade.grader.diagnosis.steps import steps_of
from kinegrade.solutions.robots import ROBOTS

ALLOWED = 2e-3
DECIMALS = 3
WIDEST = 5.1e-3  # of an answer that happens to have two decimals
SHOWS = {None: 3e-3, 3: 4e-3, 2: 1.2e-2}
ANSWERS = 450


@dataclass
class Figures:
    """What was met on one robot."""

    bank: list[float] = field(default_factory=list)
    pairs: list[float] = field(default_factory=list)
    diagnosis: list[float] = field(default_factory=list)
    met: int = 0
    unique: int = 0
    unnamed: int = 0
    wrong: int = 0


def timed(call: Callable[[], object], into: list[float]) -> object:
    start = time.perf_counter()
    found = call()
    into.append(1000 * (time.perf_counter() - start))
    return found


def arm_of(name: str, rng: np.random.Generator) -> Arm:
    robot = ROBOTS[name]
    lengths = {length: round(rng.uniform(0.3, 1.2), 2) for length in robot.parameters}
    angles = rng.uniform(0.3, 1.2, robot.n) * rng.choice([-1, 1], robot.n)
    slides = np.array([kind == "P" for kind in robot.kinds])
    return Arm(robot, lengths, np.where(slides, np.abs(angles), angles).round(3))


def known_of(arm: Arm, what: str) -> Alternatives:
    reference = getattr(arm, what)
    bank = Bank([steps_of(arm)])
    return Alternatives(bank, bank.view([reference], {}), [reference])


def seen(value: np.ndarray) -> Seen:
    return Seen([value], [np.full(value.shape, ALLOWED)])


def measured(name: str, what: str, draws: int) -> Figures:
    """Single mistakes of one robot, exact, at three and at two decimals."""
    rng, figures = np.random.default_rng(7), Figures()
    for _ in range(draws):
        known = known_of(arm_of(name, rng), what)
        timed(lambda known=known: known.singles, figures.bank)
        timed(lambda known=known: known.pairs, figures.pairs)
        _ = known.other_numbers
        rules, (answers,) = known.singles
        for (mistake,), answer in zip(rules, answers, strict=True):
            off = np.abs(answer - known.references[0]).max()
            for decimals, least in SHOWS.items():
                if off > least:
                    value = answer if decimals is None else np.round(answer, decimals)
                    judge(known, mistake.family, value, figures)
    return figures


def judge(known: Alternatives, family: str, value: np.ndarray, figures: Figures) -> None:
    """Whether an answer is explained by its mistake, or by others that come to the same."""
    told = timed(lambda: explained(known, seen(value), DECIMALS), figures.diagnosis)
    figures.met += 1
    if told is None:
        figures.unnamed += 1
        return
    figures.unique += len(told.titles) == 1
    rules, (answers,) = known.singles
    close = (np.abs(answers - value) <= WIDEST).reshape(len(answers), -1).all(axis=1)
    same = {rules[place][0].title for place in np.flatnonzero(close)}
    families = {title.partition(":")[0] for title in told.titles}
    figures.wrong += not told.titles <= same or family.partition(":")[0] not in families


def without_mistake(
    kind: str, known: Alternatives, name: str, what: str, rng: np.random.Generator
) -> np.ndarray:
    right = known.references[0]
    if kind == "random":
        return rng.uniform(-1.5, 1.5, right.shape)
    if kind == "shuffled":
        return rng.permutation(right.ravel()).reshape(right.shape)
    if kind == "noisy":
        off = rng.uniform(1.5 * ALLOWED, 10 * ALLOWED, right.shape)
        return right + off * rng.choice([-1, 1], right.shape)
    return getattr(arm_of(name, rng), what)


def false_names(kind: str) -> tuple[int, int]:
    """How many of 450 answers have a name, and how many a hint."""
    rng, names = np.random.default_rng(11), list(ROBOTS)
    named, hints = 0, 0
    for number in range(ANSWERS):
        name, what = names[number % len(names)], "T" if number % 3 == 0 else "J"
        known = known_of(arm_of(name, rng), what)
        value = without_mistake(kind, known, name, what, rng)
        named += explained(known, seen(value), DECIMALS) is not None
        hints += hinted(known, seen(value), DECIMALS) is not None
    return named, hints


def main() -> None:
    """Prints a row for every robot, and one for every kind of answer without a mistake."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--draws", type=int, default=5, help="variants of each robot")
    draws = parser.parse_args().draws
    print(f"{'':18}{'bank ms':>9}{'pairs ms':>9}{'diagnosis':>10}{'met':>7}{'unique %':>9}"
          f"{'class %':>8}{'unnamed':>8}{'wrong':>6}")  # fmt: skip
    for name in ROBOTS:
        for what in ("J", "T"):
            f = measured(name, what, draws)
            share = 100 * f.unique / f.met
            of_class = 100 * (f.met - f.unnamed - f.unique) / f.met
            print(f"{name + ' ' + what:18}{np.median(f.bank):9.1f}{np.median(f.pairs):9.1f}"
                  f"{np.median(f.diagnosis):10.2f}{f.met:7}{share:9.0f}{of_class:8.0f}"
                  f"{f.unnamed:8}{f.wrong:6}")  # fmt: skip
    for kind in ("random", "shuffled", "noisy", "neighbour's"):
        named, hints = false_names(kind)
        print(f"{kind:18}{named:9} of {ANSWERS} named, {hints} hinted at")


if __name__ == "__main__":
    main()
