"""course.toml: read once, checked, with errors that point at the key."""

import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ValidationError

from ..errors import CourseError
from .roster import DEVICE, Student, read_roster
from .spelling import hint
from .text_file import text_of
from .toml_tables import (
    ExerciseTable,
    Format,
    GradebookTable,
    LimitsTable,
    MarkingTable,
    Mode,
    PackagesTable,
    PartTable,
    Settings,
    Sheet,
)

if TYPE_CHECKING:
    from datetime import datetime

__all__ = [
    "Course",
    "CourseError",
    "Format",
    "LimitsTable",
    "MarkingTable",
    "Mode",
    "PackagesTable",
    "Settings",
    "Sheet",
    "Student",
    "hint",
    "read_course",
    "read_roster",
    "read_settings",
    "refuse_no_folder",
]

SCRIPT_NAME = re.compile(r"[A-Za-z]\w{0,62}", re.ASCII)
MATLAB_WORD = re.compile(
    "break|case|catch|classdef|continue|else|elseif|end|for|function|global|if|"
    "otherwise|parfor|persistent|return|spmd|switch|try|while"
)


@dataclass(frozen=True)
class Course:
    """A course folder as it was read."""

    folder: Path
    settings: Settings
    students: tuple[Student, ...]

    def student(self, name: str) -> Student:
        """Somebody of the roster.

        Raises:
            CourseError: nobody there has that id.
        """
        known = {student.id: student for student in self.students}
        if name not in known:
            roster = self.folder / "roster.csv"
            raise CourseError(f"{roster} has no student {name!r}{hint(name, known)}")
        return known[name]

    def sheet(self, name: str) -> Sheet:
        """The sheet of that name.

        Raises:
            CourseError: there is none.
        """
        (found,) = self.sheets((name,))
        return found

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
    refuse_no_folder(folder)
    settings = read_settings(folder / "course.toml")
    return Course(folder, settings, tuple(read_roster(folder / "roster.csv")))


def refuse_no_folder(folder: Path) -> None:
    """Refuses what is no folder where one of a course is to be named.

    Raises:
        CourseError: it is a file, or is not there.
    """
    if not folder.is_dir():
        raise CourseError(f"{folder} is no folder; --course takes the one with the course.toml")


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

    settings = _in_language(_in_zone(settings))
    names = [sheet.name.casefold() for sheet in settings.sheet]
    for sheet in settings.sheet:
        if names.count(sheet.name.casefold()) > 1:
            raise CourseError(
                f"{path}: two sheets are called {sheet.name!r}; a sheet takes a name of its own"
            )
        _refuse_as_file_name(path, sheet)
        _refuse_resit(path, sheet, settings)
        _refuse_times(path, sheet)
    return settings


def _in_zone(settings: Settings) -> Settings:
    """Times of sheets that name no zone are those of the course."""
    sheets: list[Sheet] = []
    for sheet in settings.sheet:
        times = _times(sheet)
        for name, time in times.items():
            if time.tzinfo is None:
                times[name] = time.replace(tzinfo=settings.zone)
        sheets.append(sheet.model_copy(update=times))
    return settings.model_copy(update={"sheet": tuple(sheets)})


def _in_language(settings: Settings) -> Settings:
    """Sheets that name no language are in that of the course."""
    sheets: list[Sheet] = []
    for sheet in settings.sheet:
        if "language" not in sheet.model_fields_set:
            sheet = sheet.model_copy(update={"language": settings.language})  # noqa: PLW2901
        sheets.append(sheet)
    return settings.model_copy(update={"sheet": tuple(sheets)})


def _times(sheet: Sheet) -> "dict[str, datetime]":
    """The times that a sheet has, by key, in the order in which they should come."""
    times = {"release": sheet.release, "deadline": sheet.deadline, "closes": sheet.closes}
    return {name: time for name, time in times.items() if time is not None}


def _refuse_times(path: Path, sheet: Sheet) -> None:
    """Refuses times that cannot be meant."""
    times = _times(sheet)
    for earlier, later in pairwise(times):
        if times[earlier] > times[later]:
            raise CourseError(f"{path}: {later} of sheet {sheet.name!r} is before its {earlier}")
    if sheet.late_percent and sheet.deadline is None:
        raise CourseError(f"{path}: late_percent of sheet {sheet.name!r} takes a deadline, too")


def _refuse_resit(path: Path, sheet: Sheet, settings: Settings) -> None:
    """Refuses a second try of a sheet that is none, or is one itself."""
    if not sheet.resit_of:
        return
    firsts = [other.name for other in settings.sheet if not other.resit_of]
    if sheet.resit_of not in firsts:
        raise CourseError(
            f"{path}: sheet {sheet.name!r} is a resit of {sheet.resit_of!r}"
            f"{hint(sheet.resit_of, firsts)}; resit_of takes the name of a sheet that is no resit"
        )


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
    if complaint["type"] == "value_error" and not isinstance(complaint["input"], str):
        return str(complaint["ctx"]["error"])  # of a whole table, in our own words
    got = _shown(complaint["loc"], complaint["input"])
    bounds = _range(complaint["loc"])
    if bounds:
        return f"{where} takes {bounds}, got {got}"
    message = complaint["msg"].removeprefix("Value error, ")
    return f"{where}: {message[:1].lower()}{message[1:]}, got {got}"


def _range(where: Sequence[Any]) -> str:
    """The numbers that a key of course.toml may have, in words; empty where it has text."""
    *tables, key = where
    if not tables:
        return ""
    field = _table(_table_name(tables)).model_fields.get(str(key))
    if field is None:
        return ""
    numbers: dict[str, float] = {}
    for bound in field.metadata:
        for name in ("gt", "ge", "le"):
            if hasattr(bound, name):
                numbers[name] = getattr(bound, name)
    if "le" not in numbers:
        return ""
    kind = "a whole number" if "int" in str(field.annotation) else "a number"
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
    return list(_table(_table_name(tables)).model_fields)


def _table_name(tables: Sequence[Any]) -> str:
    """As "sheet.part", of the keys and numbers that lead to a table."""
    names = [str(step) for step in tables if not isinstance(step, int)]
    return ".".join(names[:2])


def _table(name: Any) -> type[BaseModel]:
    """The table of that name; the outermost for every other name."""
    known: dict[str, type[BaseModel]] = {
        "sheet": Sheet,
        "sheet.exercise": ExerciseTable,
        "sheet.part": PartTable,
        "limits": LimitsTable,
        "marking": MarkingTable,
        "gradebook": GradebookTable,
        "packages": PackagesTable,
    }
    return known.get(str(name), Settings)
