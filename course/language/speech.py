"""The language that is spoken while a sheet or a page is written, and sentences said in it.

A language is a matter of where a text is shown, not of what it says: it holds for all that is
written inside `with speaking("de"):`, as a locale does, and nobody hands it on.
"""

from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from .retelling import Retelling

Language = Literal["en", "de"]
ENGLISH: Language = "en"


@dataclass(frozen=True)
class Speech:
    """A language: the sentences of the interface, and those that are put together elsewhere.

    Attributes:
        language: As in course.toml.
        interface: A sentence of the interface in it.
        interface_count: The same with a number, from the words for one and for many.
        retelling: Of sentences of exercises and findings; None where they stay as they are.
    """

    language: Language = ENGLISH
    interface: Callable[[str], str] = str
    interface_count: Callable[[str, str, int], str] = lambda one, many, n: one if n == 1 else many
    retelling: Retelling | None = None


_SPEECH: ContextVar[Speech] = ContextVar("speech", default=Speech())  # noqa: B039 - it is frozen


@contextmanager
def speaking(language: Language, beside: Sequence[Path] = ()) -> Generator[None]:
    """Everything that is said inside is said in that language.

    `beside` are the translations of the exercises that it is about.
    """
    token = _SPEECH.set(_speech(language, tuple(beside)))
    try:
        yield
    finally:
        _SPEECH.reset(token)


def _speech(language: Language, beside: tuple[Path, ...]) -> Speech:
    if language == ENGLISH:
        return Speech()
    from .catalogues import interface, retelling

    translations = interface(language)
    return Speech(
        language, translations.gettext, translations.ngettext, retelling(language, beside)
    )


def language_spoken() -> Language:
    """The language that is spoken here."""
    return _SPEECH.get().language


def phrase(sentence: str, **values: Any) -> str:
    """A sentence of the interface in the language spoken, with values in the places of {names}."""
    said = _SPEECH.get().interface(sentence)
    if not values:
        return said
    return said.format_map(values)


def phrase_count(one: str, many: str, number: int, **values: Any) -> str:
    """A sentence that is another one for one of something; {number} stands in both."""
    return _SPEECH.get().interface_count(one, many, number).format(number=number, **values)


def later(sentence: str) -> str:
    """A sentence that `phrase` says later: it is marked here, so that catalogues have it."""
    return sentence


def retold(text: str) -> str:
    """Text of an exercise or a finding, in the language spoken as far as catalogues have it."""
    retelling = _SPEECH.get().retelling
    if retelling is None:
        return text
    return retelling.told(text)
