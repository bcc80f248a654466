"""The table of every key of course.toml, made of the models that read it."""

from collections.abc import Iterator, Mapping
from typing import Any

from griffe import Docstring, DocstringSectionKind
from kinegrade.course.settings import toml_tables
from kinegrade.course.settings.toml_tables import Settings
from mkdocs.structure.pages import Page
from pydantic import BaseModel

PLACE = "<!-- the table of all keys -->"
HEAD = ["| key | takes | left out | what it is |", "|---|---|---|---|"]
NUMBERS = {"integer": "a whole number", "number": "a number"}
WRITTEN_AS = {
    "date-time": "a date and time",
    "string": "text",
    "boolean": "`true` or `false`",
    "object": "a table",
}
UNPRINTED = {"secret"}
"""Keys of older courses, which nobody shall write any more."""
Schema = Mapping[str, Any]
"""JSON schema of a model or of a key."""


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Puts the table where the page has a place for it."""
    if page.file.src_uri != "settings.md":
        return markdown
    return markdown.replace(PLACE, table())


def table() -> str:
    """Markdown of the table."""
    schema = Settings.model_json_schema()
    return "\n".join([*HEAD, *rows(Settings, schema, schema, "")])


def rows(model: type[BaseModel], own: Schema, whole: Schema, path: str) -> Iterator[str]:
    """A row for every key of a model, then those of the tables in it; `path` is its heading."""
    said = described(model)
    first, keys = _summary(model), own["properties"]
    if path:
        yield f"| **`{path}`** | | | **{first}** |"
    inherited = [name for name in keys if name not in model.__annotations__]
    tables: list[tuple[str, str]] = []
    for name in [*(name for name in keys if name not in inherited), *inherited]:
        inner, below = _table_of(keys[name], f"{path.strip('[]')}.{name}".strip("."))
        if inner:
            tables.append((inner, below))
        elif name not in UNPRINTED:
            default = _default(keys[name], required=name in own.get("required", ()))
            yield f"| `{name}` | {_takes(keys[name])} | {default} | {said[name]} |"
    for inner, below in tables:
        yield from rows(getattr(toml_tables, inner), whole["$defs"][inner], whole, below)


def _summary(model: type[BaseModel]) -> str:
    return (model.__doc__ or "").partition("\n")[0]


def described(model: type[BaseModel]) -> dict[str, str]:
    """What the docstrings of a model, and of those it is made of, say of each key."""
    found: dict[str, str] = {}
    for one in reversed(model.__mro__):
        if one.__module__ != toml_tables.__name__ or not one.__doc__:
            continue
        for section in Docstring(one.__doc__).parse("google", warnings=False):
            if section.kind is not DocstringSectionKind.attributes:
                continue
            for attribute in section.value:
                found[attribute.name] = " ".join(attribute.description.split())
    return found


def _table_of(value: Schema, path: str) -> tuple[str, str]:
    """The model of a key that is a table, and its heading in the file; empty where it is none."""
    if "$ref" in value:
        return _model(value), f"[{path}]"
    items = value.get("items", {})
    if "$ref" in items:
        return _model(items), f"[[{path}]]"
    named = value.get("additionalProperties")
    if isinstance(named, Mapping) and "$ref" in named:
        return _model(named), f"[{path}.NAME]"
    return "", path


def _model(reference: Schema) -> str:
    return str(reference["$ref"]).rpartition("/")[2]


def _default(value: Schema, *, required: bool) -> str:
    if required:
        return "**required**"
    default = value.get("default")
    if default in (None, "", [], {}):
        return ""
    return f"`{_toml(default)}`"


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_toml, value))}]"
    return f"{value:g}"


def _takes(value: Schema) -> str:
    """What a key takes, in words."""
    for one in value.get("anyOf", ()):
        if one.get("type") != "null":
            return _takes(one)
    if "enum" in value:
        return " or ".join(f'`"{one}"`' for one in value["enum"])
    kind = value.get("type", "")
    if kind in NUMBERS:
        return _range(NUMBERS[kind], value)
    if kind == "array":
        return f"a list: {_takes(value['items'])}"
    return WRITTEN_AS[value.get("format", kind)]


def _range(number: str, value: Schema) -> str:
    if "exclusiveMinimum" in value:
        return f"{number} above {value['exclusiveMinimum']:g}, up to {value['maximum']:g}"
    return f"{number} from {value['minimum']:g} to {value['maximum']:g}"
