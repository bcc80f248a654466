"""The page of the robots that a course asks about: their maps, drawn once and kept."""

import hashlib
import logging
from collections.abc import Iterable
from dataclasses import fields
from functools import cache
from importlib.metadata import version
from pathlib import Path

from ...solutions.robot import Robot
from ...solutions.robots import robot
from ..grading.rules import reached
from ..machine.files import write_atomically
from ..machine.kept import cache_folder
from .page import template, write_page

log = logging.getLogger(__name__)
LOST = "The map of this robot could not be drawn; nothing else depends on it."
DRAWS = "kinegrade.grader.figures.maps"
"""What the maps are drawn by, with all that it imports."""


def write_maps(folder: Path, title: str, robots: Iterable[str]) -> str:
    """report/robots.html with a map, or a sentence, for each robot; its name, empty without any."""
    figures: list[dict[str, str]] = []
    for name in sorted(robots):
        try:
            figures.append(_figure(folder, name))
        except Exception:  # a report does not wait for a picture
            log.exception("the map of %s is left out of the report", name)
            figures.append({"file": "", "title": name, "alt": LOST})
    if not figures:
        return ""
    html = template("robots.html").render(course=title, figures=figures)
    write_page(folder / "robots.html", html)
    return "robots.html"


def _figure(folder: Path, name: str) -> dict[str, str]:
    """The map of a robot beside the page, its title and its description."""
    arm = robot(name)
    file = f"{name}-{_key(arm)}.png"
    image, text = folder / file, (folder / file).with_suffix(".txt")
    if not image.exists() or not text.exists():
        for old in folder.glob(f"{name}-????????????.*"):
            old.unlink()
        kept = _kept(arm, file)
        write_atomically(image, kept[0])
        write_atomically(text, kept[1])
    return {"file": file, "title": arm.title, "alt": text.read_text(encoding="utf-8")}


def map_of(name: str) -> tuple[bytes, str]:
    """The map of a robot of the catalogue as PNG, and its description; drawn once and kept."""
    arm = robot(name)
    return _kept(arm, f"{name}-{_key(arm)}.png")


def _kept(arm: Robot, file: str) -> tuple[bytes, str]:
    """A map and its description, from this machine's cache or drawn and put there."""
    place = cache_folder() / "maps" / file
    try:
        return place.read_bytes(), place.with_suffix(".txt").read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        pass
    from ...grader.figures.maps import describe, picture

    image, text = picture(arm, ".png"), describe(arm)
    try:
        write_atomically(place, image)
        write_atomically(place.with_suffix(".txt"), text)
    except OSError:  # a home that cannot be written to: drawn again next time
        return image, text
    return image, text


def _key(arm: Robot) -> str:
    """A short name of what is drawn and of what draws it, so that nothing old is shown."""
    data = [getattr(arm, field.name) for field in fields(arm)]  # not what is cached beside it
    drawn = f"{_drawing_code()} {data}"
    return hashlib.sha256(drawn.encode()).hexdigest()[:12]


@cache
def _drawing_code() -> str:
    """A hash of all modules that draw a map, and of the library they draw with."""
    digest = hashlib.sha256(version("matplotlib").encode())
    for _, text in sorted(reached([DRAWS]).items()):
        digest.update(text)
    return digest.hexdigest()
