"""The code of a student's variant, as it stands on every page of a PDF and is read back from it."""

import hashlib
from collections.abc import Sequence

from .record import Record, canonical

ALPHABET = "0123456789ABCDEFGHJKMNPQRSTVWXYZ"
"""Without I, L, O and U, which are misread."""
MISREAD = str.maketrans({"I": "1", "L": "1", "O": "0", "U": "V", "-": "", " ": ""})
LENGTH = 8  # of 5 bits each: no two of a class, and no slip of the pen, give the same


def variant_code(records: Sequence[Record]) -> str:
    """The code of what was drawn for one student's sheet, such as K7M3-QXB9.

    It follows from the records alone, in whatever order, and tells nothing of the numbers.
    """
    drawn = sorted((one.exercise, one.attempt, canonical(one.numbers)) for one in records)
    whose = sorted({(one.student, one.sheet) for one in records})
    number = int.from_bytes(hashlib.sha256(canonical([whose, drawn]).encode()).digest(), "big")
    letters = ""
    for _ in range(LENGTH):
        number, place = divmod(number, len(ALPHABET))
        letters += ALPHABET[place]
    return f"{letters[:4]}-{letters[4:]}"


def variant_codes(records: Sequence[Record]) -> dict[str, str]:
    """The code of every student who has records of a sheet."""
    of_student: dict[str, list[Record]] = {}
    for record in records:
        of_student.setdefault(record.student, []).append(record)
    return {student: variant_code(these) for student, these in of_student.items()}


def read_code(typed: str) -> str:
    """A code as somebody types it off a page: in small letters, without its hyphen, O for 0.

    Empty where it is none.
    """
    letters = typed.strip().upper().translate(MISREAD)
    if len(letters) != LENGTH or set(letters) - set(ALPHABET):
        return ""
    return f"{letters[:4]}-{letters[4:]}"
