"""The RRT robot in formulas: Jacobian, determinant, singular postures, and what follows from a wrong table."""

import numpy as np
import pytest
from answers import EXERCISES, part_of, right_raws, variant_of
from kinegrade.course.sheet.worked import worked_steps
from kinegrade.exercises.calculations.own_formulas import (
    EasierError,
    closed_determinant,
    closed_factors,
    determinant_of,
    factors_of,
    jacobian_of_table,
)
from kinegrade.exercises.catalogue.rrt import FORMS, LENGTHS, robot
from kinegrade.exercises.exercise import references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.markers import read
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.expression_array import expression_array
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.table import read_table

RRT = EXERCISES["rrt"]
NAMES = (*LENGTHS, "q1", "q2", "q3")
SIZES = {"d1": 0.6, "a1": 0.3, "d2": 0.2, "l3": 0.25}


def variant(*offsets, alpha1="-pi/2"):
    """The form with these offsets, at plain lengths."""
    sizes = {name: SIZES[name] for name in ("d1", *offsets)}
    return {"form": FORMS.index((alpha1, offsets)), **sizes, "q": [0.7, -0.9, 0.8]}


def verdicts(v, **answers):
    raws = {
        **right_raws(RRT, v),
        **{f"rrt_{name}": Raw("text", value) for name, value in answers.items()},
    }
    return {verdict.part.removeprefix("rrt_"): verdict for verdict in mark(RRT, v, raws)}


@pytest.mark.parametrize("form", range(len(FORMS)))
def test_formulas_come_to_the_numbers_of_the_chain_at_any_posture(form):
    arm = robot(form)
    sizes = {name: SIZES[name] for name in arm.parameters}
    for q in np.random.default_rng(form).uniform(-2, 2, (5, 3)):
        values = {**sizes, "q1": q[0], "q2": q[1], "q3": q[2]}
        J = jacobian(arm.chain(sizes), q)
        formulas = jacobian_of_table(arm.table, arm)
        np.testing.assert_allclose(formulas.at(values), J, atol=1e-12)
        np.testing.assert_allclose(
            determinant_of(formulas, arm).at(values), np.linalg.det(J[:3]), atol=1e-12
        )
        np.testing.assert_allclose(
            closed_determinant(arm).at(values), np.linalg.det(J[:3]), atol=1e-12
        )


@pytest.mark.parametrize("form", range(len(FORMS)))
def test_the_linear_block_is_singular_where_a_condition_holds(form):
    arm = robot(form)
    sizes = {name: SIZES[name] for name in arm.parameters}
    way, reach = closed_factors(arm)
    q3 = -sizes.get("l3", 0.0)
    assert way.at({**sizes, "q3": q3}) == 0
    assert abs(np.linalg.det(jacobian(arm.chain(sizes), [0.4, 0.9, q3])[:3])) < 1e-12
    sense = 1 if FORMS[form][0] == "pi/2" else -1
    q2 = np.arcsin(sense * sizes.get("a1", 0.0) / (0.9 + sizes.get("l3", 0.0)))
    assert abs(reach.at({**sizes, "q2": q2, "q3": 0.9})) < 1e-12
    assert abs(np.linalg.det(jacobian(arm.chain(sizes), [0.4, q2, 0.9])[:3])) < 1e-12
    assert "d2" not in way.names | reach.names


@pytest.mark.parametrize(
    ("v", "conditions", "points"),
    [
        (variant(), ["q3 = 0", "sin(q2) = 0"], 3),
        (variant(), ["q3 = 0", "q2 = 0, pi"], 3),
        (variant(), ["q3^2*sin(q2) = 0"], 3),
        (variant(), ["q3 = 0", "q2 = 0"], 1.5),
        (variant(), ["q3 = 0"], 1.5),
        (variant(), ["q3 = 0", "cos(q2) = 0"], 0),
        (variant("d2"), ["q3 = 0", "d2 + q3*sin(q2) = 0"], 0),
        (variant("l3"), ["q3 + l3 = 0", "s2 = 0"], 3),
        (variant(), ["q2 = 0, 3.1416", "q3 = 0"], 3),
        (variant("l3"), ["q3 = 0", "s2 = 0"], 0),
        (variant("a1"), ["q3 = 0", "a1 + q3*sin(q2) = 0"], 3),
        (variant("a1"), ["q3 = 0", "sin(q2) = -a1/q3"], 3),
        (variant("a1"), ["q3 = 0", "a1 - q3*sin(q2) = 0"], 0),
        (variant("a1"), ["q3 = 0", "sin(q2) = 0"], 0),
        (variant("a1", alpha1="pi/2"), ["q3 = 0", "a1 - q3*sin(q2) = 0"], 3),
    ],
)
def test_conditions_earn_what_they_cover(v, conditions, points):
    assert verdicts(v, singular=conditions)["singular"].points == points


