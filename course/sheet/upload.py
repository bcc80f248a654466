"""A file that a student handed in, on the disk or within a zip archive."""

import os
import stat
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ..errors import CourseError

MAX_BYTES = 25 << 20
MAX_NOTEBOOK = 200 << 20  # outputs included, which are dropped before anything else
OUTPUTS = ".ipynb"
OWN_FILE = "a submission takes a file of its own"
UNSEEN = (".", "~", "__MACOSX", "Thumbs.db", "desktop.ini")
"""How names begin of what systems leave behind, which nobody handed in."""


@dataclass(frozen=True)
class Upload:
    """One file.

    Attributes:
        path: Where it lies; the path of a file in an archive begins with that of the archive.
        handed_in: The file on the disk, which is the archive for a file in one.
        size: In bytes, unpacked.
        read: Gives its bytes; raises CourseError where it cannot be read.
        changed: When it was changed last, by the archive; empty on the disk.
        packed: Whether it came in an archive or a folder for the sheet alone.
        refusal: Why it is not read, whatever it holds; empty where it is.
    """

    path: Path
    handed_in: Path
    size: int
    read: Callable[[], bytes]
    changed: tuple[int, ...] = ()
    packed: bool = False
    refusal: str = ""

    @property
    def ending(self) -> str:
        """The end of its name, in small letters."""
        return self.path.suffix.lower()

    @property
    def data(self) -> bytes:
        """Its bytes.

        Raises:
            CourseError: it cannot be read, is too large, or refused.
        """
        self.raise_refusal()
        most = MAX_NOTEBOOK if self.ending == OUTPUTS else MAX_BYTES
        if self.size > most:
            raise CourseError(
                f"{self.path} has {self.size >> 20} MB; a submission may have {most >> 20} MB"
            )
        return self.read()

    def raise_refusal(self) -> None:
        """Raises CourseError where it is refused."""
        if self.refusal:
            raise CourseError(self.refusal)


def on_disk(path: Path, *, packed: bool = False) -> Upload:
    """The upload that is a file; what is none, or a link, is refused when it is read."""
    try:
        size = path.lstat().st_size
    except OSError:
        size = 0
    return Upload(path, path, size, lambda: _bytes_of(path), packed=packed)


def refuse_links(path: Path) -> None:
    """Refuses what leads elsewhere: below submitted/ a link may lead to somebody else's file.

    Raises:
        CourseError: the file or its folder is a link, or it has a second name.
    """
    for place in (path.parent, path):
        if is_link(place):
            raise CourseError(f"{place} is a link; {OWN_FILE}")
    if stat.S_ISREG(_mode(path)) and path.stat().st_nlink > 1:
        raise CourseError(
            f"{path} is a link: the same file stands under another name, too; {OWN_FILE}"
        )


def is_own_file(path: Path) -> bool:
    """Whether there is a file that is no link, and has no second name."""
    try:
        about = path.lstat()
    except OSError:
        return False
    return stat.S_ISREG(about.st_mode) and about.st_nlink == 1


def is_link(path: Path) -> bool:
    """Whether there is a link.

    Raises:
        CourseError: nobody may look.
    """
    return stat.S_ISLNK(_mode(path))


def is_folder(path: Path) -> bool:
    """Whether there is a folder that is no link.

    Raises:
        CourseError: nobody may look.
    """
    return stat.S_ISDIR(_mode(path))


def _mode(path: Path) -> int:
    """What is there, a link itself; 0 where there is nothing. Raises CourseError."""
    try:
        return path.lstat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return 0
    except OSError as error:  # its folder may be read, and not be looked into
        raise CourseError(f"{path} cannot be looked at: {error.strerror}") from error


def is_unseen(name: str) -> bool:
    """Whether a name is one of those that systems hide."""
    return name.startswith(UNSEEN)


def mentions(data: bytes, name: str) -> bool:
    """Whether a file has a name in it; one of bytes that are no text stands in no text."""
    try:
        return name.encode() in data
    except UnicodeEncodeError:
        return False


def visible_names(folder: Path) -> list[str]:
    """What lies in a folder, sorted, without files that systems hide; nothing where none is.

    Raises:
        CourseError: there is a folder, and it cannot be looked into.
    """
    try:
        names = sorted(path.name for path in folder.iterdir())
    except (FileNotFoundError, NotADirectoryError):
        return []
    except OSError as error:
        raise CourseError(f"{folder} cannot be looked into: {error.strerror}") from error
    return [name for name in names if not is_unseen(name)]


def _bytes_of(path: Path) -> bytes:
    """What a file holds that is one. Raises CourseError."""
    mode = _mode(path)
    if stat.S_ISLNK(mode):  # it may point at somebody else's
        raise CourseError(f"{path} is a link; {OWN_FILE}")
    if mode and not stat.S_ISREG(mode):  # a pipe would be waited for
        raise CourseError(f"{path} cannot be read: it is not a file")
    try:
        with open(path, "rb", opener=_open_now) as file:
            return file.read(MAX_NOTEBOOK)
    except OSError as error:
        raise CourseError(f"{path} cannot be read: {error.strerror}") from error


def _open_now(path: str, flags: int) -> int:
    """Opens what was a file a moment ago: a link is not followed, and no pipe is waited for."""
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))
