"""Links to files of the repository lead to pages that show them: the site stands alone."""

import re
from pathlib import Path
from posixpath import dirname, join, normpath, relpath
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files, InclusionLevel
from mkdocs.structure.pages import Page

FOLDER = "source"
LINK = re.compile(r"(\]\()((?:\.\./)+[^)#\s]+)(\))")
SAID = re.compile(r"(?:[rR]?(?:\"{3}|'{3})|# )(.*?)(?:\"{3}|'{3})?")
"""The first line of a module that says what it is; a hostile notebook need not be one of Python."""
UNLISTED = "---\nsearch:\n  exclude: true\n---\n\n"
LANGUAGES = {".py": "python", ".toml": "toml", ".yml": "yaml"}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds a page for every file and folder that a page points to."""
    root = Path(config.docs_dir).parent
    wanted: set[str] = set()
    for file in files.documentation_pages():
        for link in LINK.finditer(file.content_string):
            target = in_repository(file.src_uri, link[2])
            if target:
                wanted.add(target)
    for target in sorted(wanted):
        path = root / target
        if path.exists():  # else the link stays as it is, and the build says that it is broken
            text = folder_page(path, target) if path.is_dir() else file_page(path, target)
            files.append(_unlisted(config, page_of(target), text))
    return files


def _unlisted(config: MkDocsConfig, page: str, text: str) -> File:
    """A page that stands neither in the navigation nor in what is searched."""
    level = InclusionLevel.NOT_IN_NAV
    return File.generated(config, page, content=UNLISTED + text, inclusion=level)


def on_page_markdown(markdown: str, page: Page, files: Files, **_: Any) -> str:
    """Turns the links."""
    here = page.file.src_uri

    def turned(link: re.Match[str]) -> str:
        target = in_repository(here, link[2])
        if not target or files.get_file_from_path(page_of(target)) is None:
            return link[0]
        return f"{link[1]}{relpath(page_of(target), dirname(here) or '.')}{link[3]}"

    return LINK.sub(turned, markdown)


def in_repository(page: str, link: str) -> str:
    """The path from the root of what a link leads to; empty where that is a page of the site."""
    path = normpath(join("docs", dirname(page), link))
    if path.startswith(("..", "docs/")):
        return ""
    return path


def page_of(target: str) -> str:
    """The page that shows a file or folder."""
    return f"{FOLDER}/{target.strip('/')}.md"


def file_page(path: Path, target: str) -> str:
    """A file as it is."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".md":
        text = text.replace("``````", "")
    return f"# {target}\n\n``````{LANGUAGES.get(path.suffix, 'text')}\n{text}\n``````\n"


def folder_page(path: Path, target: str) -> str:
    """The modules of a folder, with the first line of each."""
    rows = [f"# {target}\n", "| file | |", "|---|---|"]
    for inner in sorted(path.iterdir()):
        if inner.name.startswith(("_", ".")):
            continue
        said = first_line(inner) if inner.suffix == ".py" else ""
        rows.append(f"| `{inner.name}` | {said} |")
    return "\n".join(rows) + "\n"


def first_line(module: Path) -> str:
    """What a module says of itself; empty where it says nothing."""
    first = module.read_text(encoding="utf-8").partition("\n")[0]
    said = SAID.fullmatch(first)
    if said is None:
        return ""
    return said[1].replace("|", r"\|").replace("<", "&lt;")
