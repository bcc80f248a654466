"""Texts that are put together elsewhere, told in another language sentence by sentence.

What the grader finds stands in the gradebook as an English sentence with its values in it, so that
the same result can be shown in any language. Its pattern is found again, and the values go into the
translation; a value that is a sentence or a clause itself is told in the same way.
"""

import re
from collections.abc import Callable, Mapping

from .pattern import Pattern

PARAGRAPHS = re.compile(r"(\n\s*\n|\n(?=[-|] |\d+\. ))")
STOP = re.compile(r"(?<=[.?!:]) (?=[A-Z`$(*])")
ITEM = re.compile(r"(- |\d+\. )?(.*)", re.DOTALL)
UNSAID = re.compile(r"\$\$.*?\$\$|\$[^$]*\$|`[^`]*`|\{[^}]*\}|\b\w*[\d_]\w*\b", re.DOTALL)
"""What is no words: formulas, code, and names of variables."""
WORD = re.compile(r"[^\W\d_]{3,}")
MOST_TOGETHER = 5  # sentences that are one in a catalogue
CLAUSE = 3  # words: a value that has as many is no name


class Retelling:
    """The sentences of catalogues, found by the word that they begin with."""

    def __init__(self, *catalogues: Mapping[str, str]) -> None:
        """Earlier catalogues go before later ones."""
        self._whole: dict[str, str] = {}
        self._starting: dict[str, list[Pattern]] = {}
        for catalogue in reversed(catalogues):
            for sentence, translation in catalogue.items():
                self._add(Pattern(joined(sentence), translation))
        for patterns in self._starting.values():
            patterns.sort(key=_most_fixed)

    def _add(self, pattern: Pattern) -> None:
        self._whole[pattern.sentence] = pattern.translation
        if pattern.places:
            self._starting.setdefault(pattern.start, []).insert(0, pattern)

    def told(self, text: str) -> str:
        """The text in the other language; what no catalogue has stays as it is."""
        return self._text(text, lambda _: None)

    def untold(self, text: str) -> list[str]:
        """The sentences and clauses of a text that no catalogue has."""
        missing: list[str] = []
        self._text(text, missing.append)
        return missing

    def _text(self, text: str, note: Callable[[str], None]) -> str:
        """The text paragraph by paragraph; `note` hears of what is not found."""
        whole = self._found(joined(text), note)
        if whole is not None:
            return whole
        pieces = PARAGRAPHS.split(text)
        for i in range(0, len(pieces), 2):
            pieces[i] = self._paragraph(pieces[i], note)
        return "".join(pieces)

    def _paragraph(self, text: str, note: Callable[[str], None]) -> str:
        item = ITEM.fullmatch(text)
        start, rest = item.groups("") if item else ("", text)
        if not words(rest):
            return text
        return start + self._sentences(joined(rest), note)

    def _sentences(self, text: str, note: Callable[[str], None]) -> str:
        """As many sentences at once as are one in a catalogue, then the next ones."""
        sentences = STOP.split(text)
        told: list[str] = []
        while sentences:
            count, found = self._longest(sentences, note)
            told.append(found)
            del sentences[:count]
        return " ".join(told)

    def _longest(self, sentences: list[str], note: Callable[[str], None]) -> tuple[int, str]:
        """How many sentences from the first on are one in a catalogue, and their translation."""
        for count in range(min(MOST_TOGETHER, len(sentences)), 0, -1):
            found = self._found(" ".join(sentences[:count]), note)
            if found is not None:
                return count, found
        if words(sentences[0]):
            note(sentences[0])
        return 1, sentences[0]

    def _found(self, text: str, note: Callable[[str], None], *, inner: bool = False) -> str | None:
        """One sentence; it may be a clause in a catalogue, which takes a capital and a stop."""
        found = self._matched(text, note, inner=inner)
        if found is not None:
            return found
        clause = text[:1].lower() + text[1:].removesuffix(".")
        if clause == text:
            return None
        found = self._matched(clause, note, inner=inner)
        if found is None:
            return None
        return found[:1].upper() + found[1:] + text[len(clause) :]

    def _matched(self, text: str, note: Callable[[str], None], *, inner: bool) -> str | None:
        if text in self._whole:
            return self._whole[text]
        for start in (text.partition(" ")[0], ""):
            for pattern in self._starting.get(start, ()):
                if pattern.is_joint and not inner:
                    continue
                values = pattern.values(text)
                if values is not None:
                    return pattern.told(values, lambda value: self._value(value, note))
        return None

    def _value(self, text: str, note: Callable[[str], None]) -> str:
        """What stood in a place: a name, a number, a clause, or whole sentences."""
        found = self._found(text, note, inner=True)
        if found is not None:
            return found
        if STOP.search(text):  # the stop of the last one may stand behind the place
            stop = "" if text.endswith((".", "?", "!")) else "."
            return self._sentences(text + stop, note).removesuffix(stop)
        if len(words(text)) >= CLAUSE:
            note(text)
        return text


def _most_fixed(pattern: Pattern) -> int:
    return -pattern.fixed


def joined(text: str) -> str:
    """Text without its line breaks."""
    return " ".join(text.split())


def words(text: str) -> list[str]:
    """The words of a text that are no formulas, code or names."""
    return WORD.findall(UNSAID.sub(" ", text))
