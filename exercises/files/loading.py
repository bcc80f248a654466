"""Loading an exercise file, with the modules beside it that it imports.

Its name as a module follows from its text. A course's exercises may share code: `from arms import
planar` finds arms.py in the same folder, as an editor does. Such a module is known to the files
that import it and to nobody else, so that two courses may each have an arms.py.
"""

import builtins
import hashlib
import sys
from importlib.abc import SourceLoader
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from threading import RLock
from types import ModuleType, TracebackType
from typing import Any

from ...solutions.errors import KinegradeError, nearest
from ..exercise import Exercise, ExerciseError
from .neighbours import HOME, Source, imported, is_ours, read_source

LONGEST = 300  # characters of an exception that are repeated
EXERCISE_WANTED = "an exercise file takes a top-level EXERCISE = exercise(...)"
_LOADING = RLock()  # nobody gets a module that another thread has run half of


def load(path: Path) -> Exercise:
    """The exercise that a file defines as `EXERCISE`.

    It is loaded once per content of the file and of the modules beside it.

    Raises:
        ExerciseError: the file cannot be read or run, defines no exercise, or its slug is not its
            file name.
    """
    return load_source(read_source(path))


def load_source(source: Source) -> Exercise:
    """The exercise of a file as it was read, here or on another machine.

    Raises:
        ExerciseError: as `load`.
    """
    path = source.path
    if path.suffix != ".py":
        raise ExerciseError(f"{path}: an exercise file takes the ending .py")
    try:
        module = _module(source)
    except (Exception, SystemExit) as error:
        raise ExerciseError(_why(error, source)) from error
    exercise: Any = getattr(module, "EXERCISE", None)
    if not isinstance(exercise, Exercise):
        raise ExerciseError(f"{path}: {EXERCISE_WANTED}{_instead(module)}")
    if exercise.slug != path.stem:
        raise ExerciseError(
            f"{path}: the slug is {exercise.slug!r}; it takes the file's name, {path.stem!r}"
        )
    return exercise


def stopped(error: BaseException) -> str:
    """An exception in one line, with its place in the exercise file or in a module beside it."""
    said = str(error)
    if isinstance(error, SyntaxError):  # whose text names the place, too
        said = error.msg
    said = " ".join(said.split())[:LONGEST]

    told = type(error).__name__
    if said:
        told += f": {said}"
    return told + _at(error)


def _at(error: BaseException) -> str:
    """The place of an exception in brackets, where it has one."""
    where = place(error)
    if not where:
        return ""
    return f" ({where})"


def place(error: BaseException) -> str:
    """The last line of an exercise file, or of a module beside one, that an exception went through.

    Empty where it went through none.
    """
    if isinstance(error, SyntaxError) and error.filename and error.lineno:
        return f"line {error.lineno} of {Path(error.filename).name}"
    found = ""
    step: TracebackType | None = error.__traceback__
    while step is not None:
        loader: Any = step.tb_frame.f_globals.get("__loader__")
        if isinstance(loader, _SourceLoader):
            found = f"line {step.tb_lineno} of {loader.source.path.name}"
        step = step.tb_next
    return found


def _module(source: Source) -> ModuleType:
    """The module of a file, run unless it has been.

    Its folder is in its name, since it may read data beside it.
    """
    identity = hashlib.sha256(f"{source.hash} {source.path.resolve()}".encode()).hexdigest()
    name = f"{_package_of(source.path)}.file_{identity[:16]}"
    with _LOADING:
        if name in sys.modules:
            return sys.modules[name]
        loader = _SourceLoader(source)
        spec = spec_from_file_location(name, source.path, loader=loader)
        assert spec is not None  # noqa: S101 - a loader was given
        module = module_from_spec(spec)
        sys.modules[name] = module  # dataclasses look their module up there
        try:
            loader.exec_module(module)
        except BaseException:
            del sys.modules[name]
            raise
        return module


def _package_of(path: Path) -> str:
    """The package whose modules a file's relative imports mean.

    A file of ours has its own; any other is where a copy of one of our exercises keeps its imports.
    """
    if not is_ours(path):
        return "kinegrade.exercises.catalogue"
    inner = path.resolve().parent.relative_to(HOME).parts
    return ".".join(["kinegrade.exercises", *inner])


class _SourceLoader(SourceLoader):
    """Runs the text that was read and hashed, whatever the file holds by now.

    It leaves no compiled file behind.
    """

    def __init__(self, source: Source) -> None:
        """Takes the text, and the modules beside it that its own imports shall find."""
        self.source = source

    def get_filename(self, fullname: str) -> str:  # noqa: ARG002 - asked with the module's name
        """Where the text came from, for tracebacks and `inspect`."""
        return str(self.source.path)

    def get_data(self, path: str | bytes) -> bytes:  # noqa: ARG002 - asked with the file's name
        """The text, as it was read."""
        return self.source.text

    def exec_module(self, module: ModuleType) -> None:
        """Runs the text.

        Its imports look beside the file first, also those in functions that run later.
        """
        if self.source.beside:
            vars(module)["__builtins__"] = {**vars(builtins), "__import__": self._import}
        super().exec_module(module)

    def _import(
        self,
        name: str,
        globals_: Any = None,
        locals_: Any = None,
        fromlist: Any = (),
        level: int = 0,
    ) -> ModuleType:
        if level == 0 and name in self.source.beside:
            return _module(self.source.neighbour(name))
        return builtins.__import__(name, globals_, locals_, fromlist, level)


def _why(error: BaseException, source: Source) -> str:
    """A sentence for a file that could not be run."""
    if isinstance(error, KinegradeError):  # it is a sentence by itself
        return f"{source.path}: {error}{_at(error)}"
    sentence = f"{source.path}: the exercise file stopped with {stopped(error)}"
    if isinstance(error, ImportError) and not is_ours(source.path):
        sentence += _import_hint(error, source)
    return sentence


def _import_hint(error: ImportError, source: Source) -> str:
    """What may have been meant by an import that failed."""
    others = [other.stem for other in source.path.parent.glob("*.py") if other != source.path]
    for name in imported(source.text, dots=True):
        if name in others:
            return f"; a file beside it is imported without a dot: from {name} import ..."

    missing = error.name or ""
    if missing in others:
        return (
            f"; {missing}.py is an exercise, and what exercises share takes a file without EXERCISE"
        )
    near = nearest(missing, others)
    if near:
        return f"; did you mean {near!r}, which lies beside it?"
    return ""


def _instead(module: ModuleType) -> str:
    """What a file has where its EXERCISE should be."""
    if hasattr(module, "EXERCISE"):
        return f"; its EXERCISE is of type {type(module.EXERCISE).__name__}"
    for name, value in vars(module).items():
        if isinstance(value, Exercise):
            return f"; it calls its exercise {name!r}"
    return ""
