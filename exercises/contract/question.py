"""A part as an exercise file writes it, and what sheet, marking and solution make of it."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain
from typing import Any

from ..answers import Answer, Variant
from ..exercise import ExerciseError, Given, Mistake, Outcome, Part
from .names import Bound, Function, Names
from .worked import Docstring, Paragraph, read_docstring, steps

Wrong = tuple[str, Function]
"""The sentence that names a mistake, and the answer it leads to."""


@dataclass(frozen=True, eq=False)
class Question:
    """A part before it is on a sheet: its function, and the functions that belong to it.

    `docstring` stands for that of a function that is made for a robot (questions/). `options` are
    `follow`, `credit`, `tolerance` and `asked` of `Part`; `renamed` are parameters that stand for
    another name on the sheet.
    """

    solve: Function
    name: str
    points: float
    answer: Answer
    mistakes: Sequence[Wrong] = ()
    check: Function | None = None
    shows: Mapping[str, Function] = field(default_factory=dict[str, Function])
    options: Mapping[str, Any] = field(default_factory=dict[str, Any])
    docstring: str = ""
    renamed: Mapping[str, str] = field(default_factory=dict[str, str])

    def __call__(self, *values: Any, **named: Any) -> Any:
        """The reference answer from these values, for the use of other parts."""
        return self.solve(*values, **named)

    def called(self, name: str, **renamed: str) -> "Question":
        """The same part under another name.

        `renamed` are parameters that stand for other names on that sheet.
        """
        return replace(self, name=name, renamed={**self.renamed, **renamed})

    def worth(self, points: float) -> "Question":
        """The same part with these points."""
        return replace(self, points=points)

    def also(self, mistakes: Sequence[Wrong]) -> "Question":
        """The same part with known mistakes behind its own."""
        return replace(self, mistakes=(*self.mistakes, *mistakes))

    @cached_property
    def text(self) -> Docstring:
        """What its docstring says."""
        return read_docstring(self.docstring or self.solve.__doc__ or "")


def put_on_sheet(question: Question, names: Names, earlier: Sequence[str]) -> Part:
    """The part as it is asked and marked, where parts of these names come before it.

    Raises:
        ExerciseError: a parameter, or a place in the solution, stands for nothing.
    """
    return _Placed(question, names, tuple(earlier)).part()


@dataclass(frozen=True, eq=False)
class _Placed:
    """A question among the names and the earlier parts of its sheet."""

    question: Question
    names: Names
    earlier: tuple[str, ...]

    @property
    def own(self) -> str:
        return self.question.name

    def variable(self, name: str) -> str:
        return f"{self.names.slug}_{name}"

    @cached_property
    def bound_solve(self) -> Bound:
        return self._bound(self.question.solve, self.own, self.earlier)

    @cached_property
    def needs(self) -> tuple[str, ...]:
        """Names of the earlier parts that the part takes, in the order of the sheet."""
        return tuple(name for name in self.earlier if self.bound_solve.takes(name))

    def part(self) -> Part:
        question, text = self.question, self.question.text
        _ = self.bound_solve  # refused now, not when the first student is marked
        return Part(
            self.variable(self.own),
            text.question,
            question.points,
            question.answer,
            self.solve,
            needs=tuple(map(self.variable, self.needs)),
            check=self._check(),
            hints=text.hints,
            mistakes=self._mistakes(),
            explain=self._explain(text.solution),
            **question.options,
        )

    def solve(self, v: Variant, given: Given) -> Any:
        return self.bound_solve(self.names, v, self._answers(self.needs, given))

    def _answers(self, names: Sequence[str], given: Given) -> dict[str, Any]:
        return {name: given[self.variable(name)] for name in names}

    def _bound(self, function: Function, what: str, answers: Sequence[str]) -> Bound:
        return self.names.bound(function, what, answers, self.question.renamed)

    def _marking(self, function: Function, what: str, *more: str) -> Bound:
        """A function that is called while the part is marked.

        It has what the part itself takes, and no other part.
        """
        bound = self._bound(function, f"{what} of {self.own}", (*self.earlier, self.own, *more))
        for name in self.earlier:
            if bound.takes(name) and name not in self.needs:
                raise ExerciseError(
                    f"exercise {self.names.slug}: {what} of {self.own} takes {name!r}, which "
                    f"{self.own} itself does not take: what a part needs stands among its own "
                    "parameters"
                )
        return bound

    def _with_own(self, bound: Bound, v: Variant, given: Given) -> dict[str, Any]:
        """The needed answers and, where it is taken, the right answer of the part itself."""
        answers = self._answers(self.needs, given)
        if bound.takes(self.own):
            answers[self.own] = self.question.answer.declared(self.solve(v, given), v)
        return answers

    def _mistakes(self) -> tuple[Mistake, ...]:
        found: list[Mistake] = []
        for number, (sentence, wrong) in enumerate(self.question.mistakes, 1):
            bound = self._marking(wrong, f"mistake {number}")
            found.append(Mistake(sentence, self._mistake(bound)))
        return tuple(found)

    def _mistake(self, bound: Bound) -> Callable[[Variant, Given], Any]:
        return lambda v, given: bound(self.names, v, self._with_own(bound, v, given))

    def _check(self) -> Callable[[Variant, Given, Any], Outcome] | None:
        if self.question.check is None:
            return None
        bound = self._marking(self.question.check, "the check", "value")

        def check(v: Variant, given: Given, value: Any) -> Outcome:
            answers = {**self._with_own(bound, v, given), "value": value}
            return bound(self.names, v, answers) or Outcome()

        return check

    def _explain(
        self, solution: tuple[Paragraph, ...]
    ) -> Callable[[Variant, Given], Sequence[Any]] | None:
        if not solution:
            return None

        known = (*self.earlier, self.own)
        shows: dict[str, Bound] = {}
        for name, function in self.question.shows.items():
            what = f"{name!r}, shown in the solution of {self.own},"
            shows[name] = self._bound(function, what, known)
        computed = {*shows, *known}
        self._check_places(solution, computed | self.names.drawn)

        def explain(v: Variant, given: Given) -> Sequence[Any]:
            answers = self._answers(known, given)

            def value(name: str) -> Any:
                if name in shows:
                    return shows[name](self.names, v, answers)
                return answers[name] if name in answers else v[name]

            printed = {name: x for name, x in v.items() if name not in computed}
            return [*steps(solution, value, printed)]

        return explain

    def _check_places(self, solution: Sequence[Paragraph], values: Collection[str]) -> None:
        places = chain.from_iterable(paragraph.places for paragraph in solution)
        for place in places:
            if place not in values:
                raise ExerciseError(
                    f"exercise {self.names.slug}: the solution of {self.own} shows <{place}>, "
                    f"which is no value here; there are: {', '.join(sorted(values))}"
                )
