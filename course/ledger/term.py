"""What a term brings: when files came in, extensions, what is accepted, requests, publication."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Literal

from sqlalchemy import Connection, RowMapping, Table, select

from .damage import DamagedError, Damages, check_row, is_whole, loaded, plain, text_of
from .database import Database
from .entries import Change, enter
from .tables import acceptance, arrival, entry, extension, mark, published, request

Accepted = Literal["finding", "answer"]
UNKNOWN = "an unknown time"
EVERYBODY = "everybody"
"""Of whom damage is told that is no single student's."""


@dataclass(frozen=True)
class Extension:
    """What holds for one student and sheet: another deadline, or that it does not count."""

    until: datetime | None = None
    excused: bool = False


@dataclass(frozen=True)
class Acceptance:
    """What counts for everybody: the answers of a part with a finding, or one answer as it is.

    Attributes:
        sheet: The sheet.
        part: The variable.
        kind: What `text` is.
        text: The sentence of a finding, or an answer as JSON.
        share: Of the part's points.
        reason: Why, for students to read.
        entry: The number of the change that accepted it.
    """

    sheet: str
    part: str
    kind: Accepted
    text: str
    share: float
    reason: str = ""
    entry: int = 0


@dataclass(frozen=True)
class Request:
    """What a student asks to have looked at again, and whether somebody gave a mark since."""

    student: str
    sheet: str
    part: str
    text: str
    at: str
    answered: bool


@dataclass(frozen=True)
class Publication:
    """One student's result as it was told, when."""

    at: str
    result: Any


