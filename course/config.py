"""course.toml: read once, checked, with errors that point at the key."""

import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ..solutions.errors import did_you_mean
from .errors import CourseError
from .roster import DEVICE, SAFE_NAME, Student, read_roster
from .text_file import text_of

__all__ = [
    "Course",
    "CourseError",
    "Mode",
    "Settings",
    "Sheet",
    "Student",
    "hint",
    "read_course",
    "read_roster",
    "read_settings",
]

Mode = Literal["practice", "graded", "exam"]
Format = Literal["ipynb", "pdf"]
"""What a sheet and its worked solution are written as."""
SCRIPT_NAME = re.compile(r"[A-Za-z]\w{0,62}", re.ASCII)
MATLAB_WORD = re.compile(
    "break|case|catch|classdef|continue|else|elseif|end|for|function|global|if|"
    "otherwise|parfor|persistent|return|spmd|switch|try|while"
)
Name = Annotated[str, Field(pattern=rf"^{SAFE_NAME.pattern}$")]
Title = Annotated[str, Field(max_length=300)]
Share = Annotated[float, Field(strict=True, ge=0, le=1)]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Sheet(_Strict):
    """One hand-out: its exercises in order, and what a check may tell before the deadline.

    With `matlab` or `python`, students get a script to start from beside the notebook. With
    `show_solutions`, which is for after the deadline, the feedback holds the worked solution.
    `pinned` holds, by exercise, the choices of form that all students shall have alike, so that
    points mean the same for everybody.
    """

    name: Name
    title: Title = ""
    mode: Mode = "graded"
    matlab: bool = False
    python: bool = False
    show_solutions: bool = False
    exercises: Annotated[tuple[str, ...], Field(min_length=1, max_length=100)]
    pinned: Mapping[str, Mapping[str, Any]] = {}


class LimitsTable(_Strict):
    """What one notebook may use while it is marked."""

    cell_seconds: Annotated[float, Field(strict=True, gt=0, le=600)] = 30.0
    notebook_seconds: Annotated[float, Field(strict=True, gt=0, le=3600)] = 180.0
    memory_mb: Annotated[int, Field(strict=True, ge=256, le=65_536)] = 2048


