"""Finding exercise files, ours and a course's own, and loading them from anywhere."""

import hashlib
import importlib.util
import re
import sys
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from ..exercise import Exercise, ExerciseError

_DEFINES_EXERCISE = re.compile(r"^EXERCISE\b", re.MULTILINE)


def load(path: Path) -> Exercise:
    """The exercise that a file defines as `EXERCISE`, loaded once per content.

    The module name is a hash of the content, so that files of the same name never meet; it lies inside this package,
    so that our own files keep their relative imports.

    Raises:
        ExerciseError: the file cannot be read or run, defines no exercise, or its slug is not its file name.
    """
    try:
        text = path.read_bytes()
    except OSError as error:
        raise ExerciseError(f"{path}: the exercise file cannot be read: {error.strerror}") from error
    name = f"{__package__}.file_{hashlib.sha256(text).hexdigest()[:16]}"
    exercise: Any = getattr(sys.modules.get(name), "EXERCISE", None) or getattr(_run(path, name), "EXERCISE", None)
    if not isinstance(exercise, Exercise):
        raise ExerciseError(f"{path}: an exercise file takes a top-level EXERCISE = Exercise(...)")
    if exercise.slug != path.stem:
        raise ExerciseError(f"{path}: the slug is {exercise.slug!r}; it takes the file's name, {path.stem!r}")
    return exercise


def _run(path: Path, name: str) -> Any:
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ExerciseError(f"{path}: an exercise file takes the ending .py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses look their module up there
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        raise ExerciseError(f"{path}: the exercise file stopped with {type(error).__name__}: {error}") from error
    return module


def defines_exercise(path: Path) -> bool:
    """Whether a file has a line that starts with EXERCISE; it is not run to find out."""
    return _DEFINES_EXERCISE.search(path.read_text(encoding="utf-8", errors="replace")) is not None


def exercise_files(*folders: Path) -> dict[str, Path]:
    """Slug to file, for ours and for those in `folders`; a course's file replaces ours of the same name."""
    found: dict[str, Path] = {}
    for folder in (Path(__file__).parent, *folders):
        for path in sorted(folder.glob("*.py")):
            if defines_exercise(path):
                found[path.stem] = path
    return found


def find(slug: str, files: dict[str, Path]) -> Exercise:
    """The exercise of that slug.

    Raises:
        ExerciseError: there is none; the sentence names the nearest and all others.
    """
    if slug not in files:
        near = get_close_matches(slug, files, 1)
        hint = f"did you mean {near[0]!r}? " if near else ""
        raise ExerciseError(f"there is no exercise {slug!r}; {hint}known: {', '.join(sorted(files))}")
    return load(files[slug])
