"""What validating exercises found, as a table and as JSON."""

import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from ..machine.console import say, shown
from .telling_table import telling_lines, telling_table
from .validation import KINDS, Validation, summary

WIDE = 180  # columns, where no terminal says how many it has


def show_validations(validations: Sequence[Validation]) -> None:
    """One line for every exercise on stdout, then the first failures of each."""
    console = Console() if sys.stdout.isatty() else Console(width=WIDE)
    console.print(table_of(validations))
    loaded = [validation for validation in validations if validation.draws]
    if loaded:
        console.print(telling_table(loaded))
    for validation in loaded:
        for line in telling_lines(validation):
            print(f"· {validation.slug}: {line}")  # noqa: T201 - data of the command

    failed = 0
    for validation in validations:
        failed += bool(validation.failures)
        for line in summary(validation):
            print(f"{shown('✗')} {validation.slug}: {line}")  # noqa: T201 - data of the command
    say(f"{len(validations) - failed} of {len(validations)} exercises are valid.")


def table_of(validations: Sequence[Validation]) -> Table:
    """A column for each thing that was looked at: ✓, or how many draws failed; and the source."""
    table = Table(header_style="bold", pad_edge=False, box=SIMPLE_HEAD)
    table.add_column("exercise", no_wrap=True)
    for name in ("parts", "points", "draws", "slowest draw", *KINDS, "guessing"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("source")
    for validation in validations:
        table.add_row(
            validation.slug,
            str(validation.parts),
            f"{validation.points:g}",
            str(validation.draws),
            f"{1000 * validation.seconds_to_draw:.1f} ms",
            *_outcomes(validation),
            escape(validation.source),
        )
    return table


def _outcomes(validation: Validation) -> Iterator[str]:
    """A cell for every kind of proof."""
    for kind in KINDS:
        failed = {failure.seed for failure in validation.failures if failure.kind == kind}
        yield f"{shown('✗')} {len(failed)}" if failed else shown("✓")
    yield "!" if validation.guessing else shown("✓")


def validations_json(validations: Sequence[Validation]) -> str:
    """Everything a script would want."""
    data = [asdict(validation) for validation in validations]
    return json.dumps(data, indent=2, ensure_ascii=False)
