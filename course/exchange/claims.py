"""Uploads looked at one by one: whose sheet each is, or a sentence on why it is nobody's."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath

from ..settings.config import Course
from ..sheet.submissions import NOTEBOOK, READERS
from ..text.escape import printable
from .archive import File, RefusedError, inner_files
from .inside import Inside, inside
from .people import Owner, People, UnknownPersonError
from .upload import Upload

ZIP = ".zip"
DEPTH = 2  # a zip in a zip, no deeper


@dataclass(frozen=True)
class Claim:
    """A file that is a student's answer to a sheet, or asks to have it looked at again.

    `beside` are other files, which an answer mentions. It holds no bytes, as those of a large class
    together may not fit: they are read again.
    """

    student: str
    sheet: str
    upload: Upload
    beside: tuple[Upload, ...] = ()


@dataclass(frozen=True)
class Looked:
    """What looking at uploads came to.

    `conflicts` are for a person to settle; `passed_over` are files that hold no answers.
    """

    claims: tuple[Claim, ...]
    conflicts: tuple[str, ...]
    passed_over: tuple[Upload, ...]
    notes: tuple[str, ...] = ()


def look(course: Course, people: People, uploads: Iterable[Upload], sheet: str = "") -> Looked:
    """Claims of all uploads; `sheet` is which one they are for, where they do not say."""
    conflicts: list[str] = []
    claims: list[Claim] = []
    unnamed: list[Upload] = []
    unpacked: list[Upload] = []
    for upload in uploads:
        unpacked += _unpacked(upload, conflicts)
    looker = _Looker(course, people, sheet)
    for upload in unpacked:
        try:
            claim = looker.claim(upload)
        except RefusedError as error:
            conflicts.append(str(error))
            continue
        if claim is None:
            unnamed.append(upload)
        else:
            claims.append(claim)

    for upload in looker.likely(unnamed, claims):
        unnamed.remove(upload)
        try:
            claims.append(looker.claim_as(upload, sheet))
        except RefusedError as error:
            conflicts.append(str(error))
    claims, passed_over = _with_files_beside(claims, unnamed)
    return Looked(tuple(claims), tuple(conflicts), tuple(passed_over), tuple(looker.notes))


def _unpacked(upload: Upload, conflicts: list[str], depth: int = 0) -> Iterator[Upload]:
    """The upload, or all that it holds where it is a zip."""
    if upload.suffix != ZIP or depth == DEPTH:
        yield upload
        return
    try:
        contents = inner_files(upload.file.read(), upload.place)
    except RefusedError as error:
        conflicts.append(str(error))
        return
    conflicts += contents.refused
    for file in contents.files:
        outer = upload.file.path / file.path
        inner = replace(upload, name=file.path.name, file=File(outer, file.modified, file.read))
        yield from _unpacked(inner, conflicts, depth + 1)


class _Looker:
    """What says whose an upload is, and of which sheet."""

    def __init__(self, course: Course, people: People, sheet: str) -> None:
        self._people = people
        self._given = sheet
        self._roster = {student.id for student in course.students}
        self._sheets = [known.name for known in course.settings.sheet]
        self.notes: list[str] = []

    def claim(self, upload: Upload) -> Claim | None:
        """The claim of an upload that says which sheet it is; None for all others.

        Raises:
            RefusedError: it is nobody's, somebody else's, or of another sheet.
        """
        if upload.suffix not in READERS and not upload.is_request:
            return None
        says = Inside()
        if upload.suffix == NOTEBOOK:
            says = inside(upload.file.read())
        which = says.sheet or self._called_after(upload.name)
        if not which and upload.suffix == NOTEBOOK and upload.assignment in self._sheets:
            which = upload.assignment
        if not which:
            return None
        return self._claim(upload, says, which)

    def claim_as(self, upload: Upload, sheet: str) -> Claim:
        """The claim of an upload that does not say which sheet it is. Raises as `claim`."""
        return self._claim(upload, Inside(), sheet)

    def likely(self, unnamed: Sequence[Upload], claims: Sequence[Claim]) -> list[Upload]:
        """Files that are answers to the given sheet, of people who have no other answer.

        Where somebody has several, a notebook goes before tables, which may be data beside it.
        """
        if not self._given:
            return []
        order = list(READERS)
        done = {claim.upload.owner for claim in claims if not claim.upload.is_request}
        best: dict[Owner, int] = {}
        answers = [one for one in unnamed if one.suffix in READERS and one.owner not in done]
        for one in answers:
            rank = order.index(one.suffix)
            best[one.owner] = min(rank, best.get(one.owner, rank))
        return [one for one in answers if order.index(one.suffix) == best[one.owner]]

    def _claim(self, upload: Upload, says: Inside, which: str) -> Claim:
        if which not in self._sheets:
            raise RefusedError(
                f"{upload.place}: it is of sheet {which!r}, which this course does not have"
            )
        if self._given and which != self._given:
            raise RefusedError(
                f"{upload.place}: it is of sheet {which}, and was handed in as {self._given}; "
                "it is not taken"
            )
        return Claim(self._student(upload, says), which, upload)

    def _called_after(self, name: str) -> str:
        """The sheet that a file is called after, such as `one (1).ipynb`; empty where none."""
        stem = PurePath(name).stem.casefold()
        for known in sorted(self._sheets, key=len, reverse=True):
            rest = stem.removeprefix(known.casefold())
            if rest != stem and not rest[:1].isalnum():
                return known
        return ""

    def _student(self, upload: Upload, says: Inside) -> str:
        try:
            owner = self._people.student(upload.owner).id
        except UnknownPersonError as error:
            if says.student in self._roster and not self._people.knows(upload.owner):
                self.notes.append(f"{upload.place}: taken for {says.student}, whose sheet is in it")
                return says.student
            raise RefusedError(f"{upload.place}: {error}; it is not taken") from error
        if says.student and says.student != owner:
            raise RefusedError(
                f"{upload.place}: it came from {owner}, and the sheet in it is that of "
                f"{printable(says.student)}; it is taken for neither"
            )
        return owner


def _with_files_beside(
    claims: Sequence[Claim], others: Sequence[Upload]
) -> tuple[list[Claim], list[Upload]]:
    """Notebooks with the files that they mention, from the same hand; and what is left over."""
    found: list[Claim] = []
    mentioned: list[Upload] = []
    for claim in claims:
        theirs = [other for other in others if other.owner == claim.upload.owner]
        beside = list(_mentioned(claim, theirs))
        mentioned += beside
        found.append(replace(claim, beside=tuple(beside)))
    return found, [other for other in others if other not in mentioned]


def _mentioned(claim: Claim, others: Sequence[Upload]) -> Iterator[Upload]:
    if not others or claim.upload.suffix != NOTEBOOK:
        return
    data = claim.upload.file.read()
    for other in others:
        if PurePath(other.name).stem.encode() in data:
            yield other
