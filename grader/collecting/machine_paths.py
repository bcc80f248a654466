"""Paths of the marking machine, taken out of what a student is told."""

import re

PATH = re.compile(
    r"(?<![\w./~)\]])/(?:[\w.+~-]+/)+([\w.+~-]*)|(?<!\w)[A-Za-z]:\\(?:[^\\\s'\"]+\\)+([^\\\s'\"]*)"
)


def without_paths(said: str) -> str:
    """A sentence in which of every absolute path the last name is left: …/data.csv."""
    return PATH.sub(_last_name, said)


def _last_name(match: re.Match[str]) -> str:
    return f"…/{match[1] or match[2] or ''}"
