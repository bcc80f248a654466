"""Which of a student's files counts for a sheet: the newest of those that are meant for it."""

import os
from collections.abc import Collection, Generator, Iterable, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path

from ..errors import CourseError
from ..text.escape import printable
from .about import REQUEST, whose
from .archive import ZIP, uploads_in
from .file_names import called_after, looks_like
from .gathering import Wanted, gathered, refused
from .submissions import MAX_BESIDE, READERS, RUN, Submission, submission_of
from .upload import Upload, mentions, on_disk, refuse_links, visible_names
from .versions import Ages, newest, not_beside

Received = Mapping[tuple[str, str, str], datetime]
"""Student, sheet and name of a file to when it came in."""


def find_submission(
    folder: Path,
    student: str,
    sheet: str,
    sheets: Collection[str] = (),
    received: Received | None = None,
) -> Submission | None:
    """The file of a student that counts for a sheet; None when there is none.

    That is the newest of those that are called after the sheet or a later version of it, or say
    inside that they are this student's copy of it. A zip archive, a folder called after the sheet,
    and what is in them are looked at as if the files lay beside them. `sheets` are all of the
    course, one of which may have a longer name; `received` says when files came in, else the time
    of the file does. What it raises names the file below the course folder: the student reads it.

    Raises:
        CourseError: the file is there and cannot be read, or is a link to some other file.
    """
    with named_below(folder):
        return _found(Wanted(folder, student, sheet, tuple(sheets) or (sheet,)), received or {})


@contextmanager
def named_below(folder: Path) -> Generator[None]:
    """Files in the sentences of errors are named below a folder: students read them."""
    try:
        yield
    except CourseError as error:
        raise CourseError(str(error).replace(f"{folder}{os.sep}", "")) from error


def unread(
    folder: Path,
    student: str,
    sheet: str,
    sheets: Collection[str],
    received: Received | None = None,
) -> tuple[str, ...]:
    """Names of the files that look like versions of the one that counts, which is not read here."""
    try:
        choice = _choice(Wanted(folder, student, sheet, tuple(sheets)), received or {})
    except CourseError:
        return ()
    return choice.unread if choice else ()


@dataclass(frozen=True)
class _Choice:
    """The upload that counts, all that came with it, and the names of its other versions."""

    counts: Upload
    uploads: Sequence[Upload]
    unread: tuple[str, ...]


def _choice(wanted: Wanted, received: Received) -> _Choice | None:
    uploads = gathered(wanted)
    meant = _meant(wanted, uploads)
    if not meant:
        return None
    versions = not_beside(meant)
    counts = newest(versions, Ages(wanted.folder, wanted.student, wanted.sheet, received))
    return _Choice(counts, uploads, tuple(_unread(wanted, counts, meant, versions)))


def _found(wanted: Wanted, received: Received) -> Submission | None:
    choice = _choice(wanted, received)
    if choice is None:
        return None
    counts = choice.counts
    refuse_links(counts.handed_in)
    submission = submission_of(counts)
    if counts.path != counts.handed_in:
        around = _beside(counts, submission.data, choice.uploads)
        submission = replace(submission, packed=around, handed_in=counts.handed_in)
    return replace(submission, unread=choice.unread)


def read_handed_in(path: Path) -> Submission:
    """One file, or what counts in a zip archive, which may be called as it likes.

    Raises:
        CourseError: it cannot be read or cannot be marked, or an archive does not say which of its
            files is the one.
    """
    if path.is_dir():
        raise CourseError(f"{path} is a folder; this takes a file")
    if path.suffix.lower() != ZIP:
        return submission_of(on_disk(path))
    uploads = uploads_in(path)
    meant = [one for one in uploads if one.ending in RUN and whose(one.data, one.ending)[0]]
    if not meant:
        meant = [one for one in uploads if _is_called(one, path.stem)]
    if not meant:
        meant = _likely(uploads, path, path.stem)
    if not meant:
        raise CourseError(f"{path} holds no file that can be marked: {', '.join(READERS)}")
    counts = newest(not_beside(meant), Ages(path.parent, "", path.stem, {}))
    submission = submission_of(counts)
    around = _beside(counts, submission.data, uploads)
    return replace(submission, packed=around, handed_in=path)


