"""Entries of a zip that somebody else made: where they lie, and what may hurt about them."""

import re
import stat
import zlib
from lzma import LZMAError
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipInfo

DRIVE = re.compile(r"[A-Za-z]:")
ENCRYPTED = 1
DAMAGED = (
    BadZipFile, zlib.error, LZMAError, NotImplementedError, RuntimeError, EOFError, ValueError,
    OSError,
)  # fmt: skip
"""What zipfile raises on damaged archives, and on ways of packing that it does not know."""


def entry_name(info: ZipInfo) -> str:
    """The path of an entry; some systems write backslashes."""
    return info.filename.replace("\\", "/")


def objection(info: ZipInfo) -> str:
    """Why an entry is not to be read, or written anywhere; empty where it may be."""
    return _objection_to_place(entry_name(info)) or _objection_to_content(info)


def _objection_to_place(name: str) -> str:
    if name.startswith("/") or DRIVE.match(name):
        return "has an absolute path"
    if ".." in name.split("/"):
        return "leads out of its folder"
    if not name.strip("./"):
        return "has no name"
    return ""


def _objection_to_content(info: ZipInfo) -> str:
    if stat.S_IFMT(info.external_attr >> 16) not in (0, stat.S_IFREG):
        return "is a link, or no file at all"
    if info.flag_bits & ENCRYPTED:
        return "is locked by a password"
    if info.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
        return "is packed in a way that is not read here"
    return ""
