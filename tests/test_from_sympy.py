"""What sympy leaves in a notebook is read as it is, however it was derived and not simplified."""

from functools import cache

import pytest
from answers import EXERCISES, right_raws
from kinegrade.exercises.catalogue.rrt import FORMS
from kinegrade.grader.collecting.ask import Ask
from kinegrade.grader.collecting.collect import collect
from kinegrade.grader.marking.mark import mark
from test_collect import notebook

RRT = EXERCISES["rrt"]
V = {"form": FORMS.index(("-pi/2", ("a1", "l3"))), "d1": 0.6, "a1": 0.3, "l3": 0.25}
V["q"] = [0.7, -0.9, 0.8]
CODE = """
import sympy as sp
q1, q2, q3, d1, l3, a1 = sp.symbols("q1 q2 q3 d1 l3 a1")

def link(th, d, a, al):
    return sp.Matrix([
        [sp.cos(th), -sp.sin(th)*sp.cos(al), sp.sin(th)*sp.sin(al), a*sp.cos(th)],
        [sp.sin(th), sp.cos(th)*sp.cos(al), -sp.cos(th)*sp.sin(al), a*sp.sin(th)],
        [0, sp.sin(al), sp.cos(al), d],
        [0, 0, 0, 1],
    ])

def det(q1, q2, q3):
    T = link(q1, d1, a1, -sp.pi/2) * link(q2, 0, 0, sp.pi/2) * link(0, q3 + l3, 0, 0)
    return T[:3, 3].jacobian([q1, q2, q3]).det()

not_simplified = det(q1, q2, q3)
"""
ANSWERS = ("not_simplified",)


@cache
def handed_in():
    return collect(notebook(CODE), [Ask(name) for name in ANSWERS])


def verdict(part, raw):
    raws = {**right_raws(RRT, V), part: raw}
    return next(found for found in mark(RRT, V, raws) if found.part == part)


@pytest.mark.parametrize("name", ["not_simplified"])
def test_a_determinant_is_right_as_it_was_derived(name):
    raw = handed_in()[name]
    found = verdict("rrt_det", raw)
    assert found.status == "correct", (raw, found.findings)


def test_a_determinant_that_is_not_simplified_is_long():
    assert len(handed_in()["not_simplified"].value) > 600
