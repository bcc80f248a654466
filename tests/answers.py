"""Variants and raw answers that several test files share."""

import json
from functools import cache
from itertools import chain

import numpy as np
from kinegrade.exercises.answers import (
    Choice,
    Conditions,
    Configurations,
    Formulas,
    Function,
    Manual,
    Numbers,
    TableOf,
)
from kinegrade.exercises.exercise import references
from kinegrade.exercises.files.finding import exercise_files, find
from kinegrade.exercises.kinds.formulas import names_on_sheet
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.markers import handed_in

SLUGS = sorted(exercise_files())
EXERCISES = {slug: find(slug, exercise_files()) for slug in SLUGS}


def answer_code(part, value):
    """Python that hands in a declared value."""
    return part.answer.code(part.variable, value)


@cache
def variant_of(slug, seed=0):
    """Numbers of one draw, after JSON."""
    return json.loads(json.dumps(EXERCISES[slug].draw(np.random.default_rng(seed))))


def raw(value):
    """A value as the collector would hand it over."""
    if isinstance(value, Raw):
        return value
    if isinstance(value, list | str):
        return Raw("text", value)
    if hasattr(value, "rows"):
        return Raw("text", [[str(cell) for cell in row] for row in value.rows])
    if hasattr(value, "text"):
        return Raw("text", value.text())
    if isinstance(value, tuple):
        return Raw("text", [f"{expression} = 0" for expression in value])
    return Raw("num", np.asarray(value, dtype=float))


def raws(answers):
    return {name: value if callable(value) else raw(value) for name, value in answers.items()}


def raws_of(exercise, v, answers):
    """Answers by variable as the collector would hand them over; functions are called on the variant's inputs."""
    asked = [part for part in exercise.asked if part.variable in answers]
    return {part.variable: _raw_of(part, v, answers[part.variable]) for part in asked}


def _raw_of(part, v, value):
    if isinstance(value, Raw | np.ndarray):  # numbers may be of another shape than is asked
        return raw(value)
    return handed_in(part.answer, part.answer.declared(value, v), v)


def right_raws(exercise, v):
    """The reference answers as a student would hand them in."""
    return raws_of(exercise, v, references(exercise, v))


def part_of(exercise, variable):
    return next(part for part in exercise.parts if part.variable == variable)


def kinds_of(exercise):
    return {type(part.answer) for part in exercise.asked}


def wrong(part, value, v):
    """A wrong answer of the declared kind from which nothing of the reference can be read."""
    return _WRONG[type(part.answer)](part.answer, value, v)


def wrong_code(part, value, v):
    """Python that hands in what `wrong` gives."""
    if isinstance(part.answer, Function):
        return f"def {part.variable}(*_):\n    return np.full((2, 2), 0.5)"
    return answer_code(part, wrong(part, value, v))


def _other_formulas(answer, _, v):
    name = names_on_sheet(answer.names, v)[0]
    return answer.declared(np.full(answer.shape, f"0.123*{name}").tolist(), v)


def _other_table(_, value, __):
    """Every twist is another one."""
    from kinegrade.solutions.table import read_table

    names = sorted({name for row in value.rows for cell in row for name in cell.names})
    return read_table([[*map(str, row[:3]), "0.123"] for row in value.rows], names)


def _other_letter(answer, value, _):
    return answer.letters[(answer.letters.index(value) + 1) % len(answer.letters)]


_WRONG = {
    Numbers: lambda _, value, __: -1.3 * value + 0.0517,
    Configurations: lambda _, value, __: -1.3 * value + 0.0517,
    TableOf: _other_table,
    Formulas: _other_formulas,
    Choice: _other_letter,
    Conditions: lambda answer, _, v: answer.declared(
        [f"{names_on_sheet(answer.names, v)[-1]} - 0.123"], v
    ),
    Function: lambda *_: lambda *__: np.full((2, 2), 0.5),
    Manual: lambda *_: "x",
}


def telling(part, value, v):
    """Texts that stand nowhere but in the reference answer: numbers to three decimals, formulas, options, the key.

    Cells of a table and numbers with two decimals or fewer are too common to tell anything; so are a function's.
    """
    if isinstance(part.answer, Numbers | Configurations):
        sizes = [x for x in np.abs(np.ravel(value)) if x > 0.01 and abs(x - round(x, 2)) > 1e-6]
        return {
            text for x in sizes for text in (f"{x:.3f}", f"{x:.9f}"[:-6])
        }  # rounded, and as more decimals begin
    if isinstance(part.answer, Formulas):
        return {str(entry) for entry in value.entries if len(str(entry)) > 8}
    if isinstance(part.answer, Conditions):
        return {str(entry) for entry in value}
    if isinstance(part.answer, Choice):
        return {part.answer.options[part.answer.letters.index(value)]}
    return {value} if isinstance(part.answer, Manual) else set()


def flat(numbers):
    """All plain numbers of a nested value."""
    if isinstance(numbers, dict):
        return flat([*numbers.values()])
    if isinstance(numbers, list):
        return [*chain.from_iterable(map(flat, numbers))]
    return [numbers] if isinstance(numbers, int | float) else []
