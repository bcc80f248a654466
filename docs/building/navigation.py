"""The navigation takes the pages that are there, and those that other hooks write."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import api_pages
import exercise_pages
from mkdocs.config.defaults import MkDocsConfig

MORE = "More"
"""The heading over pages that mkdocs.yml does not list."""


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Leaves out of the navigation what is not there, and adds what is not listed."""
    folder = Path(config.docs_dir)
    written = [*exercise_pages.names(), *api_pages.names()]
    there = [*pages(folder), *written]
    nav = present(config.nav or [], there)
    listed = set(paths(nav))
    others = [page for page in there if page not in listed]
    if others:
        nav.append({MORE: others})
    config.nav = nav
    return config


def pages(folder: Path) -> list[str]:
    """Markdown files of the folder of pages, but for what is beside the hooks."""
    found = [path.relative_to(folder) for path in sorted(folder.rglob("*.md"))]
    return [path.as_posix() for path in found if path.parts[0] != "building"]


def present(entries: list[Any], there: list[str]) -> list[Any]:
    """Entries of a navigation whose pages are there; a star is all that are not named beside it."""
    named = set(paths(entries))
    kept: list[Any] = []
    for entry in entries:
        if isinstance(entry, str):
            kept += _matching(entry, there, named)
            continue
        ((title, inner),) = entry.items()
        if isinstance(inner, str):
            kept += [{title: page} for page in _matching(inner, there, named)]
            continue
        below = present(inner, there)
        if below:
            kept.append({title: below})
    return kept


def paths(entries: list[Any]) -> Iterator[str]:
    """The pages that entries of a navigation name."""
    for entry in entries:
        if isinstance(entry, str):
            yield entry
            continue
        (inner,) = entry.values()
        yield from paths([inner] if isinstance(inner, str) else inner)


def _matching(entry: str, there: list[str], named: set[str]) -> list[str]:
    if not entry.endswith("*"):
        return [entry] if entry in there else []
    folder = entry.removesuffix("*")
    return [page for page in there if page.startswith(folder) and page not in named]
