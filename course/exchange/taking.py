"""Claims taken into submitted/: the newest of each student and sheet; what it replaces is kept."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path, PurePath

from ..machine.files import write_atomically
from ..settings.config import Course
from ..settings.roster import DEVICE
from ..sheet.about import REQUEST
from ..sheet.submissions import MAX_BESIDE, READERS
from ..term.received import Receipt, read_receipts, write_receipts
from ..text.escape import printable
from .archive import RefusedError
from .claims import Claim, Looked
from .upload import Upload

LONGEST = 200  # bytes of a name, to which others are added while a file is written
REPLACED = ".replaced"
"""The folder of a student with files that newer ones replaced."""


@dataclass
class Taken:
    """What `collect` did.

    Attributes:
        paths: Files that are new or changed.
        unchanged: How many were there already.
        conflicts: Sentences on files that are not taken and that a person has to look at.
        notes: Sentences on files that are not taken as they need not be.
    """

    paths: list[Path] = field(default_factory=list[Path])
    unchanged: int = 0
    conflicts: list[str] = field(default_factory=list[str])
    notes: list[str] = field(default_factory=list[str])


def take(course: Course, looked: Looked) -> Taken:
    """Writes what was claimed, and submitted/received.csv with the times."""
    taker = _Taker(course)
    for (student, sheet, _), claims in sorted(_by_answer(looked.claims).items()):
        if len({claim.upload.owner for claim in claims}) > 1:
            places = " and ".join(claim.upload.place for claim in claims)
            taker.taken.conflicts.append(
                f"{student}, sheet {sheet}: {places} came from different people; neither is taken"
            )
            continue
        newest = _newest(claims, taker.taken)
        try:
            taker.take(newest)
        except RefusedError as error:
            taker.taken.conflicts.append(str(error))
    write_receipts(course.folder, taker.receipts.values())
    taker.taken.conflicts[:0] = looked.conflicts
    why = "no answers to a sheet of this course; not taken"
    others = [f"{upload.place}: {why}" for upload in looked.passed_over]
    taker.taken.notes += [*looked.notes, *others]
    return taker.taken


def _by_answer(claims: Iterable[Claim]) -> Mapping[tuple[str, str, bool], list[Claim]]:
    """Claims by student, sheet, and whether they are requests."""
    found: dict[tuple[str, str, bool], list[Claim]] = {}
    for claim in claims:
        key = (claim.student, claim.sheet, claim.upload.is_request)
        found.setdefault(key, []).append(claim)
    return found


def _newest(claims: Sequence[Claim], taken: Taken) -> Claim:
    """The one that counts; the others are named."""
    newest = max(claims, key=_age)
    for other in claims:
        if other is not newest:
            taken.notes.append(
                f"{other.upload.place}: {newest.upload.place} of the same student is newer, "
                "or goes before it; not taken"
            )
    return newest


def _age(claim: Claim) -> tuple[datetime, datetime, int, str]:
    """When it came in, else when it was changed; then what marking looks for first."""
    upload = claim.upload
    received = upload.received or datetime.min.replace(tzinfo=UTC)
    modified = upload.file.modified or datetime.min  # noqa: DTZ901 - only compared with its like
    order = [*READERS, *{upload.suffix} - set(READERS)]
    return received, modified, -order.index(upload.suffix), upload.place


class _Taker:
    """Puts files into submitted/ and keeps the times in step with them."""

    def __init__(self, course: Course) -> None:
        self._course = course
        self.taken = Taken()
        self.receipts: dict[tuple[str, str], Receipt] = {}
        for one in read_receipts(course.folder, course.settings.zone):
            self.receipts[one.student, one.file] = one

    def take(self, claim: Claim) -> None:
        """The file in submitted/<student>/, with those beside it; what was there is set aside.

        Raises:
            RefusedError: it cannot be read, or its time is not known and matters.
        """
        folder = self._course.folder / "submitted" / claim.student
        data = claim.upload.file.read()
        if claim.upload.is_request:
            self._take_request(claim, folder / f"{claim.sheet}{REQUEST}", data)
            return
        path = folder / f"{claim.sheet}{claim.upload.suffix}"
        if _holds(path, data):
            if self._is_newer(claim, claim.upload.received):
                self.taken.unchanged += 1
                self._note(claim, path, claim.upload.received)
                self._take_beside(folder, claim)
            return
        received = claim.upload.received or self._entered(claim, path)
        if received is None:
            self._refuse_without_time(claim, path)
        if not self._is_newer(claim, received):
            return
        for suffix in READERS:
            self._set_aside(claim.student, folder / f"{claim.sheet}{suffix}")
        write_atomically(path, data)
        self.taken.paths.append(path)
        self._note(claim, path, received)
        self._take_beside(folder, claim)

    def _take_request(self, claim: Claim, path: Path, data: bytes) -> None:
        """What a student asks has no deadline, and stands beside the answers."""
        if _holds(path, data):
            self.taken.unchanged += 1
            return
        self._set_aside(claim.student, path)
        write_atomically(path, data)
        self.taken.paths.append(path)

    def _note(self, claim: Claim, path: Path, received: datetime | None) -> None:
        if received is not None:
            receipt = Receipt(claim.student, claim.sheet, path.name, received)
            self.receipts[claim.student, path.name] = receipt

    def _entered(self, claim: Claim, path: Path) -> datetime | None:
        """The time that somebody wrote into received.csv for a file that is not there yet."""
        receipt = self.receipts.get((claim.student, path.name))
        if receipt is None or path.exists():
            return None
        return receipt.received

    def _refuse_without_time(self, claim: Claim, path: Path) -> None:
        """A file is not taken without a time where that would make it early or late."""
        place = f"{claim.upload.place}: it came without a time"
        there = self._times(claim)
        if there:
            raise RefusedError(
                f"{place}, and what {claim.student} has in submitted/ has one "
                f"({max(there).isoformat()}); it is not taken"
            )
        (sheet,) = self._course.sheets((claim.sheet,))
        if sheet.deadline is not None or sheet.closes is not None:
            raise RefusedError(
                f"{place}, and sheet {claim.sheet} has a deadline; it is not taken. "
                f"A line {claim.student},{claim.sheet},{path.name},TIME in "
                "submitted/received.csv says when it came"
            )

    def _times(self, claim: Claim) -> list[datetime]:
        """When the files of this sheet came in that the student has in submitted/."""
        times: list[datetime] = []
        for suffix in READERS:
            receipt = self.receipts.get((claim.student, f"{claim.sheet}{suffix}"))
            if receipt is not None:
                times.append(receipt.received)
        return times

    def _is_newer(self, claim: Claim, received: datetime | None) -> bool:
        """Whether a file goes before what is there; an older one is named."""
        there = self._times(claim)
        if received is None or not there or received >= max(there):
            return True
        self.taken.notes.append(
            f"{claim.upload.place}: older than what {claim.student} has in submitted/ "
            f"({max(there).isoformat()}); not taken"
        )
        return False

    def _set_aside(self, student: str, path: Path) -> None:
        """Moves a file that would be marked in place of the new one; nothing is lost."""
        if not path.exists() and not path.is_symlink():
            return
        kept = path.parent / REPLACED
        kept.mkdir(exist_ok=True)
        number = 1
        while (kept / f"{number}-{path.name}").exists():
            number += 1
        name = f"{number}-{path.name}"
        path.rename(kept / name)
        receipt = self.receipts.pop((student, path.name), None)
        if receipt is not None:
            inside = f"{REPLACED}/{name}"
            self.receipts[student, inside] = replace(receipt, file=inside)

    def _take_beside(self, folder: Path, claim: Claim) -> None:
        """Data and modules that the notebook mentions, under their own names."""
        left = MAX_BESIDE
        for other in claim.beside:
            if not self._may_be_called(other):
                self.taken.notes.append(f"{other.place}: no file can be called so; not taken")
                continue
            data = other.file.read()
            left -= len(data)
            if left < 0:
                said = f"{other.place}: more than a notebook may have beside it; not taken"
                self.taken.notes.append(said)
                return
            if not _holds(folder / other.name, data):
                self._set_aside(claim.student, folder / other.name)
                write_atomically(folder / other.name, data)

    def _may_be_called(self, other: Upload) -> bool:
        """Whether a name is not that of a sheet's answer, and possible on every system."""
        sheets = {sheet.name.casefold() for sheet in self._course.settings.sheet}
        plain = other.name == printable(other.name) and not set(other.name) & set('/\\:*?"<>|')
        plain = plain and len(other.name.encode()) <= LONGEST
        stem = PurePath(other.name).stem.casefold()
        return plain and not DEVICE.fullmatch(other.name) and stem not in sheets


def _holds(path: Path, data: bytes) -> bool:
    return path.is_file() and not path.is_symlink() and path.read_bytes() == data
