"""course.toml and roster.csv: read once, checked, with errors that point at the line or the key."""

import csv
import io
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ..solutions.errors import KinegradeError, did_you_mean

Mode = Literal["practice", "graded", "exam"]
SAFE_NAME = re.compile(r"[A-Za-z0-9]([A-Za-z0-9._-]{0,62}[A-Za-z0-9_-])?")
DEVICE = re.compile(
    r"(con|prn|aux|nul|com[0-9]|lpt[0-9])(\..*)?", re.IGNORECASE
)  # no file name on Windows
SCRIPT_NAME = re.compile(r"[A-Za-z]\w{0,62}", re.ASCII)
MATLAB_WORD = re.compile(
    "break|case|catch|classdef|continue|else|elseif|end|for|function|global|if|otherwise|parfor|persistent|return|spmd|"
    "switch|try|while"
)
Name = Annotated[str, Field(pattern=rf"^{SAFE_NAME.pattern}$")]


class CourseError(KinegradeError):
    """course.toml, roster.csv or the course folder is not as it should be."""


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Sheet(_Strict):
    """One hand-out: its exercises in order, and what a check may tell before the deadline.

    With `matlab`, students get a script to start from beside the notebook. `pinned` holds, by exercise, the choices of
    form that all students shall have alike, so that points mean the same for everybody.
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


class Settings(_Strict):
    """All of course.toml."""

    title: str
    secret: Annotated[str, Field(min_length=16)] | None = (
        None  # of older courses; it has a file of its own
    )
    sheet: Annotated[tuple[Sheet, ...], Field(min_length=1)]
    limits: LimitsTable = LimitsTable()


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
        known = {sheet.name: sheet for sheet in self.settings.sheet}
        for name in names:
            if name not in known:
                raise CourseError(
                    f"there is no sheet {name!r}{hint(name, known)}; course.toml has: {', '.join(known)}"
                )
        return tuple(known[name] for name in names) or self.settings.sheet


def read_course(folder: Path) -> Course:
    """The course in a folder.

    Raises:
        CourseError: a file is missing, unreadable, or says something that cannot be meant.
    """
    settings = read_settings(folder / "course.toml")
    return Course(folder, settings, tuple(read_roster(folder / "roster.csv")))


def read_settings(path: Path) -> Settings:
    """course.toml, with every key known and every value possible."""
    text = _text(path, "a course folder takes a course.toml; `kinegrade init DIR` writes one")
    try:
        settings = Settings.model_validate(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise CourseError(f"{path}: not TOML: {error}") from error
    except ValidationError as error:
        first = min(
            error.errors(), key=lambda found: found["type"] != "extra_forbidden"
        )  # a typo explains the rest
        raise CourseError(f"{path}: {_sentence(first)}") from error
    names = [sheet.name.casefold() for sheet in settings.sheet]
    for sheet in settings.sheet:
        if names.count(sheet.name.casefold()) > 1:
            raise CourseError(
                f"{path}: two sheets are called {sheet.name!r}; a sheet takes a name of its own"
            )
        if DEVICE.fullmatch(sheet.name):
            raise CourseError(
                f"{path}: a sheet cannot be called {sheet.name!r}: no file can, on Windows"
            )
        if sheet.matlab and (
            not SCRIPT_NAME.fullmatch(sheet.name) or MATLAB_WORD.fullmatch(sheet.name)
        ):
            raise CourseError(
                f"{path}: a sheet with matlab = true takes a name that MATLAB can run: letters, digits and '_', at "
                f"most 63, starting with a letter, and no word of its language; got {sheet.name!r}"
            )
    return settings


def _sentence(error: Any) -> str:
    where = ".".join(str(step + 1) if isinstance(step, int) else str(step) for step in error["loc"])
    if error["type"] == "extra_forbidden":
        keys = _valid_keys(error["loc"][:-1])
        return f"unknown key {where!r}{hint(str(error['loc'][-1]), keys)}; valid here: {', '.join(keys)}"
    if error["type"] == "missing":
        return f"the key {where!r} is missing"
    return f"{where}: {error['msg'][:1].lower()}{error['msg'][1:]}, got {_shown(error['loc'], error['input'])}"


def _shown(where: tuple[Any, ...], value: Any) -> str:
    return "something else" if "secret" in where else repr(value)[:60]


def _valid_keys(where: tuple[Any, ...]) -> list[str]:
    table: Any = (
        {"sheet": Sheet, "limits": LimitsTable}.get(str(where[0]), Settings) if where else Settings
    )
    return list(table.model_fields)


def hint(name: str, known: Iterable[str]) -> str:
    """The question for the nearest valid name in brackets, or nothing."""
    question = did_you_mean(name, known)
    return f" ({question})" if question else ""


def read_roster(path: Path) -> Iterator[Student]:
    """Students in the order of roster.csv, which takes the columns student and name."""
    text = _text(path, "a course folder takes a roster.csv with the columns student,name")
    try:
        yield from _students(path, csv.DictReader(io.StringIO(text, newline="")))
    except csv.Error as error:
        raise CourseError(f"{path}: not a CSV file: {error}") from error


def _students(path: Path, rows: "csv.DictReader[str]") -> Iterator[Student]:
    columns = [column.strip() for column in rows.fieldnames or ()]
    for column in ("student", "name"):
        if column not in columns:
            raise CourseError(
                f"{path}: the column {column!r} is missing; the first line has: {', '.join(columns) or 'nothing'}"
            )
    seen: dict[str, int] = {}
    for row in rows:
        line = rows.line_num
        surplus: Any = row.pop(None, [])  # pyright: ignore[reportArgumentType, reportCallIssue]
        if any(surplus):
            raise CourseError(
                f"{path}, line {line}: {len(columns) + len(surplus)} cells for {len(columns)} columns; "
                'a name with a comma takes quotes: "Lovelace, Ada"'
            )
        cells = {key.strip(): " ".join((value or "").split()) for key, value in row.items()}
        if not any(cells.values()):
            continue
        student = cells["student"]
        if not SAFE_NAME.fullmatch(student) or DEVICE.fullmatch(student):
            raise CourseError(
                f"{path}, line {line}: a student takes an id of letters, digits, '.', '_' and '-' "
                f"(it names a folder, so CON and the like are out), got {student!r}"
            )
        if student.casefold() in seen:
            raise CourseError(
                f"{path}, line {line}: student {student!r} is already in line {seen[student.casefold()]}"
            )
        seen[student.casefold()] = line
        yield Student(student, cells["name"] or student)


def _text(path: Path, missing: str) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise CourseError(f"{path} is not there: {missing}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise CourseError(f"{path} cannot be read as UTF-8 text: {error}") from error
