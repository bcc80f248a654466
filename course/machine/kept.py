"""What was found out once and need not be again, in this user's cache; it may be lost any time."""

import hashlib
import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

from .files import write_atomically


def cache_folder() -> Path:
    """Where we keep things for all courses of this machine's user."""
    usual = "~/.cache"
    if sys.platform == "darwin":
        usual = "~/Library/Caches"
    chosen = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA") or usual
    return Path(chosen).expanduser() / "kinegrade"


def kept(kind: str, course: Path, name: str) -> dict[str, Any]:
    """What is known of something of a course; nothing where it was lost or cannot be read."""
    try:
        found = json.loads(_place(kind, course, name).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    if not isinstance(found, dict):
        return {}
    return cast("dict[str, Any]", found)


def keep(kind: str, course: Path, name: str, known: Mapping[str, Any]) -> None:
    """Keeps what is known, in the place of what was."""
    try:
        write_atomically(_place(kind, course, name), json.dumps(known), mode=0o600)
    except OSError:  # a home that cannot be written to: found out again next time
        return


def _place(kind: str, course: Path, name: str) -> Path:
    whose = hashlib.sha256(str(course.resolve()).encode(errors="replace")).hexdigest()[:16]
    return cache_folder() / kind / f"{whose}-{name}.json"
