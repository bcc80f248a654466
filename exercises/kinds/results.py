"""What a student's function returned, as a part's own check gets it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arguments import Calls

Result = NDArray[np.float64] | str
NO_RESULT = "no result"


@dataclass(frozen=True)
class Results:
    """What came out, call by call: the value that `Part.check` gets for an answer `Function`.

    `values` has a finite real array for every call, in the order of `Function.inputs`, group after
    group; where a call gave none, it has the reason as a sentence, such as "ZeroDivisionError:
    division by zero". With `published` they are results for the calls of `Function.published`,
    handed in without a function; then the order is theirs.

    A check judges group by group: `Outcome(right=[True, False])` for two groups, or call by call
    with a list for each.
    """

    values: tuple[Result, ...]
    published: bool = False

    def by_group(self, calls: Calls) -> dict[str, tuple[Result, ...]]:
        """Results of each group of `calls`, which are what `inputs` (or `published`) returned.

        A result that is missing is the text "no result".
        """
        found = dict[str, tuple[Result, ...]]()
        start = 0
        for group, arguments in calls.items():
            end = start + len(arguments)
            found[group] = _padded(self.values[start:end], len(arguments))
            start = end
        return found


def _padded(results: Sequence[Result], length: int) -> tuple[Result, ...]:
    missing = [NO_RESULT] * (length - len(results))
    return (*results, *missing)
