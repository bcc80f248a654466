"""Our pages: HTML that needs nothing else, from templates that escape what they are given."""

import hashlib
from base64 import b64encode
from datetime import date
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import Environment, FunctionLoader, Template
from markupsafe import Markup

from ..language.speech import language_spoken, phrase
from ..language.writing import day_text
from ..machine.files import write_atomically
from ..text.escape import printable_lines
from ..text.formulas import page_text

DAY = "\ue002"
"""A private character where a page says on which day it was written."""


def template(name: str) -> Template:
    """One of our pages, with the style that all of them share."""
    return _environment().get_template(name)


@cache
def _environment() -> Environment:
    environment: Any = Environment(
        loader=FunctionLoader(_template_text),
        autoescape=True,
        finalize=_shown,
        trim_blocks=True,
        lstrip_blocks=True,
        extensions=["jinja2.ext.i18n"],
    )
    environment.policies["ext.i18n.trimmed"] = True  # line breaks of a template are no part of it
    environment.install_gettext_callables(phrase, _counted, newstyle=True)
    environment.filters["printable"] = printable_lines  # for what is put into a translation
    environment.globals["language"] = language_spoken
    script = _template_text("report.js")
    digest = b64encode(hashlib.sha256(script.encode()).digest()).decode()
    environment.globals["style"] = Markup(_template_text("style.css"))  # noqa: S704 - our own file
    environment.globals["script"] = Markup(script)  # noqa: S704 - our own file
    environment.globals["script_hash"] = Markup(f"sha256-{digest}")  # noqa: S704 - hexadecimal
    environment.globals["day"] = Markup(DAY)  # noqa: S704 - one character
    return environment


def with_formulas(line: str) -> Markup:
    """A line of text as markup, with its formulas set."""
    return Markup(page_text(line))  # noqa: S704 - page_text escapes


def _counted(one: str, many: str, number: int) -> str:
    """A sentence with its places as they are: the template puts values into them."""
    return phrase(one if number == 1 else many)


def _shown(value: Any) -> Any:
    """What a page shows of anything: text without control characters; our own markup as it is."""
    if isinstance(value, str) and not isinstance(value, Markup):
        return printable_lines(value)
    return value


def _template_text(name: str) -> str:
    return files("kinegrade.course.pages").joinpath(f"templates/{name}").read_text(encoding="utf-8")


def write_page(path: Path, html: str, *, synced: bool = True) -> None:
    """Writes a page with today's date where `DAY` stands.

    A page that says the same already is left as it is: its day is that on which it was written.
    """
    today = date.today()  # noqa: DTZ011 - the day of whoever marks
    data = html.replace(DAY, day_text(today)).encode("utf-8", errors="replace")
    if not _says_the_same(path, html):
        write_atomically(path, data, synced=synced)


def _says_the_same(path: Path, html: str) -> bool:
    """Whether a page is there that differs in nothing but its day."""
    try:
        written = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return False
    wanted = html.encode("utf-8", errors="replace").decode("utf-8")
    before, day, after = wanted.partition(DAY)
    if not day:
        return written == wanted
    length = len(written) - len(before) - len(after)
    return 0 < length < 20 and written.startswith(before) and written.endswith(after)
