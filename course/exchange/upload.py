"""One file of a download with its owner, as each system's module finds it."""

from dataclasses import dataclass
from datetime import datetime
from pathlib import PurePath

from ..sheet.about import REQUEST
from ..text.escape import printable
from .archive import File
from .people import Owner


@dataclass(frozen=True)
class Upload:
    """A file that somebody handed in.

    Attributes:
        owner: Whose it is, by the download.
        name: What the student called the file.
        file: Its bytes.
        received: When it came in, with a zone; None where the download does not say.
        assignment: What it was handed in for, where the download has folders for that.
    """

    owner: Owner
    name: str
    file: File
    received: datetime | None = None
    assignment: str = ""

    @property
    def suffix(self) -> str:
        """The ending of its name, in small letters."""
        return PurePath(self.name).suffix.lower()

    @property
    def is_request(self) -> bool:
        """Whether it asks to have something looked at again."""
        return self.name.casefold().endswith(REQUEST)

    @property
    def place(self) -> str:
        """Where it lies in the download, for sentences."""
        return printable(str(self.file.path))
