"""Running one notebook at a given level, for tests of what stands around it."""

import pytest
from courses import notebook
from kinegrade.grader.collecting.ask import Ask, Limits
from kinegrade.grader.collecting.collect import collect
from kinegrade.grader.jail.jail import FOR_ONE, Jail, missing
from kinegrade.grader.jail.level import Level

WALLED = [Level.STRONG, Level.MEDIUM]
LIMITS = Limits(cell_seconds=10, notebook_seconds=60)


def run_at(level, *sources, names=("x",), limits=LIMITS, beside=None):
    """The values of these cells, run at a level; skips where the machine does not have it."""
    skip_without(level)
    with Jail(level=level, preload=FOR_ONE) as jail:
        asks = [Ask(name) for name in names]
        return collect(notebook(*sources), asks, limits, jail=jail, beside=beside)


def skip_without(level):
    """Skips a test, with the reason, where the machine does not have a level."""
    why = missing(level)
    if why:
        pytest.skip(f"this machine has no level {level}: {why}")
