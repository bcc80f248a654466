"""Finding exercise files, ours and a course's own."""

from pathlib import Path

from ...solutions.errors import did_you_mean
from ..exercise import Exercise, ExerciseError
from .loading import EXERCISE_WANTED, load
from .neighbours import defines_exercise

__all__ = ["defines_exercise", "exercise_files", "find", "load"]

CATALOGUE = Path(__file__).resolve().parents[1] / "catalogue"


def exercise_files(*folders: Path) -> dict[str, Path]:
    """Slug to file, for ours and for those in `folders`.

    A course's file replaces ours of the same name.

    Raises:
        ExerciseError: a file cannot be read.
    """
    found: dict[str, Path] = {}
    for folder in (CATALOGUE, *folders):
        found |= own_files(folder)
    return found


def own_files(folder: Path) -> dict[str, Path]:
    """Slug to file, for the exercises in one folder.

    Raises:
        ExerciseError: a file cannot be read.
    """
    found: dict[str, Path] = {}
    for path in sorted(folder.glob("*.py")):
        try:
            if defines_exercise(path):
                found[path.stem] = path
        except OSError as error:
            raise ExerciseError(
                f"{path}: the exercise file cannot be read: {error.strerror}"
            ) from error
    return found


def find(slug: str, files: dict[str, Path], *folders: Path) -> Exercise:
    """The exercise of that slug.

    `folders` are where a file of that name may lie that defines no exercise.

    Raises:
        ExerciseError: there is none, and the sentence names the nearest and all others; or its file
            cannot be loaded.
    """
    if slug in files:
        return load(files[slug])
    for folder in folders:
        if (folder / f"{slug}.py").is_file():
            raise ExerciseError(f"{folder / slug}.py defines no exercise: {EXERCISE_WANTED}")

    known = f"known: {', '.join(sorted(files))}"
    near = did_you_mean(slug, files)
    if near:
        known = f"{near} {known}"
    raise ExerciseError(f"there is no exercise {slug!r}; {known}")
