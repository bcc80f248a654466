"""Claims taken into submitted/: the newest of each student and sheet; what it replaces is kept."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path, PurePath

from ..config import Course
from ..escape import printable
from ..files import write_atomically
from ..roster import DEVICE
from ..sheet.submissions import MAX_BESIDE, READERS
from .claims import Claim, Looked
from .received import Receipt, merge_receipts, read_receipts

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
    taken = Taken(conflicts=list(looked.conflicts))
    times: dict[tuple[str, str], datetime] = {}
    for receipt in read_receipts(course.folder):
        key = (receipt.student, receipt.sheet)
        times[key] = max(receipt.received, times.get(key, receipt.received))

    receipts: list[Receipt] = []
    for (student, sheet), claims in sorted(_by_answer(looked.claims).items()):
        if len({claim.upload.owner for claim in claims}) > 1:
            places = " and ".join(claim.upload.place for claim in claims)
            taken.conflicts.append(
                f"{student}, sheet {sheet}: {places} came from different people; neither is taken"
            )
            continue
        newest = _newest(claims, taken)
        received = newest.upload.received
        earlier = times.get((student, sheet))
        if received is not None and earlier is not None and received < earlier:
            taken.notes.append(
                f"{newest.upload.place}: older than what {student} has in submitted/ "
                f"({earlier.isoformat()}); not taken"
            )
            continue
        path = _write(course, newest, taken)
        if received is not None:
            receipts.append(Receipt(student, sheet, path.name, received))
    merge_receipts(course.folder, receipts)
    taken.notes += [*looked.notes, *_not_read(looked)]
    return taken


def _by_answer(claims: Iterable[Claim]) -> Mapping[tuple[str, str], list[Claim]]:
    found: dict[tuple[str, str], list[Claim]] = {}
    for claim in claims:
        found.setdefault((claim.student, claim.sheet), []).append(claim)
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
    return received, modified, -list(READERS).index(upload.suffix), upload.place


def _write(course: Course, claim: Claim, taken: Taken) -> Path:
    """The file in submitted/<student>/, with those beside it; what was there is set aside."""
    folder = course.folder / "submitted" / claim.student
    path = folder / f"{claim.sheet}{claim.upload.suffix}"
    if path.is_file() and not path.is_symlink() and path.read_bytes() == claim.data:
        taken.unchanged += 1
    else:
        for suffix in READERS:
            _set_aside(folder / f"{claim.sheet}{suffix}")
        write_atomically(path, claim.data)
        taken.paths.append(path)
    _write_beside(course, folder, claim, taken)
    return path


def _set_aside(path: Path) -> None:
    """Moves a file that would be marked in place of the new one; nothing that came in is lost."""
    if not path.exists() and not path.is_symlink():
        return
    kept = path.parent / REPLACED
    kept.mkdir(exist_ok=True)
    number = 1
    while (kept / f"{number}-{path.name}").exists():
        number += 1
    path.rename(kept / f"{number}-{path.name}")


def _write_beside(course: Course, folder: Path, claim: Claim, taken: Taken) -> None:
    """Data and modules that the notebook mentions, under their own names."""
    left = MAX_BESIDE
    for other in claim.beside:
        if not _may_be_called(course, other.name):
            taken.notes.append(f"{other.place}: no file beside a notebook is called so; not taken")
            continue
        data = other.file.read()
        left -= len(data)
        if left < 0:
            taken.notes.append(f"{other.place}: more than a notebook may have beside it; not taken")
            return
        path = folder / other.name
        if not path.is_file() or path.is_symlink() or path.read_bytes() != data:
            _set_aside(path)
            write_atomically(path, data)


def _may_be_called(course: Course, name: str) -> bool:
    """Whether a file of that name is no sheet's answer, and can be called so on every system."""
    stem = PurePath(name).stem
    sheets = {sheet.name.casefold() for sheet in course.settings.sheet}
    plain = name == printable(name) and not set(name) & set('/\\:*?"<>|')
    return plain and not DEVICE.fullmatch(name) and stem.casefold() not in sheets


def _not_read(looked: Looked) -> list[str]:
    """Files that hold no answers, such as pictures, are named."""
    why = "no answers to a sheet of this course; not taken"
    return [f"{upload.place}: {why}" for upload in looked.passed_over]
