"""The exercise files that a student has: those of the catalogue, and a course's own beside them."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from ...exercises.exercise import Exercise
from ...exercises.files.finding import exercise_files, find
from ...exercises.files.neighbours import is_ours
from ..settings.config import CourseError


def exercise_folders(path: Path, exercises: Path | None) -> list[Path]:
    """Where a course's own exercises are: the folder that is named, else those of `own_folders`.

    Raises:
        CourseError: what is named is no folder.
    """
    if exercises is None:
        return own_folders(path)
    if not exercises.is_dir():
        raise CourseError(
            f"{exercises} is no folder; --exercises takes the one with the course's exercise files"
        )
    return [exercises]


def installed(names: Iterable[str], folders: Sequence[Path]) -> tuple[list[Exercise], list[str]]:
    """Of the exercises of a sheet those whose files are here, and the names of the others."""
    files = exercise_files(*folders)
    here: list[Exercise] = []
    missing: list[str] = []
    for slug in names:
        if slug in files:
            here.append(find(slug, files))
        else:
            missing.append(slug)
    return here, missing


def none_installed(names: Iterable[str], folders: Sequence[Path]) -> str:
    """What to say where that is none of them."""
    looked = "nor is there a folder exercises/"
    if folders:
        looked = f"nor in {' or '.join(map(str, folders))}"
    return (
        f"none of its exercises is installed here: {', '.join(names)}; {looked} "
        "(--exercises DIR, if you were given exercise files)"
    )


def own_folders(path: Path) -> list[Path]:
    """Folders of exercise files that this machine's owner made: beside the notebook, and here.

    What lies in a course's submitted/ came from somebody else and is not run.
    """
    found: dict[Path, Path] = {}
    for place in (path.parent, Path()):
        folder = place / "exercises"
        real = folder.resolve()
        if real.is_dir() and not is_ours(real) and not _is_handed_in(place):
            found[real] = folder
    return list(found.values())


def _is_handed_in(place: Path) -> bool:
    folder = place.resolve()
    for outer in (folder, *folder.parents):
        if outer.name == "submitted" and (outer.parent / "course.toml").exists():
            return True
    return False
