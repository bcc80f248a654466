"""A download, a zip or a folder, as files; what may hurt is refused, and nothing is unpacked."""

import io
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path, PurePosixPath
from typing import IO
from zipfile import BadZipFile, ZipFile, ZipInfo, is_zipfile

from ..errors import CourseError
from ..machine.zip_entry import DAMAGED, entry_name, objection
from ..sheet.upload import MAX_NOTEBOOK, is_unseen
from ..text.escape import printable

MOST_FILES = 50_000  # of a download
MOST_INNER_FILES = 500  # of a zip that a student handed in
MOST_INNER_BYTES = 256 << 20  # of all files in it, unpacked


class RefusedError(CourseError):
    """A file that is not unpacked; the sentence says which, and why."""


@dataclass(frozen=True)
class File:
    """One file of a download.

    Attributes:
        path: Where it lies in the download.
        modified: When it was changed last, as the archive has it, in no known zone.
        read: Gives its bytes; raises RefusedError where it is too large or damaged.
    """

    path: PurePosixPath
    modified: datetime | None
    read: Callable[[], bytes]


@dataclass(frozen=True)
class Contents:
    """The files of a download, and sentences on what is not among them."""

    files: tuple[File, ...]
    refused: tuple[str, ...] = ()


@contextmanager
def opened_download(path: Path) -> Generator[Contents]:
    """What a zip or a folder holds, as long as it is open.

    Raises:
        CourseError: it is not there, is neither, is damaged, or holds more files than a course
            hands in.
    """
    if path.is_dir():
        yield _of_folder(path)
        return
    if not path.exists():
        raise CourseError(f"{path} is not there: a download is a zip file or a folder")
    if not path.is_file() or not is_zipfile(path):
        raise CourseError(f"{path} is no zip file, or a damaged one; download it again")
    try:
        with ZipFile(path) as archive:
            yield _of_zip(archive, str(path), MOST_FILES)
    except BadZipFile as error:
        raise CourseError(f"{path} is a damaged zip file: {error}") from error


def inner_files(data: bytes, place: str) -> Contents:
    """What a zip holds that a student handed in.

    Raises:
        RefusedError: it is damaged, or unpacks to more than a hand-in may be.
    """
    try:
        archive = ZipFile(io.BytesIO(data))
    except DAMAGED as error:
        raise RefusedError(f"{place}: a damaged zip file") from error
    try:
        contents = _of_zip(archive, place, MOST_INNER_FILES)
    except CourseError as error:
        raise RefusedError(str(error)) from error
    unpacked = sum(info.file_size for info in archive.infolist())
    if unpacked > MOST_INNER_BYTES:
        raise RefusedError(
            f"{place}: it unpacks to {unpacked >> 20} MB; "
            f"a hand-in may have {MOST_INNER_BYTES >> 20} MB"
        )
    return contents


def _of_zip(archive: ZipFile, place: str, most: int) -> Contents:
    infos = archive.infolist()
    if len(infos) > most:
        raise CourseError(f"{place}: it holds {len(infos)} files; at most {most} are taken")
    files: list[File] = []
    refused: list[str] = []
    for info in infos:
        if info.filename.endswith("/") or _is_unseen(info.filename):
            continue
        why = objection(info)
        if why:
            refused.append(f"{place}: {printable(info.filename)!r} {why}; it is not taken")
            continue
        files.append(_zipped(archive, info, place))
    return Contents(tuple(files), tuple(refused))


def _zipped(archive: ZipFile, info: ZipInfo, place: str) -> File:
    path = PurePosixPath(entry_name(info))

    def read() -> bytes:
        try:
            with archive.open(info) as stream:
                return _bounded(stream, f"{place}: {path}")
        except DAMAGED as error:
            raise RefusedError(f"{place}: {path} is damaged") from error

    return File(path, _modified(info), read)


def _modified(info: ZipInfo) -> datetime | None:
    try:
        return datetime(*info.date_time)  # noqa: DTZ001 - a zip knows no zones
    except ValueError:  # month 0 of those who write no time
        return None


def _of_folder(folder: Path) -> Contents:
    files: list[File] = []
    refused: list[str] = []
    for path in _below(folder):
        inside = PurePosixPath(path.relative_to(folder).as_posix())
        if path.is_symlink():
            refused.append(f"{path} is a link; it is not taken")
        elif path.is_file():
            files.append(File(inside, None, _reader(path)))
        if len(files) > MOST_FILES:
            raise CourseError(f"{folder} holds more than {MOST_FILES} files")
    return Contents(tuple(files), tuple(refused))


def _below(folder: Path) -> Iterator[Path]:
    """Everything in a folder and its folders that is seen, in order; links are not followed."""
    for path in sorted(folder.iterdir()):
        if _is_unseen(path.name):
            continue
        if path.is_dir() and not path.is_symlink():
            yield from _below(path)
        else:
            yield path


def _reader(path: Path) -> Callable[[], bytes]:
    def read() -> bytes:
        try:
            with path.open("rb") as stream:
                return _bounded(stream, str(path))
        except OSError as error:
            raise RefusedError(f"{path} cannot be read: {error.strerror}") from error

    return read


def _bounded(stream: IO[bytes], place: str) -> bytes:
    """All of a stream; what an archive says of a size is not believed."""
    data = stream.read(MAX_NOTEBOOK + 1)
    if len(data) > MAX_NOTEBOOK:
        raise RefusedError(f"{place} has more than {MAX_NOTEBOOK >> 20} MB; it is not taken")
    return data


def _is_unseen(name: str) -> bool:
    parts: Iterable[str] = name.replace("\\", "/").split("/")
    return any(part != ".." and is_unseen(part) for part in parts)
