"""What sympy leaves in a notebook is read as it is, however it was derived and not simplified."""

from functools import cache

import numpy as np
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

from sympy.physics.mechanics import dynamicsymbols
in_time = sp.simplify(det(*dynamicsymbols("q1:4")))
thetas = sp.simplify(det(*sp.symbols(r"\\theta_1 \\theta_{2}"), q3))
dusty = sp.simplify(not_simplified) + 6e-17*q1 + sp.Float(1e-18)*sp.I
exact = sp.factor(sp.simplify(not_simplified))
solved = sp.solve(sp.sin(q2)*(q3 + l3), [q2, q3], dict=True)
stack = [sp.Matrix([[1, sp.sqrt(2)], [sp.pi, 0]]), sp.eye(2)]
"""
ANSWERS = ("not_simplified", "in_time", "thetas", "dusty", "exact", "solved", "stack")


@cache
def handed_in():
    return collect(notebook(CODE), [Ask(name) for name in ANSWERS])


def verdict(part, raw):
    raws = {**right_raws(RRT, V), part: raw}
    return next(found for found in mark(RRT, V, raws) if found.part == part)


@pytest.mark.parametrize("name", ["not_simplified", "in_time", "thetas", "dusty", "exact"])
def test_a_determinant_is_right_as_it_was_derived(name):
    raw = handed_in()[name]
    found = verdict("rrt_det", raw)
    assert found.status == "correct", (raw, found.findings)


def test_what_solve_returns_are_conditions():
    raw = handed_in()["solved"]
    v = {"form": FORMS.index(("-pi/2", ("l3",))), "d1": 0.6, "l3": 0.25, "q": V["q"]}
    raws = {**right_raws(RRT, v), "rrt_singular": raw}
    (found,) = [found for found in mark(RRT, v, raws) if found.part == "rrt_singular"]
    assert found.status == "correct", (raw.value, found.findings)


def test_a_list_of_matrices_is_a_stack():
    np.testing.assert_allclose(
        handed_in()["stack"].value, [[[1, np.sqrt(2)], [np.pi, 0]], [[1, 0], [0, 1]]]
    )


def test_a_determinant_that_is_not_simplified_is_long():
    assert len(handed_in()["not_simplified"].value) > 600
