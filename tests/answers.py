"""Variants and raw answers that several test files share."""

import json
from functools import cache

import numpy as np
from kinegrade.exercises.catalogue import exercise_files, find
from kinegrade.exercises.exercise import references
from kinegrade.grader.handed_in import handed_in
from kinegrade.grader.wire import Raw

SLUGS = sorted(exercise_files())
EXERCISES = {slug: find(slug, exercise_files()) for slug in SLUGS}


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


def right_raws(exercise, v):
    """The reference answers as a student would hand them in."""
    answers = references(exercise, v)
    return {part.variable: handed_in(part.answer, answers[part.variable], v) for part in exercise.asked}
