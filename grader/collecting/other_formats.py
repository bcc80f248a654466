"""Files that are something else than their ending says, named as what they are."""

from dataclasses import dataclass

LOOKED_AT = 64  # bytes, which tell text of two bytes a character
BOM_16 = (b"\xff\xfe", b"\xfe\xff")


@dataclass(frozen=True)
class OtherFormat:
    """What a file is, and what would be right."""

    name: str
    instead: str

    @property
    def sentence(self) -> str:
        """Both, as they stand behind the name of a file."""
        return f"the file is {self.name}, whatever its ending says; {self.instead}"


UNPACKED = "hand in the file that is inside of it"
UTF_16 = OtherFormat("UTF-16 text", "save it as UTF-8")
ZEROS = OtherFormat("nothing but zero bytes", "save it and hand it in again")
PICTURE = OtherFormat("a picture", "hand in the file itself")
STARTS = {
    b"PK\x03\x04": OtherFormat(
        "a zip archive (an Excel workbook is one, too)", f"{UNPACKED}, or save a workbook as CSV"
    ),
    b"PK\x05\x06": OtherFormat("an empty zip archive", UNPACKED),
    b"\x1f\x8b": OtherFormat("compressed with gzip", UNPACKED),
    b"BZh": OtherFormat("compressed with bzip2", UNPACKED),
    b"\xfd7zXZ\x00": OtherFormat("compressed with xz", UNPACKED),
    b"7z\xbc\xaf\x27\x1c": OtherFormat("a 7z archive", UNPACKED),
    b"Rar!": OtherFormat("a rar archive", UNPACKED),
    b"%PDF-": OtherFormat("a PDF", "save the data themselves"),
    b"\xd0\xcf\x11\xe0": OtherFormat("an old Office document", "save it as CSV"),
    b"\x89PNG": PICTURE,
    b"\xff\xd8\xff": PICTURE,
    b"GIF8": PICTURE,
}


def other_format(data: bytes) -> OtherFormat | None:
    """What a file is that should be text or a MATLAB file; None where it may be that."""
    for start, found in STARTS.items():
        if data.startswith(start):
            return found
    if data.startswith(BOM_16) or _has_two_bytes_a_letter(data):
        return UTF_16
    if data and not data.strip(b"\0"):
        return ZEROS
    return None


def _has_two_bytes_a_letter(data: bytes) -> bool:
    """Whether every other byte of the beginning is zero, and none of the others."""
    start = data[:LOOKED_AT]
    if len(start) < 4 or len(data) % 2:
        return False
    first, second = start[::2], start[1::2]
    for letters, zeros in ((first, second), (second, first)):
        if not any(zeros) and all(letters):
            return True
    return False
