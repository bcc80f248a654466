"""Which packages a notebook can import: a few with all that they need, and nothing beside them."""

import os
import re
import subprocess
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from importlib.util import cache_from_source, find_spec
from pathlib import Path

ALWAYS = ("numpy", "sympy", "matplotlib", "scipy", "ipython")
OURS = "kinegrade"
NAME = re.compile(r"[\w.-]+")


@cache
def importable(also: tuple[str, ...] = ()) -> dict[str, Path]:
    """Files and folders of those packages that are installed, by the name to import them by.

    Also theirs that go with them, such as the libraries beside numpy.
    """
    found: dict[str, Path] = {}
    for name in _with_requirements([*ALWAYS, *also]):
        found |= _top_level(distribution(name))
    return found


def is_importable(name: str, also: tuple[str, ...] = ()) -> bool:
    """Whether a notebook can import a module of this name, be it of the standard library."""
    top = name.partition(".")[0]
    if top in sys.stdlib_module_names:
        return find_spec(top) is not None
    return top in {file.partition(".")[0] for file in importable(also)}


def not_installed(names: Iterable[str]) -> list[str]:
    """Those of some packages that are not here."""
    return [name for name in names if not _is_installed(name)]


def _is_installed(name: str) -> bool:
    try:
        distribution(name)
    except PackageNotFoundError:
        return False
    return True


def _with_requirements(names: list[str]) -> Iterator[str]:
    """Names of installed distributions, and of what they require, each once; never our own."""
    seen = {OURS}
    waiting = list(names)
    while waiting:
        name = waiting.pop().lower().replace("_", "-")
        if name in seen or not _is_installed(name):
            continue
        seen.add(name)
        yield name
        for requirement in distribution(name).requires or ():
            stated, _, condition = requirement.partition(";")
            if "extra" not in condition:
                waiting += NAME.findall(stated)[:1]


def _top_level(found: Distribution) -> dict[str, Path]:
    """What a distribution put into its folder, without its metadata."""
    tops: dict[str, Path] = {}
    # Every line begins with the path of a file; to make thousands of paths takes a second.
    lines = (found.read_text("RECORD") or "").splitlines()
    for name in {line.partition("/")[0].partition(",")[0] for line in lines}:
        if name in ("..", "__pycache__") or name.endswith((".dist-info", ".pth")):
            continue
        path = Path(str(found.locate_file(name)))
        if path.exists():
            tops[name] = path.resolve()
    return tops or _found_by_import(found)


def _found_by_import(found: Distribution) -> dict[str, Path]:
    """Where Python itself finds it: a system's package has no list of files."""
    stated = found.read_text("top_level.txt") or found.metadata["Name"].replace("-", "_")
    tops: dict[str, Path] = {}
    for name in stated.split():
        spec = find_spec(name)
        if spec is None or spec.origin is None:
            continue
        path = Path(spec.origin)
        if path.name == "__init__.py":
            path = path.parent
        tops[path.name] = path.resolve()
    return tops


@cache
def compiled(modules: tuple[str, ...]) -> None:
    """Has Python keep the compiled form of modules, where an installer left that to the first use.

    Behind read-only walls nobody could keep it, and every start would take seven seconds longer.
    """
    missing: list[str] = []
    for name in modules:
        top = importable().get(name.partition(".")[0])
        if top is None or not (top / "__init__.py").exists():
            continue
        cache = Path(cache_from_source(str(top / "__init__.py")))
        if not cache.exists() and os.access(top, os.W_OK):
            missing.append(name)
    if missing:
        code = f"import {', '.join(missing)}"
        subprocess.run(  # noqa: S603 - our own modules, as any import of them would
            [sys.executable, "-c", code], check=False, capture_output=True
        )


def interpreter() -> Path:
    """The interpreter itself, not the link to it in a virtual environment."""
    return Path(sys.executable).resolve()
