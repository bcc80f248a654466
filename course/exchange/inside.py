"""What a notebook says of itself: whose sheet it is, and which."""

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, cast

from ..sheet.notebook import KEY

MOST = 16 << 20  # bytes that are parsed
HEADING = re.compile(r"sheet `([A-Za-z0-9._-]+)` · .*\(`([A-Za-z0-9._-]+)`\)")
"""How a released notebook begins, where a program dropped its metadata."""


@dataclass(frozen=True)
class Inside:
    """Whose sheet a file is by what stands in it; empty where it does not say."""

    student: str = ""
    sheet: str = ""


def inside(data: bytes) -> Inside:
    """What the metadata of a notebook say, else its heading."""
    if len(data) > MOST or data.lstrip()[:1] != b"{":
        return Inside()
    try:
        content: Any = json.loads(data)
    except (ValueError, RecursionError):
        return Inside()
    about = _mapping(_mapping(_mapping(content).get("metadata")).get(KEY))
    student, sheet = about.get("student"), about.get("sheet")
    if isinstance(student, str) and isinstance(sheet, str):
        return Inside(student, sheet)
    return _heading(_mapping(content).get("cells"))


def _heading(cells: Any) -> Inside:
    """What the first cell says in words."""
    if not isinstance(cells, list) or not cells:
        return Inside()
    source: Any = _mapping(cast("list[Any]", cells)[0]).get("source")
    text = str(source)
    if isinstance(source, list):
        text = "".join(map(str, cast("list[Any]", source)))
    found = HEADING.search(text)
    if found is None:
        return Inside()
    return Inside(sheet=found[1], student=found[2])


def _mapping(value: Any) -> Mapping[str, Any]:
    if isinstance(value, dict):
        return cast("Mapping[str, Any]", value)
    return {}
