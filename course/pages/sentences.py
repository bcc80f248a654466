"""A sentence for every verdict: what the findings leave unsaid, kindly and truly."""

from typing import Any, cast

from ...exercises.answers import Conditions, Configurations, Formulas, Function, Numbers, TableOf
from ...exercises.exercise import Choice, Manual, Part
from ...grader.marking.verdict import Verdict
from ..language.speech import later, phrase

NO_NAME = later("Which step went wrong cannot be told from the numbers alone.")
MISSING = later(
    "Nothing was handed in here: the variable still holds ..., or no cell of your file sets it."
)
AS_ENTRIES = later("Its entries are right one by one, but the answer as a whole {does_not}.")
READABLE = later("It can be read and has the right form, but it {does_not}.")
NONE_RIGHT = later("It can be read and has the right form, but none of its entries is right.")
SOME_RIGHT = later("{right} of {of} entries are right; the others are marked ✗.")
AS_A_WHOLE: dict[type, str] = {
    Choice: later("Another option is right; your reasons for this one are worth a second look."),
    Conditions: later("These are not the conditions that are asked for."),
    Configurations: later("These are not the configurations that are asked for."),
}
"""What is said of an answer of a kind that is right or wrong as a whole."""


def sentence(part: Part, verdict: Verdict) -> str:
    """What a page says of a part of which nothing else is said to the student; else nothing."""
    told = any(not finding.private for finding in verdict.findings)
    if told or verdict.reading:
        return ""
    if verdict.status == "missing":
        return phrase(MISSING)
    if isinstance(part.answer, Manual):
        return "" if verdict.points is None else phrase("Your marker read this answer.")
    if verdict.status == "correct":
        return _right(part, verdict)
    return _wrong(part, verdict)


def _right(part: Part, verdict: Verdict) -> str:
    _, of = counted(verdict.right)
    if isinstance(part.answer, Numbers) and of > 1:
        return phrase("All {of} entries are right, within what rounding may do.", of=of)
    if isinstance(part.answer, Numbers):
        return phrase("Right, within what rounding may do.")
    if isinstance(part.answer, Formulas | TableOf) and of > 1:
        return phrase("Every entry is right, however it was written.")
    if isinstance(part.answer, Function):
        return phrase("It gave the right result for every input that was tried.")
    return phrase("Right.")


def _wrong(part: Part, verdict: Verdict) -> str:
    for kind, said in AS_A_WHOLE.items():
        if isinstance(part.answer, kind):
            return phrase(said)
    right, of = counted(verdict.right)
    does_not = phrase("does not agree with your own numbers")
    if isinstance(part.answer, Formulas):
        does_not = phrase("does not hold for every value of its variables")
    if right == of > 1:  # what the entries are does not tell all
        return phrase(AS_ENTRIES, does_not=does_not)
    if of <= 1:
        told = phrase(READABLE, does_not=does_not)
    elif right == 0:
        told = phrase(NONE_RIGHT)
    else:
        told = phrase(SOME_RIGHT, right=right, of=of)
    return f"{told} {phrase(NO_NAME)}"


def counted(right: Any) -> tuple[int, int]:
    """How many entries are right, and of how many."""
    if isinstance(right, list):
        inner = [counted(entry) for entry in cast("list[Any]", right)]
        return sum(count for count, _ in inner), sum(of for _, of in inner)
    return int(bool(right)), int(right is not None)
