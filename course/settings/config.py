"""course.toml: read once, checked, with errors that point at the key."""

import re
import tomllib
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import ValidationError

from ..errors import CourseError
from .roster import DEVICE, Student, read_roster
from .spelling import hint
from .text_file import text_of
from .toml_sentences import sentence
from .toml_tables import (
    Format,
    LimitsTable,
    MarkingTable,
    Mode,
    PackagesTable,
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
        raise CourseError(f"{path}: {sentence(error)}") from error

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
    if sheet.resit_of in firsts:
        return
    said = f"{path}: sheet {sheet.name!r} is a resit of {sheet.resit_of!r}"
    if sheet.resit_of not in [other.name for other in settings.sheet]:
        raise CourseError(f"{said}, and no sheet is called so{hint(sheet.resit_of, firsts)}")
    raise CourseError(f"{said}; resit_of takes the name of a sheet that is no resit")


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
