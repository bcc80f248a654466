"""What validating one exercise found: its failures, chunk after chunk put together."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from .draw import Failure
from .telling import Telling, all_told

KINDS = (
    "solve",
    "full marks",
    "nonsense",
    "mistakes",
    "printable",
    "render",
    "solution",
    "variants",
)
ENOUGH = 10  # draws in which everything that some variants have should be seen
MOST_ALIKE = 0.05  # share of draws that may repeat an earlier one


@dataclass(frozen=True)
class Validation:
    """What looking at some draws of one exercise found.

    What guessing earns too much of is told in `guessing` and is no failure: whether it matters is
    for the instructor to say.
    """

    slug: str
    parts: int
    points: float
    draws: int
    seconds_to_draw: float
    failures: tuple[Failure, ...]
    named: tuple[str, ...] = ()
    source: str = ""
    telling: Telling = field(default_factory=Telling)
    harder: Mapping[str, Sequence[Any]] = field(default_factory=dict[str, Sequence[Any]])
    guessing: tuple[Failure, ...] = ()


Looked = tuple[Validation, list[str]]
"""What some draws showed, and the drawn numbers as text."""


def together(results: Sequence[Looked]) -> Validation:
    """One validation of all chunks of draws, with what only many draws can show."""
    texts: list[str] = []
    failures: dict[Failure, None] = {}  # each once, in order
    for validation, drawn in results:
        texts += drawn
        failures |= dict.fromkeys(validation.failures)

    first = results[0][0]
    return replace(
        first,
        draws=sum(validation.draws for validation, _ in results),
        seconds_to_draw=max(validation.seconds_to_draw for validation, _ in results),
        telling=all_told([validation.telling for validation, _ in results]),
        failures=(*failures, *_alike(texts), *_never_drawn(first.named, texts)),
    )


def _alike(texts: Sequence[str]) -> Iterator[Failure]:
    """That draws repeat each other too often."""
    alike = len(texts) - len(set(texts))
    if alike > max(1, MOST_ALIKE * len(texts)):
        sentence = f"{alike} of {len(texts)} draws repeat an earlier one; draw from wider sets"
        yield Failure("variants", 0, "", sentence)


def _never_drawn(named: Sequence[str], texts: Sequence[str]) -> Iterator[Failure]:
    """Names that the exercise says are drawn, and no draw has; a few draws are no proof."""
    if not named or len(texts) < ENOUGH:
        return
    missing = set(named)
    for text in texts:
        missing.difference_update(json.loads(text))
    if missing:
        listed = ", ".join(sorted(missing))
        sentence = (
            f"no draw has {listed}, though units, hidden or structure name it; "
            "is it misspelt there or in draw?"
        )
        yield Failure("variants", 0, "", sentence)


def summary(validation: Validation) -> Iterator[str]:
    """One line for every part and kind of failure: how often, and the first of it."""
    groups: dict[tuple[str, str], list[Failure]] = {}
    for failure in (*validation.failures, *validation.guessing):
        groups.setdefault((failure.kind, failure.part), []).append(failure)

    for (kind, part), failures in groups.items():
        where = [kind]
        if part:
            where.append(part)
        if validation.draws and kind != "guessing":  # else the file could not be loaded
            draws = {failure.seed for failure in failures}
            where.append(f"in {len(draws)} of {validation.draws} draws, first {min(draws)}")
        yield f"{', '.join(where)}: {failures[0].sentence}"
