"""A zip that a student handed in, looked into without unpacking it; what may hurt is refused."""

import re
from collections.abc import Iterator
from functools import partial
from pathlib import Path, PurePosixPath
from zipfile import ZipFile, ZipInfo

from ..errors import CourseError
from ..machine.zip_entry import DAMAGED, entry_name, objection
from ..text.escape import printable
from .upload import Upload, is_unseen, on_disk

ZIP = ".zip"
MAX_ARCHIVE = 200 << 20
MAX_FILES = 500
MAX_UNPACKED = 256 << 20  # of all files together
MAX_DEPTH = 8  # folders inside one another
MAX_LISTING = 1 << 20  # bytes of the list of files at the end of an archive
END = b"PK\x05\x06"  # of an archive, with the size of that list twelve bytes further on
END_64 = b"PK\x06\x07"
TAIL = 66_000  # bytes in which the end of an archive is looked for
ANEW = "zip your files themselves, as your system does it, without a password"


def uploads_in(archive: Path) -> list[Upload]:
    """The files of an archive, in the order of their names.

    Raises:
        CourseError: it is damaged, too large, or holds what nobody unpacks: a link, an absolute
            path, a path out of it, an encrypted file, two files of one name.
    """
    _refuse_size(archive)
    try:
        with ZipFile(archive) as opened:
            infos = [info for info in opened.infolist() if not info.is_dir()]
    except DAMAGED as error:
        raise CourseError(f"{archive} is no zip archive, or a damaged one; zip it again") from error
    if len(infos) > MAX_FILES:
        raise _too_many(archive)
    unpacked = sum(info.file_size for info in infos)
    if unpacked > MAX_UNPACKED:
        raise CourseError(
            f"{archive} unpacks to {unpacked >> 20} MB; "
            f"what is handed in may have {MAX_UNPACKED >> 20} MB"
        )
    return list(_uploads(archive, infos))


def _refuse_size(archive: Path) -> None:
    """Refuses an archive by its size and that of its list of files, before that is read."""
    whole = on_disk(archive)
    if whole.size > MAX_ARCHIVE:
        raise CourseError(
            f"{archive} has {whole.size >> 20} MB; an archive may have {MAX_ARCHIVE >> 20} MB"
        )
    tail = whole.read()[-TAIL:]
    if END_64 in tail:
        raise CourseError(f"{archive} is an archive for more than 4 GB; zip only your answers")
    for found in re.finditer(re.escape(END), tail):
        listing = int.from_bytes(tail[found.start() + 12 : found.start() + 16], "little")
        if listing > MAX_LISTING:
            raise _too_many(archive)


def _too_many(archive: Path) -> CourseError:
    return CourseError(f"{archive} holds too many files; {MAX_FILES} are looked at")


def _uploads(archive: Path, infos: list[ZipInfo]) -> Iterator[Upload]:
    seen: set[str] = set()
    for info in sorted(infos, key=entry_name):
        name = entry_name(info)
        _refuse(archive, info, name)
        path = PurePosixPath(name)
        if any(is_unseen(part) for part in path.parts):
            continue
        if str(path) in seen:
            raise CourseError(f"{archive} holds two files called {printable(name)!r}")
        seen.add(str(path))
        yield Upload(
            archive / path,
            archive,
            info.file_size,
            partial(_read, archive, info),
            changed=info.date_time,
            packed=True,
        )


def _refuse(archive: Path, info: ZipInfo, name: str) -> None:
    why = objection(info)
    if why:
        raise CourseError(f"{archive}: {printable(name)!r} {why}; {ANEW}")
    if name.count("/") >= MAX_DEPTH:
        raise CourseError(
            f"{archive}: {printable(name)!r} lies more than {MAX_DEPTH} folders deep; {ANEW}"
        )


def _read(archive: Path, info: ZipInfo) -> bytes:
    """The bytes of one file, no more than the list of files says. Raises CourseError."""
    try:
        with ZipFile(archive) as opened:
            return opened.read(info)
    except DAMAGED as error:
        raise CourseError(
            f"{archive}: {printable(info.filename)!r} is damaged; zip it again"
        ) from error
