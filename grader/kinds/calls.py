"""Functions judged by the results of their calls, group by group.

A constant function earns nothing.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Calls, Function, Variant
from ...exercises.kinds.results import Result, Results

Array = NDArray[np.float64]
Flags = Sequence[Sequence[bool]]
"""For each group, which of its calls are right."""
Kind = tuple[Any, ...]
TRIED: frozenset[Kind] = frozenset(
    {("nothing",), ("identity",), ("filled", -1.0), ("filled", 0.0), ("filled", 1.0)}
)
"""Results that anybody would try a function with."""
VERBS = ("ran ", "needed ", "returned ")  # how a reason begins that is no value
ALWAYS_THE_SAME = (
    "they count once another result is right:"
    " a function that always returns the same has these, too"
)


@dataclass(frozen=True)
class Group:
    """The calls of one group: what is wanted of each, and what came out."""

    name: str
    wanted: tuple[Array, ...]
    results: tuple[Result, ...]

    def pairs(self) -> Iterator[tuple[Array, Result]]:
        """What is wanted of each call beside what came out."""
        return zip(self.wanted, self.results, strict=True)


def groups_of(answer: Function, v: Variant, reference: Any, value: Results) -> list[Group]:
    """Groups of calls with the results of the function `reference` beside the student's."""
    inputs = answer.inputs
    if value.published and answer.published:
        inputs = answer.published
    calls: Calls = inputs(v)
    found = value.by_group(calls)
    groups: list[Group] = []
    for name, arguments in calls.items():
        wanted = tuple(np.asarray(reference(*call), dtype=float) for call in arguments)
        group = Group(name, wanted, found[name])
        if value.published:
            results = [_unwrapped(result, array) for array, result in group.pairs()]
            group = Group(name, wanted, tuple(results))
        groups.append(group)
    return groups


def _unwrapped(result: Result, wanted: Array) -> Result:
    """A result in the shape that is asked.

    A file may make a list or a matrix of one number, or of a vector.
    """
    if isinstance(result, str) or wanted.ndim > 1:
        return result
    if result.squeeze().shape != wanted.squeeze().shape:
        return result
    return result.reshape(wanted.shape)


def agreeing(groups: Iterable[Group], tolerance: float) -> list[list[bool]]:
    """Which calls gave the reference's result."""
    right: list[list[bool]] = []
    for group in groups:
        remarks = [result_remark(wanted, result, tolerance) for wanted, result in group.pairs()]
        right.append([remark == "" for remark in remarks])
    return right


def accepted(groups: Sequence[Group], right: Any) -> list[list[bool]]:
    """Calls that a part's own check found right.

    `right` is a flag for every group, a list of them for every call, or one flag for all.

    Raises:
        ValueError: another number of flags.
    """
    flags: Any = right.tolist() if hasattr(right, "tolist") else right
    if not isinstance(flags, list | tuple):
        flags = [flags] * len(groups)
    listed = cast("Sequence[Any]", flags)
    if len(listed) != len(groups):
        raise ValueError(
            f"a check of a function takes a flag for each of {len(groups)} groups,"
            f" got {len(listed)}"
        )
    return [_for_each_call(group, flag) for group, flag in zip(groups, listed, strict=True)]


def _for_each_call(group: Group, flag: Any) -> list[bool]:
    """A flag of a group, or its flags, as one for every call."""
    count = len(group.wanted)
    if not isinstance(flag, list | tuple | np.ndarray):
        return [bool(flag)] * count
    listed = [bool(one) for one in cast("Sequence[Any]", flag)]
    if len(listed) != count:
        raise ValueError(
            f"a check of a function takes {count} flags for the calls of {group.name},"
            f" got {len(listed)}"
        )
    return listed


def counting(groups: Iterable[Group], right: Flags) -> list[bool]:
    """Which groups earn their share of the points.

    A group counts when all of its calls are right. Where its wanted results are all alike, as for
    "none of these postures is singular", a constant function is right in it, too: it counts only
    beside a right call, in any group, that wants something else. Where the results of all groups
    are alike, nothing can be told apart: every right group counts.
    """
    kinds = [[_kind(wanted) for wanted in group.wanted] for group in groups]
    every, reached = set[Kind](), set[Kind]()
    for flags, group in zip(right, kinds, strict=True):
        every.update(group)
        for is_right, kind in zip(flags, group, strict=True):
            if is_right:
                reached.add(kind)

    counts: list[bool] = []
    for flags, group in zip(right, kinds, strict=True):
        guessed = len(every) > 1 and _is_constant(group) and reached <= set(group)
        counts.append(all(flags) and not guessed)
    return counts


def _is_constant(kinds: Sequence[Kind]) -> bool:
    """Whether a constant is right for a group.

    It is for the same result several times, or once for one that anybody would try.
    """
    alike = set(kinds)
    if len(alike) > 1:
        return False
    return len(kinds) > 1 or alike <= TRIED


def _kind(result: Array) -> Kind:
    """The same for results that one simple function gives.

    That is a number for all entries, the identity, or an array.
    """
    if result.size == 0:
        return ("nothing",)
    if np.ptp(result) == 0:
        return ("filled", float(result.flat[0]) + 0.0)  # -0.0 is 0.0
    if result.ndim == 2 and np.array_equal(result, np.eye(*result.shape)):
        return ("identity",)
    return (result.shape, *result.ravel().tolist())


def share_of_groups(groups: Sequence[Group], right: Flags) -> float:
    """Share of the points: every group is worth the same."""
    if not groups:
        return 0.0
    return float(np.mean(counting(groups, right)))


def said_of_groups(groups: Sequence[Group], right: Flags, tolerance: float) -> list[str]:
    """A sentence on every group: how many calls are right, and what the first wrong one gave."""
    counted = counting(groups, right)
    sentences: list[str] = []
    for group, flags, counts in zip(groups, right, counted, strict=True):
        said = f"{group.name}: {sum(flags)} of {len(flags)} right"
        if not all(flags):
            first = list(flags).index(False)
            remark = result_remark(group.wanted[first], group.results[first], tolerance)
            said += f"; the first that is not {remark}"
        elif not counts:
            said += f"; {ALWAYS_THE_SAME}"
        sentences.append(f"{said}.")
    return sentences


def failed_calls(groups: Iterable[Group]) -> list[str]:
    """A sentence on every group with calls that gave no numbers: the first, and its reason."""
    sentences: list[str] = []
    for group in groups:
        numbered = enumerate(group.results, 1)
        failed = [(number, reason) for number, reason in numbered if isinstance(reason, str)]
        if not failed:
            continue
        number, reason = failed[0]
        said = f"{group.name}: call {number} {_gave(reason)}"
        if len(failed) > 1:
            said += f" ({len(failed)} of {len(group.results)} calls gave no numbers)"
        sentences.append(f"{said}.")
    return sentences


def result_remark(wanted: Array, result: Result, tolerance: float) -> str:
    """What is wrong with one result; empty when nothing is."""
    if isinstance(result, str):
        return _gave(result)
    if result.shape != wanted.shape:
        return f"has shape {result.shape}, {wanted.shape} is asked"
    off = np.abs(result - wanted) > tolerance * np.maximum(1.0, np.abs(wanted))
    if not off.any():
        return ""
    return f"differs in {off.sum()} of {off.size} entries"


def _gave(reason: str) -> str:
    return reason if reason.startswith(VERBS) else f"gave: {reason}"
