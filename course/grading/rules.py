"""What marks follow from besides the answers, as a hash: an exercise, and all that marks it."""

import hashlib
import re
from collections.abc import Iterable
from functools import cache, lru_cache
from pathlib import Path

from ...exercises.files.neighbours import HOME, is_ours, read_source
from ...grader.collecting import collect
from ...grader.marking import mark
from ..sheet import submissions

ROOT = HOME.parent  # the four packages stand beside each other, in a checkout as in a wheel
FOLLOWED = ("solutions", "exercises", "grader")  # course writes pages and files, but for this:
MARKING = (
    Path(mark.__file__).resolve(),
    Path(submissions.__file__).resolve(),
    Path(collect.RUN).resolve(),  # started by path, never imported
)
IMPORT = re.compile(
    r"(?:^|[:;])[ \t]*"
    r"(?:from[ \t]+([.\w]+)[ \t]+import[ \t]+(\([^)]*\)|[^\n;]*)|import[ \t]+([^\n;]*))",
    re.MULTILINE,
)
WORD = re.compile(r"[\w.]+")


def rules_hash(path: Path) -> str:
    """A hash of an exercise file, the modules beside it, and what these or marking import of ours.

    Raises:
        ExerciseError: a file of the exercise cannot be read.
    """
    source = read_source(path)
    # A course's file is loaded as one of the catalogue, so that a copy of ours keeps its imports.
    folder = HOME / "catalogue"
    if is_ours(path):
        folder = path.resolve().parent
    names = [_name(file) for file in MARKING]
    for text in (source.text, *source.beside.values()):
        names += imports(text, _name(folder))

    lines = [source.hash]
    for name, text in sorted(reached(names).items()):
        lines.append(f"{name} {hashlib.sha256(text).hexdigest()}")
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


def reached(names: Iterable[str]) -> dict[str, bytes]:
    """The texts, by name, of those that are modules of ours, of what these import, and so on."""
    known = _modules()
    found: dict[str, bytes] = {}
    waiting = [*names]
    while waiting:
        name = waiting.pop()
        if name in known and name not in found:
            found[name] = known[name].read_bytes()
            waiting += imports(found[name], _name(known[name].parent))
    return found


@cache
def _modules() -> dict[str, Path]:
    files = [*MARKING]
    for package in FOLLOWED:
        files += (ROOT / package).rglob("*.py")
    return {_name(file): file for file in files}


def _name(place: Path) -> str:
    """The name of a module's file, or of a package's folder."""
    inner = place.relative_to(ROOT).with_suffix("").parts
    return ".".join(("kinegrade", *inner)).removesuffix(".__init__")


@lru_cache(maxsize=1024)
def imports(text: bytes, package: str) -> tuple[str, ...]:
    """What a text in a package may import, anywhere in it, with the packages on the way to each.

    Statements are looked for as text: to parse a hundred files takes longer than to mark a student.
    So there are more names than modules, such as those of functions; a test finds every import of
    ours among them.
    """
    found: dict[str, None] = {}  # a set that keeps the order
    joined = text.decode(errors="replace").replace("\\\n", " ")
    for start, named, plain in IMPORT.findall(joined):
        before = start
        if start.strip("."):  # `from a import b` names a.b, but `from . import b` names .b
            before = f"{start}."
        for name in WORD.findall(named or plain):
            full = _in_full(before + name, package)
            found |= dict.fromkeys(_on_the_way(full))
    return tuple(found)


def _in_full(name: str, package: str) -> str:
    """A name that may begin with dots, which mean the package and those around it."""
    inner = name.lstrip(".")
    dots = len(name) - len(inner)
    if not dots:
        return name
    outer = package.split(".")
    return ".".join([*outer[: len(outer) + 1 - dots], inner])


def _on_the_way(name: str) -> list[str]:
    """kinegrade.a.b for kinegrade.a.b.c, too: a package is run before what is in it."""
    parts = name.split(".")
    return [".".join(parts[:end]) for end in range(2, len(parts) + 1)]