class TermLedger:
    """These rows of a gradebook. Of the same thing, the newest row counts."""

    def __init__(self, database: Database, damages: Damages) -> None:
        """Reads and writes in a gradebook that is open, and notes in `damages` what is damaged."""
        self._database = database
        self._damages = damages

    def arrivals(self, sheet: str) -> dict[tuple[str, str], datetime]:
        """When submissions were handed in, by student and hash."""
        last = {(row["student"], row["hash"]): row for row in self._rows(arrival, sheet)}
        found: dict[tuple[str, str], datetime] = {}
        for place, row in last.items():
            try:
                check_row(row, arrival)
                found[place] = _time(row["at"])
            except DamagedError:
                what, mended = "the time of a file", "`kinegrade grade` takes that of the file"
                self._damages.add("arrival", sheet, row["student"], what, mended)
        return found

    def note_arrivals(self, sheet: str, times: Mapping[tuple[str, str], datetime]) -> None:
        """Keeps when submissions came in, by student and hash; what is known adds nothing."""
        known = self.arrivals(sheet)
        new: list[dict[str, Any]] = []
        for (student, hash_), time in times.items():
            if known.get((student, hash_)) != time:
                new.append({"student": student, "hash": hash_, "at": time.isoformat()})
        self._add(arrival, sheet, new, Change())

    def extensions(self, sheet: str) -> dict[str, Extension]:
        """Student to what was granted."""
        last = {row["student"]: row for row in self._rows(extension, sheet)}
        found: dict[str, Extension] = {}
        for student, row in last.items():
            try:
                check_row(row, extension)
                until = None if row["until"] is None else _time(row["until"])
                found[student] = Extension(until, row["excused"])
            except DamagedError:
                mended = "`kinegrade extend` or `kinegrade excuse` enters it"
                self._damages.add("extension", sheet, student, "the extension", mended)
        return found

    def extend(self, student: str, sheet: str, given: Extension, change: Change) -> None:
        """Grants another deadline, or takes one back with an empty extension."""
        until = None if given.until is None else given.until.isoformat()
        row = {"student": student, "until": until, "excused": given.excused}
        self._add(extension, sheet, [row], change)

    def acceptances(self, sheet: str) -> list[Acceptance]:
        """What is accepted on a sheet."""
        last: dict[tuple[str, str, str], Mapping[str, Any]] = {}
        for row in self._rows(acceptance, sheet):
            key = (row["part"], row["kind"], row["text"])
            last.pop(key, None)
            last[key] = row

        found: list[Acceptance] = []
        for row in last.values():
            if not is_whole(row, acceptance):
                what = f"what is accepted of {text_of(row['part'], 'a part')}"
                mended = "`kinegrade accept` enters it"
                self._damages.add("acceptance", sheet, EVERYBODY, what, mended)
                continue
            share = row["share"]
            if share is not None:
                one = Acceptance(
                    sheet,
                    row["part"],
                    row["kind"],
                    row["text"],
                    share,
                    row["reason"],
                    row["entry"],
                )
                found.append(one)
        return found

    def accept(self, given: Acceptance, change: Change, *, no_longer: bool = False) -> None:
        """Accepts for everybody, from now on; or no longer."""
        share = None if no_longer else given.share
        row = {"part": given.part, "kind": given.kind, "text": plain(given.text), "share": share}
        self._add(acceptance, given.sheet, [row], change)

    def requests(self, sheet: str) -> list[Request]:
        """What students asked, the oldest first; the last text of each part."""
        answered = self._marked(sheet)
        last: dict[tuple[str, str], Request] = {}
        for row in self._rows(request, sheet):
            if not is_whole(row, request):
                mended = "ask what it was"
                self._damages.add("request", sheet, row["student"], "a request", mended)
                continue
            student, part = row["student"], row["part"]
            since = answered.get((student, part), 0) > row["entry"]
            last[student, part] = Request(student, sheet, part, row["text"], row["at"], since)
        return list(last.values())

    def note_requests(self, sheet: str, asked: Mapping[tuple[str, str], str]) -> None:
        """Keeps what students ask, by student and part; what is known adds nothing."""
        known = {(one.student, one.part): one.text for one in self.requests(sheet)}
        new: list[dict[str, Any]] = []
        for (student, part), text in asked.items():
            if known.get((student, part)) != plain(text):
                new.append({"student": student, "part": part, "text": plain(text)})
        self._add(request, sheet, new, Change())

    def published(self, sheet: str) -> dict[str, Publication]:
        """Student to the result that was told last; one that is damaged counts as none."""
        last = {row["student"]: row for row in self._rows(published, sheet)}
        found: dict[str, Publication] = {}
        for student, row in last.items():
            try:
                check_row(row, published)
                found[student] = Publication(row["at"], loaded(row["result"], dict))
            except DamagedError:
                mended = "put a backup back, or `kinegrade publish` tells it anew"
                self._damages.add("published", sheet, student, "what was published", mended)
        return found

    def publish(self, sheet: str, results: Mapping[str, str], change: Change) -> None:
        """Keeps results, as JSON by student, that are told from now on."""
        rows = [{"student": student, "result": text} for student, text in results.items()]
        self._add(published, sheet, rows, change)

    def _rows(self, table: Table, sheet: str) -> Iterable[Mapping[str, Any]]:
        """The rows of a sheet, the oldest first, with time and reason of their changes.

        Many rows have one change: where that is damaged, nobody is to blame.
        """
        query = select(table, entry.c.at, entry.c.reason)
        if "at" in table.c:
            query = select(table, entry.c.reason)
        query = query.join(entry, entry.c.id == table.c.entry)
        query = query.where(table.c.sheet == sheet).order_by(table.c.entry)
        with self._database.reading() as connection:
            rows = connection.execute(query).mappings().all()
        return [_said(row, table) for row in rows]

    def _marked(self, sheet: str) -> dict[tuple[str, str], int]:
        """The newest entry of a mark or comment, by student and part."""
        query = select(mark.c.student, mark.c.part, mark.c.entry).where(mark.c.sheet == sheet)
        with self._database.reading() as connection:
            rows = connection.execute(query.order_by(mark.c.entry)).all()
        found: dict[tuple[str, str], int] = {}
        for student, part, number in rows:
            if isinstance(number, int):
                found[student, part] = number
        return found

    def _add(
        self, table: Table, sheet: str, rows: Collection[dict[str, Any]], change: Change
    ) -> None:
        """Adds rows with one entry for all; none adds nothing."""
        if not rows:
            return
        with self._database.writing() as connection:
            _insert(connection, table, sheet, rows, change)


def _insert(
    connection: Connection,
    table: Table,
    sheet: str,
    rows: Iterable[dict[str, Any]],
    change: Change,
) -> None:
    number = enter(connection, change)
    for row in rows:
        connection.execute(table.insert().values(entry=number, sheet=sheet, **row))


def _said(row: RowMapping, table: Table) -> dict[str, Any]:
    """A row with what is only shown of its change, as far as that can be read."""
    told = {**row, "reason": text_of(row["reason"], "")}
    if "at" not in table.c:
        told["at"] = text_of(row["at"], UNKNOWN)
    return told


def _time(text: str) -> datetime:
    """The time of a cell.

    Raises:
        DamagedError: it tells none.
    """
    try:
        found = datetime.fromisoformat(text)
    except ValueError as error:
        raise DamagedError from error
    if found.tzinfo is None:  # it cannot be held against a deadline
        raise DamagedError
    return found
