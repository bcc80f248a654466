"""What people see on stderr while the data goes to stdout."""

import sys
from collections.abc import Callable, Generator
from contextlib import contextmanager

from ..text.escape import printable_lines

ASCII = {"✓": "+", "↪": ">", "◐": "~", "✗": "x", "–": "-", "—": "-"}
"""What stands for a mark where stdout cannot show it."""


def say(text: str) -> None:
    """Lines on stderr, of which no terminal obeys a character."""
    sys.stderr.write(printable_lines(text) + "\n")


def counted(number: int, one: str, many: str) -> str:
    """A number with the word for one or for many: "1 mark", "2 marks"."""
    return f"{number} {one if number == 1 else many}"


def shown(text: str) -> str:
    """A text with marks as stdout can show it: many consoles of Windows have no ✓."""
    try:
        text.encode(sys.stdout.encoding or "utf-8")
    except UnicodeEncodeError:
        return text.translate(str.maketrans(ASCII))
    return text


@contextmanager
def progress(title: str, total: int) -> Generator[Callable[..., None]]:
    """A bar on stderr; the yielded function advances it by one, or by a count."""
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeRemainingColumn,
    )

    columns = (TextColumn(title), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    console = Console(stderr=True)
    # Into a file, a bar would leave an empty line.
    with Progress(
        *columns, console=console, transient=True, disable=not console.is_terminal
    ) as bar:
        task = bar.add_task(title, total=total)

        def advance(count: int = 1) -> None:
            bar.advance(task, count)

        yield advance
