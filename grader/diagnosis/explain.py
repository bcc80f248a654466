"""Which known mistakes a wrong answer may come from: the whole smallest class of them."""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Fault
from ..reading.unreadable import entry_name
from .bank import Bank, Rules
from .mistake import Mistake
from .other_numbers import OtherNumbers
from .pipeline import Solved
from .steps import Array
from .views import View
from .wording import either, two_mistakes, with_one_entry

CHEAPEST: tuple[Fault, ...] = ("slip", "presentation", "concept")
TELLING, TELLING_MORE = 3, 4  # numbers that known mistakes change, to name one, or two at once
LEAST_ENTRIES = 6  # of an answer, for one of them to be wrong beside a known mistake
FEWEST_DECIMALS = 2  # to which an answer may be rounded and still have a name
ROUNDED = 1e-9


@dataclass(frozen=True)
class Explanation:
    """What explains a wrong answer.

    Attributes:
        sentence: What the student is told; it names steps and no values.
        fault: What the cheapest of the mistakes is priced as; None of a mere hint.
        key: What is charged once though it is met again.
        titles: The mistakes it may be.
    """

    sentence: str
    fault: Fault | None
    key: str
    titles: frozenset[str]


@dataclass(frozen=True, eq=False)
class Seen:
    """An answer at every place of the bank, and how far each entry may be off."""

    values: Sequence[Array]
    allowed: Sequence[Array]


class Alternatives:
    """What known mistakes make of one part's answer; computed when a wrong one is met."""

    def __init__(self, bank: Bank, view: View, references: Sequence[Array]) -> None:
        """Takes the right answer at every place of the bank."""
        self.bank, self.view, self.references = bank, view, tuple(references)

    @cached_property
    def singles(self) -> tuple[list[Rules], list[Array]]:
        """Every mistake, and the answers (H, *shape) at every place."""
        return self._of(*self.bank.singles(self.view.setting))

    @cached_property
    def pairs(self) -> tuple[list[Rules], list[Array]]:
        """The same of two mistakes."""
        return self._of(*self.bank.pairs(self.view.setting))

    @cached_property
    def other_numbers(self) -> OtherNumbers:
        """Answers with another length or angle."""
        return OtherNumbers(self.bank.places[0], self.view, self.references[0])

    def _of(self, rules: list[Rules], solved: Sequence[Solved]) -> tuple[list[Rules], list[Array]]:
        with np.errstate(all="ignore"):
            return rules, [self.view.of(one) for one in solved]


def explained(
    known: Alternatives, seen: Seen, decimals: int | None, suspected: Iterable[Collection[str]] = ()
) -> Explanation | None:
    """The mistakes of which any one explains an answer; None where there are none.

    `suspected` are the titles that other answers of the same student were explained by: where these
    and the class have some in common, it is one of those.
    """
    seen = _as_rounded(seen, decimals)
    if _agrees(known.references, seen):
        return None
    found = _one_mistake(known, seen)
    if not found:
        return None
    for titles in suspected:
        both = [mistake for mistake in found if mistake.title in titles]
        found = both or found
    first, *_ = found
    return Explanation(
        either(found),
        cheapest(mistake.fault for mistake in found),
        first.sentence,
        frozenset(mistake.title for mistake in found),
    )


def cheapest(faults: Iterable[Fault | None]) -> Fault | None:
    """The fault of these that costs least; None where there is none."""
    met = set(faults)
    for fault in CHEAPEST:
        if fault in met:
            return fault
    return None


def hinted(known: Alternatives, seen: Seen, decimals: int | None) -> Explanation | None:
    """Two mistakes that explain an answer together. It is no more than a hint."""
    seen = _as_rounded(seen, decimals)
    if not known.bank.tells_pairs or _agrees(known.references, seen):
        return None
    sentence = _with_one_entry(known, seen) or _with_another(known, seen)
    return Explanation(sentence, None, sentence, frozenset()) if sentence else None


