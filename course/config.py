"""course.toml and roster.csv: read once, checked, with errors that point at the line or the key."""

import csv
import io
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ..solutions.errors import KinegradeError, did_you_mean

Mode = Literal["practice", "graded", "exam"]
Format = Literal["ipynb", "pdf"]
"""What a sheet and its worked solution are written as."""
SAFE_NAME = re.compile(r"[A-Za-z0-9]([A-Za-z0-9._-]{0,62}[A-Za-z0-9_-])?")
DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9]|lpt[0-9])(\..*)?", re.IGNORECASE)
"""No file can be called so on Windows."""
SCRIPT_NAME = re.compile(r"[A-Za-z]\w{0,62}", re.ASCII)
MATLAB_WORD = re.compile(
    "break|case|catch|classdef|continue|else|elseif|end|for|function|global|if|"
    "otherwise|parfor|persistent|return|spmd|switch|try|while"
)
Name = Annotated[str, Field(pattern=rf"^{SAFE_NAME.pattern}$")]


class CourseError(KinegradeError):
    """course.toml, roster.csv or the course folder is not as it should be."""


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Sheet(_Strict):
    """One hand-out: its exercises in order, and what a check may tell before the deadline.

    With `matlab`, students get a script to start from beside the notebook. `pinned` holds, by
    exercise, the choices of form that all students shall have alike, so that points mean the same
    for everybody.
    """

    name: Name
    title: str = ""
    mode: Mode = "graded"
    matlab: bool = False
    exercises: Annotated[tuple[str, ...], Field(min_length=1)]
    pinned: Mapping[str, Mapping[str, Any]] = {}


class LimitsTable(_Strict):
    """What one notebook may use while it is marked."""

    cell_seconds: Annotated[float, Field(gt=0, le=600)] = 5.0
    notebook_seconds: Annotated[float, Field(gt=0, le=3600)] = 60.0
    memory_mb: Annotated[int, Field(ge=256)] = 2048


class MarkingTable(_Strict):
    """What a mistake that has a name costs of its part: once, whatever the number of entries."""

    slip: Annotated[float, Field(ge=0, le=1)] = 0.25
    presentation: Annotated[float, Field(ge=0, le=1)] = 0.25
    concept: Annotated[float, Field(ge=0, le=1)] = 0.5


class Settings(_Strict):
    """All of course.toml."""

    title: str
    # Of older courses; the secret has a file of its own.
    secret: Annotated[str, Field(min_length=16)] | None = None
    sheet: Annotated[tuple[Sheet, ...], Field(min_length=1)]
    formats: Annotated[tuple[Format, ...], Field(min_length=1)] = ("ipynb",)
    limits: LimitsTable = LimitsTable()
    marking: MarkingTable = MarkingTable()


@dataclass(frozen=True)
class Student:
    """One line of roster.csv."""

    id: str
    name: str


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
    text = _text(path, "a course folder takes a course.toml; `kinegrade init DIR` writes one")
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
    message = complaint["msg"]
    got = _shown(complaint["loc"], complaint["input"])
    return f"{where}: {message[:1].lower()}{message[1:]}, got {got}"


def _shown(where: tuple[Any, ...], value: Any) -> str:
    """What was found; never the secret."""
    if "secret" in where:
        return "something else"
    return repr(value)[:60]


def _valid_keys(tables: Sequence[Any]) -> list[str]:
    """The keys of a table of course.toml; the outermost has no name."""
    known: dict[str, type[BaseModel]] = {
        "sheet": Sheet,
        "limits": LimitsTable,
        "marking": MarkingTable,
    }
    table: type[BaseModel] = Settings
    if tables:
        table = known.get(str(tables[0]), Settings)
    return list(table.model_fields)


def hint(name: str, known: Iterable[str]) -> str:
    """The question for the nearest valid name in brackets, or nothing."""
    question = did_you_mean(name, known)
    return f" ({question})" if question else ""


def read_roster(path: Path) -> Iterator[Student]:
    """Students in the order of roster.csv, which takes the columns student and name.

    Raises:
        CourseError: it is missing or unreadable, or a line of it cannot be meant.
    """
    text = _text(path, "a course folder takes a roster.csv with the columns student,name")
    try:
        yield from _students(path, csv.DictReader(io.StringIO(text, newline="")))
    except csv.Error as error:
        raise CourseError(f"{path}: not a CSV file: {error}") from error


def _students(path: Path, rows: "csv.DictReader[str]") -> Iterator[Student]:
    columns = _columns(path, rows)
    seen: dict[str, int] = {}
    for row in rows:
        place = f"{path}, line {rows.line_num}"
        surplus: Any = row.pop(None, [])  # pyright: ignore[reportArgumentType, reportCallIssue]
        if any(surplus):
            raise CourseError(
                f"{place}: {len(columns) + len(surplus)} cells for {len(columns)} columns; "
                'a name with a comma takes quotes: "Lovelace, Ada"'
            )
        cells: dict[str, str] = {}
        for column, text in row.items():
            cells[column.strip()] = " ".join((text or "").split())
        if not any(cells.values()):
            continue

        student = cells["student"]
        _refuse_as_folder_name(place, student)
        folder = student.casefold()  # ADA and ada are one folder on some machines
        if folder in seen:
            raise CourseError(f"{place}: student {student!r} is already in line {seen[folder]}")
        seen[folder] = rows.line_num
        yield Student(student, cells["name"] or student)


def _columns(path: Path, rows: "csv.DictReader[str]") -> list[str]:
    columns = [column.strip() for column in rows.fieldnames or ()]
    found = ", ".join(columns) or "nothing"
    for column in ("student", "name"):
        if column not in columns:
            raise CourseError(
                f"{path}: the column {column!r} is missing; the first line has: {found}"
            )
    return columns


def _refuse_as_folder_name(place: str, student: str) -> None:
    if not SAFE_NAME.fullmatch(student) or DEVICE.fullmatch(student):
        raise CourseError(
            f"{place}: a student takes an id of letters, digits, '.', '_' and '-' "
            f"(it names a folder, so CON and the like are out), got {student!r}"
        )


def _text(path: Path, missing: str) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise CourseError(f"{path} is not there: {missing}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise CourseError(f"{path} cannot be read as UTF-8 text: {error}") from error
