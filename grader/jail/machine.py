"""What of this machine a notebook may read: the interpreter, and the libraries that it loads."""

import site
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from .packages import interpreter

INSIDE = Path(__file__).parents[1] / "inside"
OURS = Path(__file__).parents[2]  # where the four packages stand beside each other
LIBRARIES = ("/lib", "/lib64", "/usr/lib", "/usr/lib64", "/nix/store")
FONTS_AND_CLOCKS = ("/usr/share/fonts", "/usr/share/zoneinfo", "/etc/fonts", "/etc/localtime")
LINKER = ("/etc/ld.so.cache",)
DEVICES = ("/dev/null", "/dev/zero", "/dev/random", "/dev/urandom")
FOLDERS_OF_PACKAGES = ("site-packages", "dist-packages")


def readable() -> list[Path]:
    """Folders and files that the interpreter and its libraries stand in; some may be links."""
    home = Path(sys.base_prefix)
    wanted = [*map(Path, LIBRARIES), home / "lib", home / "lib64", interpreter()]
    wanted += map(Path, (*FONTS_AND_CLOCKS, *LINKER))
    found: list[Path] = []
    for path in wanted:
        if path.exists() and path not in found:
            found.append(path)
    return found


@cache
def hidden() -> tuple[Path, ...]:
    """Folders in those that hold more packages than a notebook may see, our own among them."""
    candidates = {OURS, *map(Path, site.getsitepackages())}
    for library in readable():
        for name in FOLDERS_OF_PACKAGES:
            candidates |= {*library.glob(f"python3*/{name}"), *library.glob(name)}
    inside: list[Path] = []
    for path in sorted(real for real in map(Path.resolve, candidates) if real.is_dir()):
        known = any(path.is_relative_to(outer) for outer in inside)
        if not known and any(path.is_relative_to(tree.resolve()) for tree in readable()):
            inside.append(path)
    return tuple(inside)


@cache
def readable_without_hidden() -> tuple[Path, ...]:
    """The same as trees that hold nothing hidden: a rule for a tree has no exceptions."""
    found: dict[Path, None] = {}
    for tree in readable():
        found |= dict.fromkeys(_without_hidden(tree.resolve()))
    return tuple(found)


def _without_hidden(tree: Path) -> Iterator[Path]:
    if tree in hidden():
        return
    if not any(path.is_relative_to(tree) for path in hidden()):
        yield tree
        return
    for child in tree.iterdir():
        yield from _without_hidden(child)
