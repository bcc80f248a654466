"""An exercise as text that another process or machine can load; never an Exercise itself."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ..exercise import Exercise, ExerciseError
from .loading import load, load_source
from .neighbours import HOME, Source, is_ours, read_source


@dataclass(frozen=True)
class Text:
    """An exercise file with the modules beside it that it imports.

    Attributes:
        path: Where the file lies; of one of ours, below our own folder.
        ours: Whether it is one of ours, which every machine has.
        hash: Of all texts.
        text: What the file holds; nothing of one of ours.
        beside: The modules beside it, by name.
    """

    path: str
    ours: bool
    hash: str
    text: bytes
    beside: Mapping[str, bytes]


def exercise_text(path: Path) -> Text:
    """The text of a file.

    Raises:
        ExerciseError: it cannot be read.
    """
    source = read_source(path)
    if is_ours(path):
        inner = path.resolve().relative_to(HOME).as_posix()
        return Text(inner, ours=True, hash=source.hash, text=b"", beside={})
    return Text(
        str(path.resolve()), ours=False, hash=source.hash, text=source.text, beside=source.beside
    )


_LOADED: dict[tuple[bool, str, str], Exercise] = {}
"""By whose they are, where they lie and what they hold: to look at the disk again takes longer than
to mark a part."""


def exercise_of(text: Text) -> Exercise:
    """The exercise, loaded once per content.

    Raises:
        ExerciseError: it cannot be loaded, or one of ours reads otherwise here.
    """
    key = (text.ours, text.path, text.hash)
    if key not in _LOADED:
        _LOADED[key] = _loaded(text)
    return _LOADED[key]


def _loaded(text: Text) -> Exercise:
    if not text.ours:
        return load_source(Source(Path(text.path), text.text, text.beside))
    path = HOME / text.path
    if read_source(path).hash != text.hash:
        raise ExerciseError(
            f"{path} is not the file that the class is marked by; every machine takes the same "
            "kinegrade"
        )
    return load(path)
