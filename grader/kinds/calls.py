"""Functions judged by the results of their calls: group by group, so that a constant function earns nothing."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Calls, Function, Variant
from ...exercises.kinds.results import Result, Results

Array = NDArray[np.float64]
Kind = tuple[Any, ...]
TRIED: frozenset[Kind] = frozenset(
    {("nothing",), ("identity",), ("filled", -1.0), ("filled", 0.0), ("filled", 1.0)}
)
VERBS = ("ran ", "needed ", "returned ")  # how a reason begins that is no value
ALWAYS_THE_SAME = "they count once another result is right: a function that always returns the same has these, too"


@dataclass(frozen=True)
class Group:
    """The calls of one group: what is wanted of each, and what came out."""

    name: str
    wanted: tuple[Array, ...]
    results: tuple[Result, ...]


def groups_of(answer: Function, v: Variant, reference: Any, value: Results) -> list[Group]:
    """Groups of calls with the results of the reference beside the student's."""
    inputs = answer.published if value.published and answer.published else answer.inputs
    calls: Calls = inputs(v)
    found = value.by_group(calls)
    groups = list[Group]()
    for name, arguments in calls.items():
        wanted = tuple(np.asarray(reference(*call), dtype=float) for call in arguments)
        results = found[name]
        if value.published:
            results = tuple(_unwrapped(*pair) for pair in zip(results, wanted, strict=True))
        groups.append(Group(name, wanted, results))
    return groups


def _unwrapped(result: Result, wanted: Array) -> Result:
    """A result in the shape that is asked, where a file made a list or a matrix of one number, or of a vector."""
    if (
        isinstance(result, str)
        or wanted.ndim > 1
        or result.squeeze().shape != wanted.squeeze().shape
    ):
        return result
    return result.reshape(wanted.shape)


def agreeing(groups: Sequence[Group], tolerance: float) -> list[list[bool]]:
    """Which calls gave the reference's result."""
    return [[not result_remark(*pair, tolerance) for pair in _pairs(group)] for group in groups]


def accepted(groups: Sequence[Group], right: Any) -> list[list[bool]]:
    """Calls that a part's own check found right, from a flag for every group, for every call, or one for all.

    Raises:
        ValueError: another number of flags.
    """
    flags: Any = right.tolist() if hasattr(right, "tolist") else right
    if not isinstance(flags, list | tuple):
        flags = [flags] * len(groups)
    listed = cast("Sequence[Any]", flags)
    if len(listed) != len(groups):
        raise ValueError(
            f"a check of a function takes a flag for each of {len(groups)} groups, got {len(listed)}"
        )
    return [_spread(group, flag) for group, flag in zip(groups, listed, strict=True)]


def _spread(group: Group, flag: Any) -> list[bool]:
    count = len(group.wanted)
    if not isinstance(flag, list | tuple | np.ndarray):
        return [bool(flag)] * count
    listed = [bool(one) for one in cast("Sequence[Any]", flag)]
    if len(listed) != count:
        raise ValueError(
            f"a check of a function takes {count} flags for the calls of {group.name}, got {len(listed)}"
        )
    return listed


def _pairs(group: Group) -> list[tuple[Array, Result]]:
    return list(zip(group.wanted, group.results, strict=True))


def counting(groups: Sequence[Group], right: Sequence[Sequence[bool]]) -> list[bool]:
    """Which groups earn their share of the points.

    A group counts when all of its calls are right. Where its wanted results are all alike, as for "none of these
    postures is singular", a constant function is right in it, too: it counts only beside a right call, in any group,
    that wants something else. Where the results of all groups are alike, nothing can be told apart: every right group
    counts.
    """
    kinds = [[_kind(wanted) for wanted in group.wanted] for group in groups]
    varied = len({kind for group in kinds for kind in group}) > 1
    shown = set[Kind]()
    for flags, group in zip(right, kinds, strict=True):
        shown |= {kind for ok, kind in zip(flags, group, strict=True) if ok}
    counts = list[bool]()
    for flags, group in zip(right, kinds, strict=True):
        guessed = varied and _is_constant(group) and shown <= set(group)
        counts.append(all(flags) and not guessed)
    return counts


def _is_constant(kinds: Sequence[Kind]) -> bool:
    """Whether a constant is right for a group: the same result several times, or once one that anybody would try."""
    return len(set(kinds)) < 2 and (len(kinds) > 1 or set(kinds) <= TRIED)


def _kind(result: Array) -> Kind:
    """The same for results that one simple function gives: a number for all entries, the identity, or an array."""
    if result.size == 0:
        return ("nothing",)
    if np.ptp(result) == 0:
        return ("filled", float(result.flat[0]) + 0.0)
    if result.ndim == 2 and np.array_equal(result, np.eye(*result.shape)):
        return ("identity",)
    return (result.shape, *result.ravel().tolist())


def share_of_groups(groups: Sequence[Group], right: Sequence[Sequence[bool]]) -> float:
    """Share of the points: every group is worth the same."""
    return float(np.mean(counting(groups, right))) if groups else 0.0


def said_of_groups(
    groups: Sequence[Group], right: Sequence[Sequence[bool]], tolerance: float
) -> list[str]:
    """A sentence on every group: how many calls are right, and what the first wrong one gave."""
    counted = counting(groups, right)
    sentences = list[str]()
    for group, flags, counts in zip(groups, right, counted, strict=True):
        said = f"{group.name}: {sum(flags)} of {len(flags)} right"
        if not all(flags):
            wanted, result = _pairs(group)[list(flags).index(False)]
            said += f"; the first that is not {result_remark(wanted, result, tolerance)}"
        elif not counts:
            said += f"; {ALWAYS_THE_SAME}"
        sentences.append(f"{said}.")
    return sentences


def failed_calls(groups: Sequence[Group]) -> list[str]:
    """A sentence on every group with calls that gave no numbers: the first of them, and its reason."""
    sentences = list[str]()
    for group in groups:
        failed = [
            (i, result) for i, result in enumerate(group.results, 1) if isinstance(result, str)
        ]
        if failed:
            number, reason = failed[0]
            more = (
                f" ({len(failed)} of {len(group.results)} calls gave no numbers)"
                if len(failed) > 1
                else ""
            )
            sentences.append(f"{group.name}: call {number} {_gave(reason)}{more}.")
    return sentences


def result_remark(wanted: Array, result: Result, tolerance: float) -> str:
    """What is wrong with one result; empty when nothing is."""
    if isinstance(result, str):
        return _gave(result)
    if result.shape != wanted.shape:
        return f"has shape {result.shape}, {wanted.shape} is asked"
    off = np.abs(result - wanted) > tolerance * np.maximum(1.0, np.abs(wanted))
    return f"differs in {off.sum()} of {off.size} entries" if off.any() else ""


def _gave(reason: str) -> str:
    return reason if reason.startswith(VERBS) else f"gave: {reason}"
