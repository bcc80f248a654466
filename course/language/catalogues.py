"""Catalogues in gettext's .po files: they are read as they are, so that none can be out of date.

`interface.LANGUAGE.po` has what this package says by itself, `answers.LANGUAGE.po` what the grader
finds and what kinds of answers say, and `SLUG.LANGUAGE.po` beside an exercise file its own texts.
"""

import io
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

from babel.messages.catalog import Catalog
from babel.messages.mofile import write_mo
from babel.messages.pofile import PoFileError, read_po
from babel.support import Translations

from ..errors import CourseError
from .retelling import Retelling

HERE = Path(__file__).parent


@lru_cache(maxsize=64)
def catalogue(path: Path) -> Catalog:
    """The catalogue in a file.

    Raises:
        CourseError: it cannot be read.
    """
    try:
        with path.open("rb") as file:
            return read_po(file, abort_invalid=True)
    except OSError as error:
        raise CourseError(f"{path} cannot be read: {error.strerror}") from error
    except (PoFileError, ValueError) as error:
        raise CourseError(f"{path}: a translation takes a .po file of gettext: {error}") from error


def sentences(path: Path) -> dict[str, str]:
    """Sentence to translation, for those that have one.

    Raises:
        CourseError: it cannot be read.
    """
    found: dict[str, str] = {}
    for message in catalogue(path):
        sentence, translation = message.id, message.string
        if not isinstance(sentence, str) or not isinstance(translation, str) or message.fuzzy:
            continue
        if sentence and translation:
            found[sentence] = translation
    return found


@lru_cache
def interface(language: str) -> Translations:
    """What gettext needs of the sentences of the interface."""
    compiled = io.BytesIO()
    write_mo(compiled, catalogue(HERE / f"interface.{language}.po"))
    compiled.seek(0)
    return Translations(compiled)


@lru_cache(maxsize=64)
def retelling(language: str, beside: Sequence[Path]) -> Retelling:
    """The sentences of exercises, each in its own file, and then those of findings.

    Raises:
        CourseError: a file cannot be read.
    """
    own = [sentences(path) for path in beside]
    return Retelling(*own, sentences(HERE / f"answers.{language}.po"))
