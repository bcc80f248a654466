"""What guessing earns, measured over draws: no way to do it may pay more than a few percent."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...exercises.answers import Variant
from ...exercises.exercise import Exercise, references
from ...exercises.files.loading import load
from ...grader.collecting.wire import Raw
from ...grader.marking.answer_key import AnswerKey
from ...grader.marking.guesses import counted
from ...grader.marking.mark import mark
from ..variants.drawn import drawn
from .draw import Failure
from .guesses import Answers, Guess, guesses_for

DRAWS = 24  # in which every guess is tried
FIRST_LEARNED = 5000  # seeds of other draws, of which constants are made
MOST = 0.03  # of an exercise's points, on average


@dataclass(frozen=True)
class Pay:
    """What one way of guessing earns on average, by variable [points].

    The draw in which it earns most is left out: one lucky hit is no way to earn points.
    """

    guess: str
    points: Mapping[str, float]

    @property
    def sum(self) -> float:
        """Points of the whole exercise."""
        return sum(self.points.values())


def pay_of_guesses(exercise: Exercise, draws: int = DRAWS) -> list[Pay]:
    """What each way of guessing earns, the best first.

    Raises:
        Exception: of any kind, where the exercise fails on a draw.
    """
    keys = [AnswerKey(exercise, v) for v in _variants(exercise, range(draws))]
    learned = _learned(exercise, draws)
    paid = [_pay(exercise, keys, guess) for guess in guesses_for(exercise, learned)]
    return sorted(paid, key=lambda pay: -pay.sum)


def overpaid(exercise: Exercise, draws: int = DRAWS) -> Iterator[tuple[str, str]]:
    """The part in which a guess that pays too much earns most, with a sentence."""
    for pay in pay_of_guesses(exercise, draws):
        share = pay.sum / exercise.points
        if share <= MOST:
            return
        part = max(pay.points, key=lambda name: pay.points[name])
        sentence = (
            f"guessing pays: {pay.guess} earns {100 * share:.1f} % of the exercise on average, "
            f"{pay.points[part]:.2f} points of it here; draw from wider sets, or credit less"
        )
        yield part, sentence


def guess_failures(path: Path) -> list[Failure]:
    """What guessing earns too much of in an exercise file, in this process.

    What else is wrong with the file is found where its draws are looked at.
    """
    try:
        exercise = load(path)
        return [Failure("guessing", 0, part, told) for part, told in overpaid(exercise)]
    except Exception:  # noqa: BLE001 - whatever an exercise file raises was found before
        return []


def _variants(exercise: Exercise, seeds: Sequence[int]) -> Iterator[dict[str, Any]]:
    for seed in seeds:
        yield drawn(exercise, np.random.default_rng(seed))


def _learned(exercise: Exercise, draws: int) -> list[tuple[Variant, Answers]]:
    """Other draws and their answers."""
    seeds = range(FIRST_LEARNED, FIRST_LEARNED + draws)
    return [(v, references(exercise, v)) for v in _variants(exercise, seeds)]


def _pay(exercise: Exercise, keys: Sequence[AnswerKey], guess: Guess) -> Pay:
    earned: list[dict[str, float]] = []
    for key in keys:
        raws = _raws(exercise, key.v, guess)
        verdicts = counted(exercise, mark(exercise, key.v, raws, key=key))
        earned.append({verdict.part: verdict.points or 0.0 for verdict in verdicts})

    earned.sort(key=lambda points: sum(points.values()))
    usual = earned[:-1]
    points: dict[str, float] = {}
    for part in exercise.asked:
        points[part.variable] = sum(one[part.variable] for one in usual) / len(usual)
    return Pay(guess.name, points)


def _raws(exercise: Exercise, v: Variant, guess: Guess) -> dict[str, Raw]:
    raws: dict[str, Raw] = {}
    for part in exercise.asked:
        raw = guess.answer(part, v)
        if raw is not None:
            raws[part.variable] = raw
    return raws
