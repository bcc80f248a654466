"""Variants and raw answers that several test files share."""

import json
from functools import cache

import numpy as np
from kinegrade.exercises.catalogue import exercise_files, find
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
    return Raw("num", np.asarray(value, dtype=float))


def raws(answers):
    return {name: raw(value) for name, value in answers.items()}