class PackagesTable(_Strict):
    """Packages that notebooks may import besides numpy, sympy, matplotlib, scipy and IPython."""

    allow: tuple[Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$")], ...] = ()


class MarkingTable(_Strict):
    """What a mistake that has a name costs of its part: once, whatever the number of entries."""

    slip: Share = 0.25
    presentation: Share = 0.25
    concept: Share = 0.5


class GradebookTable(_Strict):
    """Where the gradebook lies, unless it is the file in the course folder."""

    url: Annotated[str, Field(pattern="^postgresql://")] | None = None


class Settings(_Strict):
    """All of course.toml."""

    title: Title
    # Of older courses; the secret has a file of its own.
    secret: Annotated[str, Field(min_length=16, max_length=1000)] | None = None
    sheet: Annotated[tuple[Sheet, ...], Field(min_length=1, max_length=200)]
    formats: Annotated[tuple[Format, ...], Field(min_length=1, max_length=2)] = ("ipynb",)
    limits: LimitsTable = LimitsTable()
    marking: MarkingTable = MarkingTable()
    gradebook: GradebookTable = GradebookTable()
    packages: PackagesTable = PackagesTable()


@dataclass(frozen=True)
class Course:
    """A course folder as it was read."""

    folder: Path
    settings: Settings
    students: tuple[Student, ...]

    def sheets(self, names: tuple[str, ...] = ()) -> tuple[Sheet, ...]:
        """The named sheets, or all.

        Raises:
            CourseError: a name is not that of a sheet.
        """
        if not names:
            return self.settings.sheet
        known = {sheet.name: sheet for sheet in self.settings.sheet}
        for name in names:
            if name not in known:
                raise CourseError(
                    f"there is no sheet {name!r}{hint(name, known)}; "
                    f"course.toml has: {', '.join(known)}"
                )
        return tuple(known[name] for name in names)


def read_course(folder: Path) -> Course:
    """The course in a folder.

    Raises:
        CourseError: a file is missing, unreadable, or says something that cannot be meant.
    """
    settings = read_settings(folder / "course.toml")
    return Course(folder, settings, tuple(read_roster(folder / "roster.csv")))


def read_settings(path: Path) -> Settings:
    """course.toml, with every key known and every value possible.

    Raises:
        CourseError: it is missing, unreadable, or says something that cannot be meant.
    """
    text = text_of(path, "a course folder takes a course.toml; `kinegrade init DIR` writes one")
    try:
        settings = Settings.model_validate(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise CourseError(f"{path}: not TOML: {error}") from error
    except ValidationError as error:
        raise CourseError(f"{path}: {_sentence(_telling(error))}") from error

    names = [sheet.name.casefold() for sheet in settings.sheet]
    for sheet in settings.sheet:
        if names.count(sheet.name.casefold()) > 1:
            raise CourseError(
                f"{path}: two sheets are called {sheet.name!r}; a sheet takes a name of its own"
            )
        _refuse_as_file_name(path, sheet)
    return settings


def _refuse_as_file_name(path: Path, sheet: Sheet) -> None:
    """Refuses names that no file can have, or no script where there is one."""
    if DEVICE.fullmatch(sheet.name):
        raise CourseError(
            f"{path}: a sheet cannot be called {sheet.name!r}: no file can, on Windows"
        )
    if not sheet.matlab:
        return
    if not SCRIPT_NAME.fullmatch(sheet.name) or MATLAB_WORD.fullmatch(sheet.name):
        raise CourseError(
            f"{path}: a sheet with matlab = true takes a name that MATLAB can run: "
            "letters, digits and '_', at most 63, starting with a letter, "
            f"and no word of its language; got {sheet.name!r}"
        )


def _telling(error: ValidationError) -> Any:
    """The first complaint about an unknown key, as a typo explains the rest, else the first."""
    found = error.errors()
    for one in found:
        if one["type"] == "extra_forbidden":
            return one
    return found[0]


def _sentence(complaint: Any) -> str:
    """What pydantic complains about, for people who write course.toml."""
    steps: list[str] = []
    for step in complaint["loc"]:
        if isinstance(step, int):
            step += 1  # noqa: PLW2901 - people count tables from 1
        steps.append(str(step))
    where = ".".join(steps)

    if complaint["type"] == "extra_forbidden":
        *tables, key = complaint["loc"]
        keys = _valid_keys(tables)
        return f"unknown key {where!r}{hint(str(key), keys)}; valid here: {', '.join(keys)}"
    if complaint["type"] == "missing":
        return f"the key {where!r} is missing"
    got = _shown(complaint["loc"], complaint["input"])
    bounds = _range(complaint["loc"])
    if bounds:
        return f"{where} takes {bounds}, got {got}"
    message = complaint["msg"]
    return f"{where}: {message[:1].lower()}{message[1:]}, got {got}"


def _range(where: Sequence[Any]) -> str:
    """The numbers that a key of course.toml may have, in words; empty where it has text."""
    if len(where) != 2:
        return ""
    table, key = where
    model = _table(table)
    field = model.model_fields.get(str(key))
    if field is None:
        return ""
    numbers: dict[str, float] = {}
    for bound in field.metadata:
        for name in ("gt", "ge", "le"):
            if hasattr(bound, name):
                numbers[name] = getattr(bound, name)
    if "le" not in numbers:
        return ""
    kind = "a whole number" if field.annotation is int else "a number"
    if "gt" in numbers:
        return f"{kind} above {numbers['gt']:g} and up to {numbers['le']:g}"
    return f"{kind} from {numbers['ge']:g} to {numbers['le']:g}"


def _shown(where: tuple[Any, ...], value: Any) -> str:
    """What was found; never the secret, nor a URL, which may hold a password."""
    if "secret" in where or "url" in where:
        return "something else"
    return repr(value)[:60]


def _valid_keys(tables: Sequence[Any]) -> list[str]:
    """The keys of a table of course.toml; the outermost has no name."""
    if not tables:
        return list(Settings.model_fields)
    return list(_table(tables[0]).model_fields)


def _table(name: Any) -> type[BaseModel]:
    """The table of that name; the outermost for every other name."""
    known: dict[str, type[BaseModel]] = {
        "sheet": Sheet,
        "limits": LimitsTable,
        "marking": MarkingTable,
        "gradebook": GradebookTable,
        "packages": PackagesTable,
    }
    return known.get(str(name), Settings)


def hint(name: str, known: Iterable[str]) -> str:
    """The question for the nearest valid name in brackets, or nothing."""
    question = did_you_mean(name, known)
    return f" ({question})" if question else ""