def _is_called(upload: Upload, sheet: str) -> bool:
    return upload.ending in READERS and called_after(upload.path.stem, [sheet]) == sheet


def _meant(wanted: Wanted, uploads: Sequence[Upload]) -> list[Upload]:
    """The files that are for the sheet, by their names or by what they say of themselves."""
    found = [one for one in uploads if _is_for(wanted, one)]
    if any(one.packed for one in found):
        return found
    nameless = [one for one in uploads if one.packed and not wanted.called(one.path)]
    if nameless:
        found += _likely(nameless, nameless[0].handed_in, wanted.sheet)
    return found


def _is_for(wanted: Wanted, upload: Upload) -> bool:
    if upload.ending not in READERS:
        return upload.path == upload.handed_in  # an archive that cannot be looked into
    called = wanted.called(upload.path)
    if called:
        return called == wanted.sheet
    return _says(upload) == (wanted.sheet, wanted.student)


def _says(upload: Upload) -> tuple[str, str]:
    """Sheet and student of a file of whatever name; empty where it does not say."""
    if upload.ending not in RUN:
        return "", ""
    try:
        if upload.path == upload.handed_in:
            refuse_links(upload.path)
        return whose(upload.data, upload.ending)
    except CourseError:
        return "", ""


def _likely(uploads: Sequence[Upload], place: Path, sheet: str) -> list[Upload]:
    """The one file that can be meant among those that are packed together for a sheet."""
    for ending in READERS:
        those = [one for one in uploads if one.ending == ending]
        if len(those) == 1:
            return those
        if those:
            names = " and ".join(printable(one.path.name) for one in those[:3])
            said = f"{place} holds {names}; the file to be marked takes the name {sheet}{ending}"
            return [refused(place, said)]
    return []


def _beside(counts: Upload, data: bytes, uploads: Iterable[Upload]) -> dict[str, bytes]:
    """Files in the same folder of an archive that the one that counts mentions, by name."""
    found: dict[str, bytes] = {}
    left = MAX_BESIDE
    if counts.ending not in RUN:
        return found
    for one in uploads:
        if one is counts or one.path.parent != counts.path.parent:
            continue
        if mentions(data, one.path.stem) and one.size <= left:
            found[one.path.name] = one.data
            left -= one.size
    return found


def _unread(
    wanted: Wanted, counts: Upload, meant: Sequence[Upload], versions: Sequence[Upload]
) -> list[str]:
    """Names of the other versions, and of what begins as the name of the sheet does."""
    others = [one.path for one in versions if one is not counts]
    known = {one.path for one in meant} | {one.handed_in for one in meant}
    for name in visible_names(wanted.own):
        path = wanted.own / name
        if path not in known and _may_be_for(wanted, path):
            others.append(path)
    return sorted(printable(path.relative_to(wanted.own).as_posix()) for path in others)


def _may_be_for(wanted: Wanted, path: Path) -> bool:
    """Whether a file begins as the sheet does, or is an archive that nobody looked into."""
    called = wanted.called(path)
    if path.suffix.lower() == ZIP and not called:
        return True
    if path.suffix.lower() not in (*READERS, ZIP) or called not in ("", wanted.sheet):
        return False
    return looks_like(path.stem, wanted.sheet)


def misnamed(folder: Path, student: str, sheets: Collection[str]) -> str:
    """The first of a student's files that is for no sheet; empty when there is none."""
    own = folder / "submitted" / student
    for name in visible_names(own):
        if name.endswith(REQUEST) or name in sheets:
            continue
        upload = on_disk(own / name)
        if upload.ending in (*READERS, ZIP) and called_after(upload.path.stem, sheets):
            continue
        said, owner = _says(upload)
        if said not in sheets or owner != student:
            return printable(name)
    return ""


def strangers(folder: Path, students: Collection[str]) -> list[str]:
    """Folders in submitted/ that are nobody's of the roster."""
    found: list[str] = []
    for name in visible_names(folder / "submitted"):
        if name in students or name == "received.csv":
            continue
        found.append(printable(name))
    return found
