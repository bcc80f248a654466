"""The text of an exercise file with the modules beside it that it imports, before any is run."""

import ast
import hashlib
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from ..exercise import ExerciseError

HOME = Path(__file__).resolve().parents[1]
"""Files in here belong to this package and use relative imports."""
_DEFINES_EXERCISE = re.compile(rb"^EXERCISE\b", re.MULTILINE)


@dataclass(frozen=True)
class Source:
    """A file as it was read, with the texts of the modules beside it that it imports, by name.

    Those that these import in turn are among them.
    """

    path: Path
    text: bytes
    beside: Mapping[str, bytes]

    @property
    def hash(self) -> str:
        """Of all of these texts; without modules beside it, of the file's own."""
        own = hashlib.sha256(self.text).hexdigest()
        if not self.beside:
            return own
        lines = [own]
        for name, other in sorted(self.beside.items()):
            digest = hashlib.sha256(other).hexdigest()
            lines.append(f"{name} {digest}")
        return hashlib.sha256("\n".join(lines).encode()).hexdigest()

    def neighbour(self, name: str) -> "Source":
        """One of the modules beside it, with those that it imports in turn."""
        text = self.beside[name]
        return Source(self.path.with_name(f"{name}.py"), text, _reached(text, self.beside.get))


def read_source(path: Path) -> Source:
    """A file of a course with its neighbours, or one of ours without.

    Raises:
        ExerciseError: a file cannot be read.
    """
    try:
        text = path.read_bytes()
        beside: dict[str, bytes] = {}
        if not is_ours(path):
            beside = _reached(text, partial(_beside, path))
    except OSError as error:
        where = error.filename or path
        raise ExerciseError(
            f"{where}: the exercise file cannot be read: {error.strerror}"
        ) from error
    return Source(path, text, beside)


def defines_exercise(path: Path) -> bool:
    """Whether a file has a line that starts with EXERCISE; it is not run to find out."""
    return _is_exercise(path.read_bytes())


def is_ours(path: Path) -> bool:
    """Whether a file lies in this package, in whatever folder of it."""
    return path.resolve().is_relative_to(HOME)


def imported(text: bytes, *, dots: bool) -> Iterator[str]:
    """Names without a dot that a text imports, anywhere in it.

    With `dots`, those that it imports relatively; without, all others.
    """
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):  # running it says what is wrong
        return
    for node in ast.walk(tree):
        for name in _names_in(node, dots=dots):
            if "." not in name:
                yield name


def _names_in(node: ast.AST, *, dots: bool) -> list[str]:
    """The modules that an import statement may name; none of anything else."""
    if isinstance(node, ast.Import) and not dots:
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom) and bool(node.level) is dots:
        if node.module:
            return [node.module]
        return [alias.name for alias in node.names]  # from . import a
    return []


def _is_exercise(text: bytes) -> bool:
    return _DEFINES_EXERCISE.search(text.replace(b"\r", b"\n")) is not None


def _beside(path: Path, name: str) -> bytes | None:
    """The text of the module of that name beside a file; None where none is, or an exercise."""
    module = path.with_name(f"{name}.py")
    if module == path or not module.is_file():
        return None
    text = module.read_bytes()
    if _is_exercise(text):
        return None
    return text


def _reached(text: bytes, look: Callable[[str], bytes | None]) -> dict[str, bytes]:
    """The modules that a text imports, those that they import, and so on, as `look` finds them."""
    found: dict[str, bytes] = {}
    waiting = [text]
    while waiting:
        for name in imported(waiting.pop(), dots=False):
            if name in found:
                continue
            other = look(name)
            if other is not None:
                found[name] = other
                waiting.append(other)
    return found