def test_a_determinant_without_its_sign_or_a_factor_is_named_but_not_right():
    v = variant("a1")
    for text in ("q3*(a1 + q3*s2)", "2*q3*(a1 + q3*s2)"):
        found = verdicts(v, det=text)["det"]
        assert found.points <= found.out_of / 2
        assert any("times a constant" in finding.text for finding in found.findings)
    wrong = verdicts(v, det="q3*a1")["det"]
    assert not any("times a constant" in finding.text for finding in wrong.findings)
    assert verdicts(v, det="-q3*a1 - q3^2*s2")["det"].status == "correct"


@pytest.mark.parametrize("answer", ["0", "1", "5", "d1"])
def test_a_determinant_that_is_constant_earns_nothing(answer):
    v = variant()
    zeros = [["0"] * 3] * 6
    assert verdicts(v, det=answer)["det"].points == 0
    assert verdicts(v, det=answer, J_symbolic=zeros)["det"].points == 0


def test_angles_of_a_table_in_degrees_are_said_to_be_read_in_radians():
    v = variant("l3")
    cells = [["q1", "d1", 0, -90], ["q2", 0, 0, 90], [0, "q3 + l3", 0, 0]]
    found = verdicts(v, dh=[[str(cell) for cell in row] for row in cells])["dh"]
    assert found.status == "partly"
    assert found.reading == "In row 1, alpha, 90 is read in radians; degrees are written 90°."

    cells[0][3], cells[1][3] = "-90°", "90°"
    found = verdicts(v, dh=[[str(cell) for cell in row] for row in cells])["dh"]
    assert (found.status, found.reading) == ("correct", "")


def wrong_table(v, row, column, cell):
    cells = [[str(x) for x in cells] for cells in robot(v["form"]).table.rows]
    cells[row][column] = cell
    return cells


def test_formulas_follow_from_a_wrong_table():
    v = variant("a1")
    cells = wrong_table(v, 1, 3, "-pi/2")
    table = read(RRT.parts[0].answer, Raw("text", cells), v)
    J = jacobian_of_table(table, robot(v["form"]))
    values = {**{name: v[name] for name in ("d1", "a1")}, "q1": 0.3, "q2": 1.1, "q3": -0.4}
    np.testing.assert_allclose(
        J.at(values), jacobian(table.chain(values), [0.3, 1.1, -0.4]), atol=1e-12
    )
    own = [  # of that table, by hand
        ["-sin(q1)*(a1 - q3*sin(q2))", "-q3*cos(q1)*cos(q2)", "-cos(q1)*sin(q2)"],
        ["cos(q1)*(a1 - q3*sin(q2))", "-q3*sin(q1)*cos(q2)", "-sin(q1)*sin(q2)"],
        ["0", "q3*sin(q2)", "-cos(q2)"],
        ["0", "-sin(q1)", "0"],
        ["0", "cos(q1)", "0"],
        ["1", "0", "0"],
    ]
    found = verdicts(
        v,
        dh=cells,
        J_symbolic=own,
        det="-q3*(a1 - q3*sin(q2))",
        singular=["q3 = 0", "a1 = q3*sin(q2)"],
    )
    assert found["dh"].status == "partly"
    for part in ("J_symbolic", "det", "singular"):
        assert found[part].points == found[part].out_of / 2, part
    assert "your own rrt_dh" in found["J_symbolic"].findings[-1].text


def test_nothing_follows_from_a_table_that_leaves_nothing_to_find_out():
    arm = robot(0)
    flat = read_table([["q1", 0, 0, 0], ["q2", 0, 0, 0], [0, "q3", 0, 0]], NAMES)
    with pytest.raises(EasierError, match="0 different numbers"):
        jacobian_of_table(flat, arm)
    with pytest.raises(EasierError):
        determinant_of(
            expression_array([["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]] * 2, NAMES), arm
        )


def test_what_follows_from_the_right_answers_is_printed_as_a_product():
    arm = robot(FORMS.index(("-pi/2", ("a1", "l3"))))
    product = determinant_of(jacobian_of_table(arm.table, arm), arm)
    assert product is closed_determinant(arm)
    assert [str(factor) for factor in factors_of(product, arm)] == [
        "l3 + q3",
        "a1 + (l3 + q3)*sin(q2)",
    ]
    other = expression_array("q3*a1", arm.names)
    assert factors_of(other, arm) == other.entries


@pytest.mark.parametrize(
    ("offsets", "said"),
    [
        ((), "in the second it lies on axis 1, which then cannot move it"),
        (("a1", "l3"), "in the second it lies on axis 1, which then cannot move it"),
        (("a1", "d2"), "in the second it lies beside axis 1"),
    ],
)
def test_the_solution_says_where_the_hand_is_in_a_singular_posture(offsets, said):
    v = variant(*offsets)
    part = part_of(RRT, "rrt_singular")
    assert said in " ".join(worked_steps(part, v, references(RRT, v)))


def test_the_home_pose_is_told_apart_from_a_q2_taken_from_the_horizontal():
    v = variant_of("rrt", 0)
    for name in ("det", "singular"):
        part = next(part for part in RRT.parts if part.variable == f"rrt_{name}")
        value = part.mistakes[0].solve(v, references(RRT, v))
        text = str(value) if name == "det" else [f"{x} = 0" for x in value]
        assert any(
            "home pose" in finding.text for finding in verdicts(v, **{name: text})[name].findings
        )
