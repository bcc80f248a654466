"""What a handed-out notebook or script says of itself: its sheet, its mode, its numbers."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, get_args

from ...grader.collecting.ask import Limits
from ..language.speech import ENGLISH, Language, later, phrase, speaking
from ..settings.config import CourseError, LimitsTable, Mode, PackagesTable, Sheet
from .about import read_about

TOLD: dict[Mode, str] = {
    "practice": later("Practice sheet: everything is told but the reference values."),
    "graded": later(
        "Graded sheet: this tells whether answers can be read and fit each other, "
        "not if they are right."
    ),
    "exam": later("Exam sheet: this tells whether answers can be read, nothing more."),
}
"""What `check` says of a sheet, by its mode."""


@dataclass(frozen=True)
class Handout:
    """What a handed-out notebook says of itself."""

    sheet: str
    mode: Mode
    numbers: Mapping[str, dict[str, Any]]
    limits: Limits = field(default_factory=Limits)
    packages: tuple[str, ...] = ()
    adjustments: Mapping[str, Any] = field(default_factory=dict[str, Any])
    language: Language = ENGLISH

    def told(self) -> str:
        """What a check of such a sheet tells, in its language."""
        with speaking(self.language):
            return phrase(TOLD[self.mode])


def read_handout(path: Path) -> Handout:
    """Sheet, mode and numbers from what a notebook or script says of itself.

    Raises:
        CourseError: it is neither, or that was lost; it says what to do then.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise CourseError(f"{path} cannot be read: {error.strerror}") from error
    return handout_in(data, path)


def handout_in(data: bytes, path: Path) -> Handout:
    """As `read_handout`, of bytes that were read from there."""
    try:
        return _handout(read_about(data, path.suffix.lower()))
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise CourseError(
            f"{path} does not say which sheet it belongs to (another program may have dropped "
            "that); add the notebook as it was handed out: "
            "kinegrade check FILE --sheet HANDED_OUT.ipynb"
        ) from error


def _handout(about: Any) -> Handout:
    """Raises an error of a type that says little, as all kinds of damage get one sentence."""
    numbers: dict[str, dict[str, Any]] = {}
    for slug in about["exercises"]:
        given = about["numbers"][slug]
        if not isinstance(given, dict):
            raise TypeError(slug)
        numbers[slug] = given
    mode = about["mode"]
    if mode not in get_args(Mode):
        raise ValueError(mode)
    limits = LimitsTable.model_validate(about.get("limits", {}))
    packages = PackagesTable.model_validate(about.get("packages", {}))
    adjustments = Sheet.model_validate(
        {"name": "sheet", "exercises": tuple(numbers), **about.get("adjusted", {})}
    ).adjustments()
    return Handout(
        str(about["sheet"]),
        mode,
        numbers,
        Limits(**limits.model_dump()),
        packages.allow,
        adjustments,
        about.get("language", ENGLISH),
    )
