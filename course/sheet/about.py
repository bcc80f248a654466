"""What a handed-out file says of itself: which sheet, whose, and its numbers."""

import json
import re
from typing import Any, cast

KEY = "kinegrade"
"""What a notebook says of itself stands under this key of its metadata; in a script, behind it."""
LINE = re.compile(rf"^# {KEY}: (\{{.*\}})\s*$".encode(), re.MULTILINE)
MAX_READ = 25 << 20
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
    try:
        about: Any = read_about(data, ending)
    except (ValueError, KeyError, TypeError, RecursionError):
        return "", ""
    if not isinstance(about, dict):
        return "", ""
    said = cast("dict[str, Any]", about)
    return str(said.get("sheet", "")), str(said.get("student", ""))
