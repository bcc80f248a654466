"""No sentence that a student reads tells a reference value."""

import re
from dataclasses import replace

import numpy as np
import pytest
from answers import EXERCISES, SLUGS, raws_of, variant_of, wrong
from kinegrade.course.commands.habits import HABITS, Code
from kinegrade.exercises.exercise import Choice, Formulas, Numbers, TableOf, references
from kinegrade.grader.marking.mark import mark

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.\d{2,}")
SPOILED = [habit for habit in HABITS if habit.title not in ("right", "empty")]


def numbers_in(value):
    """Sizes of all numbers in nested lists, dicts and arrays."""
    if isinstance(value, dict):
        value = [*value.values()]
    if isinstance(value, np.ndarray):
        value = value.ravel().tolist()
    if isinstance(value, list | tuple):
        return [size for inner in value for size in numbers_in(inner)]
    return [abs(value)] if isinstance(value, int | float) else []


def told(verdict):
    """Everything of a verdict that the student reads, but what was handed in."""
    findings = [finding.text for finding in verdict.findings if not finding.private]
    return " ".join([verdict.reading, *findings])


def is_among(size, sizes):
    return any(abs(size - known) <= 6e-4 * max(1.0, known) for known in sizes)


def assert_untold(part, reference, verdict, known):
    """`known` are sizes that the student has: printed numbers and own answers."""
    text = told(verdict)
    if isinstance(part.answer, Numbers):
        for number in NUMBER.findall(text):
            size = abs(float(number))
            if is_among(size, known):
                continue
            assert not is_among(size, numbers_in(reference)), text
    elif isinstance(part.answer, Choice):
        assert not re.search(rf"\b{reference}\)|'{reference}'", text), text
        assert part.answer.options[part.answer.letters.index(reference)] not in text
    elif isinstance(part.answer, Formulas):
        for formula in map(str, reference.entries):
            assert len(formula) < 8 or formula not in text, text
    elif isinstance(part.answer, TableOf):
        for row in reference.rows:
            assert ", ".join(map(str, row)) not in text, text


def verdicts_of(exercise, v, handed):
    raws = raws_of(exercise, v, {k: x for k, x in handed.items() if not isinstance(x, Code)})
    marked = {verdict.part: verdict for verdict in mark(exercise, v, raws)}
    known = numbers_in({name: v[name] for name in exercise.units if name in v})
    right = references(exercise, v)
    for part in exercise.asked:
        verdict = marked[part.variable]
        if verdict.status != "correct":
            own = numbers_in(handed.get(part.variable))
            yield part, right[part.variable], verdict, [*known, *own]


@pytest.mark.parametrize("habit", SPOILED, ids=lambda habit: habit.title)
@pytest.mark.parametrize("slug", SLUGS)
def test_no_sentence_of_the_demo_class_tells_a_reference_value(slug, habit):
    exercise, v = EXERCISES[slug], variant_of(slug)
    if habit.title.startswith("somebody"):
        handed = references(exercise, variant_of(slug, 1))
    else:
        handed = habit.spoil(exercise, v, references(exercise, v))
    for found in verdicts_of(exercise, v, handed):
        assert_untold(*found)


@pytest.mark.parametrize("slug", SLUGS)
def test_no_sentence_on_a_wholly_wrong_sheet_tells_a_reference_value(slug):
    exercise, v = EXERCISES[slug], variant_of(slug)
    right = references(exercise, v)
    handed = {}
    for part in exercise.asked:
        if isinstance(part.answer, Numbers | Choice | Formulas | TableOf):
            handed[part.variable] = wrong(part, right[part.variable], v)
    for found in verdicts_of(exercise, v, handed):
        assert_untold(*found)


def test_a_sentence_with_a_reference_value_is_noticed():
    exercise, v = EXERCISES["puma_velocities"], variant_of("puma_velocities")
    part = exercise.asked[0]
    reference = references(exercise, v)[part.variable]
    (verdict, *_) = mark(exercise, v, {})
    told_it = np.abs(reference).max()
    with pytest.raises(AssertionError):
        assert_untold(part, reference, replace(verdict, reading=f"It is {told_it:.3f}."), [])
