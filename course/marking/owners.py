"""Whose reference answers were handed in by somebody else, found in a class of any size."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ...exercises.exercise import Exercise, Numbers, Part
from ...grader.marking import follow
from ...grader.marking.near import Near
from ...grader.marking.verdict import Verdict

Answers = Mapping[str, dict[str, Any]]
"""Student to the reference answers of one exercise, by variable."""


class Owners:
    """The reference answers of a class, looked up when somebody's answer is wrong."""

    def __init__(self, exercises: Iterable[Exercise], answers_of: Callable[[str], Answers]) -> None:
        """`answers_of` has the recorded answers of an exercise, by its name."""
        self._parts: dict[str, tuple[str, Part]] = {}
        for exercise in exercises:
            for part in exercise.asked:
                if isinstance(part.answer, Numbers):
                    self._parts[part.variable] = (exercise.slug, part)
        self._answers_of = answers_of
        self._answers: dict[str, Answers] = {}
        self._near: dict[str, tuple[Sequence[str], Near | None]] = {}

    def of(self, student: str, verdicts: Iterable[Verdict]) -> dict[str, dict[str, dict[str, Any]]]:
        """The reference answers, by exercise and owner, of those whose answers were handed in.

        They are in the order of the records, and among right answers none is looked for.
        """
        found: dict[str, dict[str, dict[str, Any]]] = {}
        for verdict in verdicts:
            if verdict.status == "correct" or verdict.answer is None:
                continue
            if verdict.part in self._parts:
                slug, part = self._parts[verdict.part]
                owner = self._owner(slug, part, verdict.answer, student)
                if owner:
                    found.setdefault(slug, {})[owner] = self._answers[slug][owner]
        return {slug: self._in_order(slug, owners) for slug, owners in found.items()}

    def _in_order(
        self, slug: str, owners: Mapping[str, dict[str, Any]]
    ) -> dict[str, dict[str, Any]]:
        return {student: owners[student] for student in self._answers[slug] if student in owners}

    def _owner(self, slug: str, part: Part, answer: Any, student: str) -> str:
        own = np.asarray(answer, dtype=np.float64)
        if follow.different_numbers(own) < follow.TELLING:
            return ""
        students, near = self._index(slug, part)
        if near is None:
            return ""
        candidates = [students[place] for place in near.to(own.ravel())]
        others = {one: self._answers[slug][one] for one in candidates if one != student}
        return follow.owner_of(part, own, others)

    def _index(self, slug: str, part: Part) -> tuple[Sequence[str], Near | None]:
        if part.variable in self._near:
            return self._near[part.variable]
        if slug not in self._answers:
            self._answers[slug] = self._answers_of(slug)
        assert isinstance(part.answer, Numbers)  # noqa: S101 - no others are kept
        students: list[str] = []
        rows: list[Any] = []
        for student, answers in self._answers[slug].items():
            row = np.asarray(answers.get(part.variable, np.nan), dtype=np.float64)
            if row.shape == part.answer.shape:
                students.append(student)
                rows.append(row.ravel())
        near = Near(np.stack(rows), follow.SAME) if rows else None
        self._near[part.variable] = (students, near)
        return self._near[part.variable]
