"""Several files of a student for one sheet: which of them counts, and which lie beside another."""

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from ..errors import CourseError
from .submissions import READERS, RUN
from .upload import Upload, mentions

MATLAB = ".m"
IMPORT = re.compile(rb"\b(?:from|import)\s+(\w+)")
LOOKED_THROUGH = 25 << 20  # bytes in which a notebook may name its files


@dataclass(frozen=True)
class Ages:
    """How new the files of a student for a sheet are."""

    folder: Path
    student: str
    sheet: str
    received: Mapping[tuple[str, str, str], datetime]

    def of(self, upload: Upload) -> tuple[Any, ...]:
        """What is larger for the file that counts.

        A sheet that is as it was handed out holds no answers, and a MATLAB script is not run: these
        count where there is nothing else. Then comes the time, in whole seconds, since files that
        are copied together have no order; then what stands first among the readers.
        """
        return (
            not self._is_untouched(upload),
            upload.ending != MATLAB,
            self._seconds(upload),
            upload.changed,
            -list(READERS).index(upload.ending) if upload.ending in READERS else 0,
            -len(upload.path.name),
        )

    def _seconds(self, upload: Upload) -> int:
        for name in (upload.handed_in.name, f"{upload.handed_in.parent.name}/{upload.path.name}"):
            time = self.received.get((self.student, self.sheet, name))
            if time is not None:
                return int(time.timestamp())
        try:
            return int(upload.handed_in.lstat().st_mtime)
        except OSError:
            return 0

    def _is_untouched(self, upload: Upload) -> bool:
        """Whether it is byte by byte what the student was handed out."""
        released = self.folder / "released" / self.student / f"{self.sheet}{upload.ending}"
        try:
            return released.stat().st_size == upload.size and released.read_bytes() == upload.data
        except (OSError, CourseError):
            return False


def newest(versions: Sequence[Upload], ages: Ages) -> Upload:
    """The one that counts."""
    if len(versions) == 1:
        return versions[0]
    return max(versions, key=ages.of)


def not_beside(meant: Sequence[Upload]) -> list[Upload]:
    """The files that are no data or module of another one, such as jacobian.csv that is read in."""
    taken: set[Path] = set()
    for run in meant:
        if run.ending in RUN:
            taken.update(one.path for one in _taken_by(run, meant))
    return [one for one in meant if one.path not in taken]


def _taken_by(run: Upload, meant: Sequence[Upload]) -> list[Upload]:
    """The files of the same folder that a notebook or script reads or imports."""
    near = [one for one in meant if one.path.parent == run.path.parent]
    others = [one for one in near if one.ending != run.ending]
    if not others:
        return []
    try:
        text = run.data[:LOOKED_THROUGH]
    except CourseError:
        return []
    imported = set(IMPORT.findall(text))
    taken: list[Upload] = []
    for other in others:
        if other.ending in RUN:
            read = os.fsencode(other.path.stem) in imported
        else:
            read = mentions(text, other.path.name)
        if read:
            taken.append(other)
    return taken
