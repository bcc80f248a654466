"""How a zygote is started at a level: its command, and what it is told about its surroundings."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .bubblewrap import PACKAGES, SCRATCH, walled, working
from .folders import new_folder
from .level import Level
from .machine import DEVICES, INSIDE, readable, readable_without_hidden
from .packages import importable, interpreter
from .syscalls import filter_code

OUTSIDE = "/etc/passwd"  # every machine has it, and no notebook has business with it
START = (
    "import sys; sys.path.append(sys.argv[2]); from {package}.start import main; "
    "main(int(sys.argv[1]))"
)


@dataclass(frozen=True)
class Surroundings:
    """What a zygote is started with.

    Attributes:
        command: The words of its command, without the descriptor of its socket.
        about: What its first message says.
        folder: A temporary folder that goes with it; empty where there is none.
    """

    command: tuple[str, ...]
    about: dict[str, Any] = field(default_factory=dict[str, Any])
    folder: str = ""

    @property
    def environment(self) -> dict[str, str]:
        """The environment of the zygote, and of every notebook."""
        scratch = self.about["scratch"]
        return {
            "PATH": "/usr/bin:/bin",
            "HOME": scratch,
            "TMPDIR": scratch,
            "LANG": "C.UTF-8",
            "MPLBACKEND": "Agg",
            "MPLCONFIGDIR": scratch,
            "PYTHONDONTWRITEBYTECODE": "1",
            "OPENBLAS_NUM_THREADS": "1",  # one thread starts faster and fits the memory limit
            "OMP_NUM_THREADS": "1",
        }

    @property
    def message(self) -> bytes:
        """The first message."""
        return json.dumps(self.about).encode()


def surroundings(level: Level, packages: tuple[str, ...], preload: Sequence[str]) -> Surroundings:
    """What a zygote of a level takes, with all folders made.

    Raises:
        NoFilterError: there is no libseccomp for a level that needs it.
        NoBubblewrapError: there is no bubblewrap for one that needs that.
    """
    about: dict[str, Any] = {
        "preload": [*preload],
        "confined": level is not Level.UNSAFE,
        "filter": "",
        "outside": OUTSIDE,
        "devices": [*DEVICES],
    }
    if about["confined"]:
        about["filter"] = filter_code().hex()
    if level is Level.STRONG:
        command = (*walled(working(), packages), *_python(PACKAGES))
        trees = {f"/{path.parts[1]}" for path in readable()} | {PACKAGES}
        places = {"packages": PACKAGES, "scratch": SCRATCH, "readable": [*trees], "folder": ""}
        return Surroundings(command, about | places)

    folder = _folder(packages)
    links = folder / "packages"
    trees = [*readable_without_hidden(), *importable(packages).values(), INSIDE, links]
    places = {
        "packages": str(links),
        "scratch": str(folder / "scratch"),
        "readable": [str(tree) for tree in trees],
        "folder": str(folder),
    }
    return Surroundings(_python(str(links)), about | places, str(folder))


def _python(packages: str) -> tuple[str, ...]:
    """The interpreter without anybody's settings; the descriptor is to be put in."""
    code = START.format(package=INSIDE.name)
    return (str(interpreter()), "-I", "-S", "-c", code, "{descriptor}", packages)


def _folder(packages: tuple[str, ...]) -> Path:
    """A folder with links to the packages, and another to write to."""
    folder = new_folder()
    (folder / "scratch").mkdir()
    links = folder / "packages"
    links.mkdir()
    for name, path in {**importable(packages), INSIDE.name: INSIDE}.items():
        (links / name).symlink_to(path)
    return folder
