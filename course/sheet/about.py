"""What a handed-out file says of itself: which sheet, whose, and its numbers."""

import json
import re
from collections import deque
from itertools import islice
from typing import Any

KEY = "kinegrade"
"""What a notebook says of itself stands under this key of its metadata; in a script, behind it."""
LINE = re.compile(rf"^# {KEY}: (\{{.*\}})\s*$".encode(), re.MULTILINE)
ENTRY = re.compile(rf'"{KEY}"\s*:\s*(\{{)'.encode())
MAX_READ = 25 << 20
MAX_ABOUT = 1 << 18  # bytes of what a file says of itself
MAX_ENTRIES = 20  # places that look like it
NOTEBOOK = ".ipynb"
SCRIPT = ".py"
REQUEST = ".request.txt"
"""How the files end in which students ask to have something looked at again."""


def about_line(about: dict[str, Any]) -> str:
    """The comment of a script that says what a notebook's metadata say."""
    return f"# {KEY}: {json.dumps(about, sort_keys=True)}"


def read_about(data: bytes, ending: str) -> Any:
    """What a file says of itself.

    Raises:
        ValueError, KeyError, TypeError, RecursionError: it says nothing, or is damaged.
    """
    if ending != SCRIPT:
        return json.loads(data)["metadata"][KEY]
    said = LINE.findall(data)
    if not said:
        raise KeyError(KEY)
    return json.loads(said[-1])


def whose(data: bytes, ending: str) -> tuple[str, str]:
    """Sheet and student of a handed-out notebook or script; empty where it does not say."""
    if ending not in (NOTEBOOK, SCRIPT) or len(data) > MAX_READ:
        return "", ""
    found = islice(ENTRY.finditer(data), MAX_ENTRIES)
    if ending == SCRIPT:
        found = deque(LINE.finditer(data), maxlen=1)  # the last one, as `read_about` has it
    for entry in found:
        about = _object_at(data, entry.start(1))
        if "sheet" in about and "student" in about:
            return str(about["sheet"]), str(about["student"])
    return "", ""


def _object_at(data: bytes, start: int) -> dict[str, Any]:
    """The JSON object that begins there; empty where none does.

    A notebook is not read as a whole: a few bytes of an archive can unpack to one that fills the
    memory.
    """
    text = data[start : start + MAX_ABOUT].decode(errors="replace")
    try:
        about, _ = json.JSONDecoder().raw_decode(text)
    except (ValueError, RecursionError):
        return {}
    return about
