"""What names on a sheet stand for: settled when a file loads, filled in for every student."""

import inspect
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from ...solutions.errors import did_you_mean
from ..answers import Variant
from ..arm import Arm
from ..exercise import ExerciseError

Function = Callable[..., Any]
NOTHING = inspect.Parameter.empty


@dataclass(frozen=True)
class Parameter:
    """A parameter of a function, the name on the sheet that it stands for, and its default."""

    name: str
    source: str
    default: Any


@dataclass(frozen=True, eq=False)
class Bound:
    """A function of names on the sheet, with what each of its parameters stands for."""

    function: Function
    parameters: tuple[Parameter, ...]

    def takes(self, name: str) -> bool:
        """Whether one of the parameters stands for this name."""
        return any(parameter.source == name for parameter in self.parameters)

    def __call__(self, names: "Names", v: Variant, answers: Mapping[str, Any]) -> Any:
        """The function's value for a student's numbers `v` and for `answers`, by names of parts.

        Raises:
            ExerciseError: a number that this variant lacks is taken without a default.
        """
        values: dict[str, Any] = {}
        for parameter in self.parameters:
            values[parameter.name] = names.value(parameter, v, answers)
        return self.function(**values)


@dataclass(frozen=True, eq=False)
class Names:
    """The names on the sheet of one exercise: its drawn numbers, and `arm` where it has a robot."""

    slug: str
    drawn: frozenset[str]
    arm: Callable[[Variant], Arm] | None

    def bound(
        self,
        function: Function,
        what: str,
        answers: Collection[str] = (),
        renamed: Mapping[str, str] | None = None,
    ) -> Bound:
        """The function with its parameters settled.

        Each is a drawn number, `v` for all of them, `arm`, or one of `answers`. `renamed` are
        parameters that stand for another name. A keyword-only parameter with a default is no name
        but a constant of the function.

        Raises:
            ExerciseError: a parameter stands for nothing; the sentence has the nearest name.
        """
        known = {*self.drawn, *answers, "v"}
        if self.arm:
            known.add("arm")

        found: list[Parameter] = []
        for parameter in _signature(function, f"exercise {self.slug}: {what}"):
            source = (renamed or {}).get(parameter.name, parameter.name)
            if source in known:
                found.append(Parameter(parameter.name, source, parameter.default))
                continue
            is_constant = parameter.kind is parameter.KEYWORD_ONLY  # behind the * of a signature
            if not is_constant or parameter.default is NOTHING:
                raise ExerciseError(
                    f"exercise {self.slug}: {what} takes {source!r}, {self._unknown(source, known)}"
                )
        return Bound(function, tuple(found))

    def value(self, parameter: Parameter, v: Variant, answers: Mapping[str, Any]) -> Any:
        """What a parameter stands for on one student's sheet.

        A drawn list of numbers comes as an array.

        Raises:
            ExerciseError: a number that this variant lacks is taken without a default.
        """
        name = parameter.source
        if name in answers:
            return answers[name]
        if name in v:
            return as_array(v[name])
        if name == "v":
            return v
        if name == "arm" and self.arm:
            return self.arm(v)
        if parameter.default is NOTHING:
            raise ExerciseError(
                f"exercise {self.slug}: {name} is not among the numbers of this variant; a number "
                f"that only some variants have takes a default: {name}=0.0"
            )
        return parameter.default

    def _unknown(self, name: str, known: Collection[str]) -> str:
        if name == "arm":
            return "but the exercise has no robot"
        listed = f"here stand: {', '.join(sorted(known))}"
        near = did_you_mean(name, known)
        hints = f"{near} {listed}" if near else listed
        return f"which is no name on the sheet; {hints}"


def as_array(value: Any) -> Any:
    """A list of numbers, or of equal rows of them, as an array; anything else as it is."""
    if not _is_numeric(value):
        return value
    try:
        return np.array(value)
    except ValueError:  # rows of different lengths
        return value


def _is_numeric(value: Any) -> bool:
    if not isinstance(value, list):
        return False
    items = cast("list[Any]", value)
    for item in items:
        if not isinstance(item, int | float) and not _is_numeric(item):
            return False
    return bool(items)


def _signature(function: Function, what: str) -> list[inspect.Parameter]:
    try:
        parameters = [*inspect.signature(function).parameters.values()]
    except (TypeError, ValueError):
        raise ExerciseError(
            f"{what} takes a function of names on the sheet, got {function!r}"
        ) from None

    for parameter in parameters:
        if parameter.kind not in (parameter.POSITIONAL_OR_KEYWORD, parameter.KEYWORD_ONLY):
            raise ExerciseError(
                f"{what} takes parameters that are names on the sheet, got {parameter}"
            )
    return parameters
