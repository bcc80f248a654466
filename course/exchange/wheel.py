"""The Kinegrade that runs here as a wheel, for machines that have none."""

import base64
import hashlib
from importlib.metadata import distribution
from importlib.util import find_spec
from pathlib import Path

from ..errors import CourseError
from .packing import packed

PROJECT = "kinegrade"
PACKAGES = ("", ".course", ".exercises", ".grader", ".solutions")
TAG = "py3-none-any"
WHEEL = f"Wheel-Version: 1.0\nGenerator: {PROJECT}\nRoot-Is-Purelib: true\nTag: {TAG}\n"
TEXTS = {"METADATA": ("METADATA", "PKG-INFO"), "entry_points.txt": ("entry_points.txt",)}
"""A file of a wheel, and what it is called where it is installed, or beside a checkout."""


def wheel() -> tuple[str, bytes]:
    """Name and bytes of a wheel of what is installed, also of an editable checkout.

    Raises:
        CourseError: the files of a package cannot be found, as in a frozen program.
    """
    installed = distribution(PROJECT)
    start = f"{PROJECT}-{installed.version}"
    contents: dict[str, bytes] = {}
    for package in PACKAGES:
        contents |= _files(f"{PROJECT}{package}")
    info = f"{start}.dist-info"
    for name, there in TEXTS.items():
        texts = filter(None, map(installed.read_text, there))
        contents[f"{info}/{name}"] = next(texts, "").encode()
    contents[f"{info}/WHEEL"] = WHEEL.encode()
    contents[f"{info}/RECORD"] = _record(contents, f"{info}/RECORD").encode()
    return f"{start}-{TAG}.whl", packed(contents)


def _files(package: str) -> dict[str, bytes]:
    spec = find_spec(package)
    if spec is None or not spec.submodule_search_locations:
        raise CourseError(f"the files of {package} are not to be found here")
    folder = Path(spec.submodule_search_locations[0])
    found: dict[str, bytes] = {}
    for path in sorted(folder.rglob("*")):
        inside = path.relative_to(folder)
        hidden = any(part.startswith((".", "__pycache__")) for part in inside.parts)
        if path.is_file() and not hidden:
            found[f"{package.replace('.', '/')}/{inside.as_posix()}"] = path.read_bytes()
    return found


def _record(contents: dict[str, bytes], own: str) -> str:
    """What a wheel says of its files: hash and size of each but this one."""
    lines: list[str] = []
    for name, data in contents.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(data)}")
    return "\n".join([*lines, f"{own},,", ""])
