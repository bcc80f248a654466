"""What is handed in without looking at a question: one answer for everybody, or printed numbers.

Constants are learned from other draws than those in which they are tried.
"""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import (
    Choice,
    Conditions,
    Configurations,
    Formulas,
    Function,
    Manual,
    Numbers,
    TableOf,
    Variant,
)
from ...exercises.exercise import Exercise, Part
from ...grader.collecting.wire import Raw
from ...grader.kinds.markers import handed_in

SAMPLES = 3  # other students whose whole sheet is handed in
FILLS = {"zeros": 0.0, "ones": 1.0, "halves": 0.5, "right angles": np.pi / 2}
ALPHAS = (("0",), ("pi/2",), ("-pi/2",), ("pi/2", "-pi/2"), ("-pi/2", "pi/2"))
DERIVED = (Formulas, Function, Manual)
"""Kinds whose answers somebody has derived: to hand in another's is copied work, and no guess."""

Array = NDArray[np.float64]
Answers = Mapping[str, Any]
"""Reference answers of one draw, by variable."""
Guessed = Callable[[Part, Variant], Raw | None]
"""What is handed in for a part on a sheet with these numbers; None where there is no such guess."""


@dataclass(frozen=True)
class Guess:
    """A way to fill in a sheet without work, by its name."""

    name: str
    answer: Guessed


def guesses_for(exercise: Exercise, learned: Sequence[tuple[Variant, Answers]]) -> Iterator[Guess]:
    """All of them; `learned` are other draws with their answers, of which constants are made."""
    for i, (v, answers) in enumerate(learned[:SAMPLES], 1):
        yield Guess(f"the sheet of another student ({i})", _of_another(v, answers))
    yield _constant("the commonest answers", exercise, learned, _commonest_answer)
    yield _constant("the commonest entries", exercise, learned, _commonest_entries)
    for letter in "abcdefgh":
        yield Guess(f"{letter} in every choice", _letter(letter))
    for name, fill in FILLS.items():
        yield Guess(name, _filled(fill))
    for name in exercise.units:
        yield Guess(f"the printed {name}", _copied(name))
    for alphas in ALPHAS:
        yield Guess(f"lengths by their letters, alpha {', '.join(alphas)}", _by_letters(alphas))
    yield from _conditions(exercise)


def _of_another(theirs: Variant, answers: Answers) -> Guessed:
    def answer(part: Part, _: Variant) -> Raw | None:
        if isinstance(part.answer, DERIVED):
            return None
        return handed_in(part.answer, answers[part.variable], theirs)

    return answer


Learned = Callable[[Part, Sequence[Any]], Raw | None]
"""A constant for a part from its answers in other draws."""


def _constant(
    name: str, exercise: Exercise, learned: Sequence[tuple[Variant, Answers]], constant: Learned
) -> Guess:
    raws: dict[str, Raw | None] = {}
    for part in exercise.asked:
        raws[part.variable] = constant(part, [answers[part.variable] for _, answers in learned])
    return Guess(name, lambda part, _: raws[part.variable])


def _commonest_answer(part: Part, answers: Sequence[Any]) -> Raw | None:
    """The whole answer that most students have."""
    if isinstance(part.answer, DERIVED):
        return None
    texts = [repr(part.answer.rounded(answer)) for answer in answers]
    return handed_in(part.answer, answers[texts.index(_most_common(texts))], {})


def _commonest_entries(part: Part, answers: Sequence[Any]) -> Raw | None:
    """In each entry what most students have there; of numbers, to one decimal."""
    if isinstance(part.answer, Numbers):
        stack = np.round(np.array(answers, dtype=float), 1).reshape(len(answers), -1)
        entries = [_most_common(column) for column in stack.T.tolist()]
        return Raw("num", np.reshape(np.array(entries, dtype=float), part.answer.shape))
    if isinstance(part.answer, TableOf):
        texts = [np.array(handed_in(part.answer, answer, {}).value) for answer in answers]
        columns = np.array(texts).reshape(len(texts), -1).T.tolist()
        entries = [_most_common(column) for column in columns]
        return Raw("text", np.array(entries, dtype=object).reshape(texts[0].shape).tolist())
    return None


def _most_common(values: Sequence[Any]) -> Any:
    return Counter(values).most_common(1)[0][0]


def _letter(letter: str) -> Guessed:
    def answer(part: Part, _: Variant) -> Raw | None:
        known = isinstance(part.answer, Choice) and letter in part.answer.letters
        return Raw("text", letter) if known else None

    return answer


def _filled(fill: float) -> Guessed:
    def answer(part: Part, _: Variant) -> Raw | None:
        if isinstance(part.answer, Configurations):
            return Raw("num", np.full((1, part.answer.joints), fill))
        if isinstance(part.answer, Numbers):
            return Raw("num", np.full(part.answer.shape, fill))
        return None

    return answer


def _copied(name: str) -> Guessed:
    """A printed array, wherever as many numbers are asked."""

    def answer(part: Part, v: Variant) -> Raw | None:
        if not isinstance(part.answer, Numbers) or not part.answer.shape or name not in v:
            return None
        printed = np.asarray(v[name], dtype=float)
        if printed.size != np.prod(part.answer.shape):
            return None
        turned = printed.T if printed.T.shape == part.answer.shape else printed
        return Raw("num", turned.reshape(part.answer.shape))

    return answer


def _by_letters(alphas: Sequence[str]) -> Guessed:
    """Every d, l and a of the sheet in the row of its index, and the same angles for all."""

    def answer(part: Part, v: Variant) -> Raw | None:
        if not isinstance(part.answer, TableOf):
            return None
        rows: list[list[str]] = []
        for i, kind in enumerate(part.answer.kinds):
            named = [name for name in (f"d{i + 1}", f"l{i + 1}") if name in v]
            a = f"a{i + 1}" if f"a{i + 1}" in v else "0"
            alpha = alphas[i % len(alphas)] if i + 1 < len(part.answer.kinds) else "0"
            joint = f"q{i + 1}"
            if kind == "R":
                rows.append([joint, " + ".join(named) or "0", a, alpha])
            else:
                rows.append(["0", " + ".join([*named, joint]), a, alpha])
        return Raw("text", rows)

    return answer


def _conditions(exercise: Exercise) -> Iterator[Guess]:
    """A joint at zero, or its sine or cosine."""
    joints: set[str] = set()
    for part in exercise.asked:
        if isinstance(part.answer, Conditions):
            joints.update(name for name in part.answer.names if name.startswith("q"))
    for joint in sorted(joints):
        for text in (f"{joint} = 0", f"sin({joint}) = 0", f"cos({joint}) = 0"):
            yield Guess(text, _condition(text))
        length = joint.replace("q", "l")
        yield Guess(f"{joint} = -{length}", _condition(f"{joint} + {length} = 0"))


def _condition(text: str) -> Guessed:
    def answer(part: Part, _: Variant) -> Raw | None:
        return Raw("text", [text]) if isinstance(part.answer, Conditions) else None

    return answer