def _as_rounded(seen: Seen, decimals: int | None) -> Seen:
    """The answer with the tolerance of somebody who rounds to fewer decimals than are asked."""
    if decimals is None:
        return seen
    for fewer in range(FEWEST_DECIMALS, decimals):
        (value,), (allowed,) = seen.values, seen.allowed
        if np.abs(value - np.round(value, fewer)).max() < ROUNDED:
            return Seen([value], [np.maximum(allowed, 0.501 * 10.0**-fewer)])
    return seen


def _agrees(references: Sequence[Array], seen: Seen) -> bool:
    """Whether the answer is right, as far as its decimals tell."""
    for reference, value, allowed in zip(references, seen.values, seen.allowed, strict=True):
        if not (np.abs(reference - value) <= allowed).all():
            return False
    return True


def _one_mistake(known: Alternatives, seen: Seen) -> list[Mistake]:
    """The likeliest first, one of each family."""
    rules, answers = known.singles
    if _telling(known, answers, seen) < TELLING:
        return []
    fits = _fitting(answers, seen).all(axis=1) & _shows(known, answers, seen)
    found = [rules[place][0] for place in np.flatnonzero(fits)]
    if not found and len(seen.values) == 1 and known.view.is_affine:
        found = list(known.other_numbers.fitting(seen.values[0], seen.allowed[0]))
    by_family: dict[str, Mistake] = {}
    for mistake in sorted(found, key=lambda mistake: mistake.prior):
        by_family.setdefault(mistake.family, mistake)
    return list(by_family.values())


def _with_one_entry(known: Alternatives, seen: Seen) -> str:
    """One mistake, and one wrong entry besides."""
    rules, answers = known.singles
    if seen.values[0].size < LEAST_ENTRIES or len(seen.values) > 1:
        return ""
    fits = _fitting(answers, seen)
    rows = np.flatnonzero(((~fits).sum(axis=1) == 1) & _shows(known, answers, seen))
    places = {int(np.flatnonzero(~fits[row])[0]) for row in rows}
    if len(rows) == 0 or len(places) > 1:
        return ""
    where = np.unravel_index(places.pop(), seen.values[0].shape)
    changed = _changed_entries(known, answers, seen)[rows].sum(axis=1)
    if changed.min() < TELLING_MORE:
        return ""
    return with_one_entry([rules[row][0] for row in rows], entry_name(tuple(map(int, where))))


def _with_another(known: Alternatives, seen: Seen) -> str:
    rules, answers = known.pairs
    if _telling(known, answers, seen) < TELLING_MORE:
        return ""
    fits = _fitting(answers, seen).all(axis=1) & _shows(known, answers, seen)
    return two_mistakes([rules[place] for place in np.flatnonzero(fits)])


def _fitting(answers: Sequence[Array], seen: Seen) -> NDArray[np.bool_]:
    """Which entries (H, entries) of which alternatives agree with the answer at every place."""
    agree: list[NDArray[np.bool_]] = []
    for alternatives, value, allowed in zip(answers, seen.values, seen.allowed, strict=True):
        close = np.less_equal(np.abs(alternatives - value), allowed, dtype=bool)
        agree.append(close.reshape(len(alternatives), -1))
    return np.logical_and.reduce(agree)


def _changed_entries(
    known: Alternatives, answers: Sequence[Array], seen: Seen
) -> NDArray[np.bool_]:
    """Which entries (H, entries) of which alternatives are not right."""
    right = _fitting(answers, Seen(known.references, seen.allowed))
    return np.logical_not(right, dtype=bool)


def _shows(known: Alternatives, answers: Sequence[Array], seen: Seen) -> NDArray[np.bool_]:
    """Which alternatives (H,) differ from the right answer by more than is allowed."""
    return np.asarray(_changed_entries(known, answers, seen).any(axis=1))


def _telling(known: Alternatives, answers: Sequence[Array], seen: Seen) -> int:
    """How many numbers known mistakes change at all: by few of them, anything would be named."""
    entries = _changed_entries(known, answers, seen).any(axis=0)
    return int(entries.sum()) * len(seen.values)
