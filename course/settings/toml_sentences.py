"""What is wrong in course.toml, in sentences for people who write one."""

from collections.abc import Sequence
from typing import Any

from pydantic import BaseModel, ValidationError

from .spelling import hint
from .toml_tables import (
    ExerciseTable,
    GradebookTable,
    LimitsTable,
    MarkingTable,
    PackagesTable,
    PartTable,
    Settings,
    Sheet,
)

TAKES = {
    "string_type": "a text in quotation marks",
    "string_too_short": "a text of at least {min_length} characters",
    "string_too_long": "a text of at most {max_length} characters",
    "tuple_type": "a list in square brackets",
    "too_short": "a list that is not empty",
    "too_long": "a list of at most {max_length}",
    "dict_type": "a table",
    "model_type": "a table",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "literal_error": "{expected}",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number",
    "float_parsing": "a number",
    "greater_than": "a number above {gt:g}",
    "greater_than_equal": "a number from {ge:g} on",
    "less_than_equal": "a number up to {le:g}",
    "datetime_type": "a time such as 2026-10-08T23:59:00",
    "datetime_from_date_parsing": "a time such as 2026-10-08T23:59:00",
    "datetime_parsing": "a time such as 2026-10-08T23:59:00",
}
"""What a key takes, by what pydantic calls the complaint."""
TABLES = {"sheet": "[[sheet]]", "part": "[[sheet.part]]"}
PATTERNS = {
    "name": "letters, digits, '.', '_' and '-', at most 64, as it names files",
    "allow": "the name of a package",
    "url": "an address that begins with postgresql://",
}


def sentence(error: ValidationError) -> str:
    """What is wrong in course.toml: where, what the key takes, and what was found."""
    return _sentence(_telling(error))


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
    takes = _range(complaint["loc"]) or _taken(complaint)
    if takes:
        return f"{where} takes {takes}, got {got}"
    message = complaint["msg"].removeprefix("Value error, ")
    return f"{where}: {message[:1].lower()}{message[1:]}, got {got}"


def _taken(complaint: Any) -> str:
    """What a key takes, by what is wrong with its value; empty where that is not known."""
    key = ""
    for step in complaint["loc"]:
        if isinstance(step, str):
            key = step
    if complaint["type"] == "string_pattern_mismatch":
        return PATTERNS.get(key, "")
    if complaint["type"] == "tuple_type" and key in TABLES:
        return f"tables that begin with {TABLES[key]}"
    return TAKES.get(complaint["type"], "").format(**complaint.get("ctx", {}))


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
        for name in ("ge", "le"):
            if hasattr(bound, name):
                numbers[name] = getattr(bound, name)
    if "le" not in numbers:
        return ""
    kind = "a whole number" if "int" in str(field.annotation) else "a number"
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
