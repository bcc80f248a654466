"""What draws of exercises can tell, as a table, and below it what an instructor may mend."""

from collections.abc import Iterator, Sequence

from rich.box import SIMPLE_HEAD
from rich.markup import escape
from rich.table import Table

from .telling import Form, Kind, Note, Telling
from .validation import Validation

MOST_REFUSED = 0.6  # of all draws; more, and handing out takes long
MUCH = 2.0  # times the numbers that go into an answer: more work for the same points
LISTED = 3  # of the pairs of mistakes that are not told apart, the most frequent


def telling_table(validations: Sequence[Validation]) -> Table:
    """A line for every exercise: draws refused, and what is left in those that are handed out."""
    table = Table(header_style="bold", pad_edge=False, box=SIMPLE_HEAD)
    table.add_column("exercise", no_wrap=True)
    for name in ("refused", "for rules", "numbers", "factors"):
        table.add_column(name, justify="right", no_wrap=True)
    for name in ("rules hidden", "pairs alike", "numbers hidden"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("numbers that matter for no part")
    table.add_column("harder")
    for validation in validations:
        telling = validation.telling
        refused = len(telling.refusals)
        table.add_row(
            escape(validation.slug),
            f"{refused} of {refused + validation.draws}",
            *_times_refused(telling),
            str(len(_of(telling, "rule hidden"))),
            str(len(_of(telling, "alike"))),
            str(len(_of(telling, "number hidden"))),
            escape(", ".join(_always_idle(validation))),
            escape("; ".join(_harder(validation))),
        )
    return table


def _times_refused(telling: Telling) -> Iterator[str]:
    """How many draws were refused for each kind of objection."""
    for kind in ("rule", "number", "factor"):
        yield str(sum(kind in kinds for kinds in telling.refusals))


def _of(telling: Telling, kind: Kind) -> list[tuple[Note, int]]:
    return [(note, draws) for note, draws in telling.notes if note.kind == kind]


def _always_idle(validation: Validation) -> list[str]:
    """Numbers that matter in no draw that was looked at."""
    found = _of(validation.telling, "number idle")
    return [note.what for note, draws in found if draws == validation.draws]


def _harder(validation: Validation) -> Iterator[str]:
    for name, choices in validation.harder.items():
        yield f"{name}: {', '.join(map(str, choices))}"


def telling_lines(validation: Validation) -> Iterator[str]:
    """What an instructor may mend, a line for each."""
    telling, draws = validation.telling, validation.draws
    refused = len(telling.refusals)
    if refused > MOST_REFUSED * (refused + draws):
        yield f"{refused} of {refused + draws} draws are refused; draw from other numbers"
        for kind in ("refused for a rule", "refused for a number", "refused for a factor"):
            for note, times in _of(telling, kind)[:LISTED]:
                yield f"{kind}, {times} times: {_where(note)}"

    for note, times in _of(telling, "rule hidden"):
        yield f"gives the right answer in {times} of {draws} draws: {_where(note)}"
    for note, times in _of(telling, "alike")[:LISTED]:
        yield f"lead to one wrong answer in {times} of {draws} draws: {_where(note)}"
    for part, numbers in _hidden_numbers(validation).items():
        yield f"a change by one per cent hardly matters: {part}: {', '.join(numbers)}"
    yield from _uneven(validation)


def _hidden_numbers(validation: Validation) -> dict[str, list[str]]:
    """Parts, each with the numbers that it uses and hardly shows, and in how many draws."""
    found: dict[str, list[str]] = {}
    for note, times in _of(validation.telling, "number hidden"):
        told = f"{note.what} (in {times} of {validation.draws} draws)"
        found.setdefault(note.part, []).append(told)
    return found


def _where(note: Note) -> str:
    return ": ".join(filter(None, (note.part, note.what)))


def _uneven(validation: Validation) -> Iterator[str]:
    """Choices of form that change the work of a part much and are not known as harder."""
    groups: dict[tuple[str, str], list[tuple[float, Form]]] = {}
    for form, draws, numbers in validation.telling.work:
        mean = numbers / draws
        groups.setdefault((form.name, form.part), []).append((mean, form))

    for (name, part), means in groups.items():
        least, easiest = min(means, key=_mean)
        most, hardest = max(means, key=_mean)
        if most < MUCH * max(least, 1.0):
            continue
        yield (
            f"{part} takes about {most:.0f} numbers where {name} is {hardest.value!r}, and "
            f"{least:.0f} where it is {easiest.value!r}; draw forms of equal work, "
            "or name the first in harder"
        )


def _mean(one: tuple[float, Form]) -> float:
    return one[0]
