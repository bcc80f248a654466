"""Zip files for other systems: the same bytes on every run, written whole or not at all."""

import io
from collections.abc import Mapping
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from ..machine.files import write_atomically

TIME = (1980, 1, 1, 0, 0, 0)
FILE = 0o644
PROGRAM = 0o755


def packed(files: Mapping[str, bytes], programs: frozenset[str] = frozenset()) -> bytes:
    """A zip of these files, in the order of their names; those of `programs` may be run."""
    out = io.BytesIO()
    with ZipFile(out, "w", ZIP_DEFLATED) as archive:
        for name in sorted(files):
            info = ZipInfo(name, TIME)
            info.create_system = 3  # where rights of files mean something
            info.external_attr = (PROGRAM if name in programs else FILE) << 16
            info.compress_type = ZIP_DEFLATED
            archive.writestr(info, files[name])
    return out.getvalue()


def write_zip(path: Path, files: Mapping[str, bytes]) -> Path:
    """The zip as a file; its path."""
    write_atomically(path, packed(files))
    return path
