# pyright: basic
"""Determinants factor as the literature has them, with sign, and have the engine's values."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import sympy as sp
from kinegrade.solutions.any_robot import robot_from_chain, robot_from_table
from kinegrade.solutions.closed_forms.block import task_columns
from kinegrade.solutions.closed_forms.half_angles import HalfAngles
from kinegrade.solutions.closed_forms.polynomial import polynomial, reduced
from kinegrade.solutions.determinant import (
    UNFACTORED,
    DeterminantError,
    determinant,
    expanded,
    with_factors,
)
from kinegrade.solutions.expression import parse
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.robots import ROBOTS, Robot
from kinegrade.solutions.singularity import factor_values
from kinegrade.solutions.workspace import section

SQUARE = [arm for arm in ROBOTS.values() if len(arm.task_rows) == arm.n]
square = pytest.mark.parametrize("arm", SQUARE, ids=lambda arm: arm.name)
Rows = tuple[tuple[str, str, str, str], ...]

# robot, task rows, determinant: the table of closed forms, as printed there
TABLE = [
    ("planar_2r", "vx vy", "l1*l2*sin(q2)"),
    ("planar_3r", "vx vy wz", "l1*l2*sin(q2)"),
    ("three_axis", "vx vy vz", "a2*a3*cos(q3)*(a3*cos(q2 + q3) - a2*sin(q2))"),
    ("rrt_spherical", "vx vy vz", "-q3^2*sin(q2)"),
    ("rrt_offset", "vx vy vz", "-q3*(a1 + q3*sin(q2))"),
    ("rrt_scara", "vx vy vz", "-a1*a2*sin(q2)"),
    ("rpp_cylindrical", "vx vy vz", "q3"),
    ("scara", "vx vy vz wz", "a1*a2*sin(q2)"),
    ("stanford", "vx vy vz wx wy wz", "q3^2*sin(q2)*sin(q5)"),
    ("stanford_spong", "vx vy vz wx wy wz", "q3^2*sin(q2)*sin(q5)"),
    (
        "puma560",
        "vx vy vz wx wy wz",
        "a2*sin(q5)*(a3*sin(q3) + d4*cos(q3))*(a2*cos(q2) + a3*cos(q2 + q3) - d4*sin(q2 + q3))",
    ),
    (
        "articulated_6r",
        "vx vy vz wx wy wz",
        "a2*a3*sin(q3)*sin(q5)*(a2*cos(q2) + a3*cos(q2 + q3) + a4*cos(q2 + q3 + q4))",
    ),
    (
        "ur5",
        "vx vy vz wx wy wz",
        "a2*a3*sin(q3)*sin(q5)*(a2*cos(q2) + a3*cos(q2 + q3) + d5*sin(q2 + q3 + q4))",
    ),
]
# the other arm of the same line: mirrored twists, or the elevation from the horizontal
VARIANTS: list[tuple[str, Rows, str]] = [
    (
        "rrt_spherical",
        (("q1", "d1", "0", "pi/2"), ("q2", "0", "0", "-pi/2"), ("0", "q3", "0", "0")),
        "-q3^2*sin(q2)",
    ),
    (
        "rrt_spherical",
        (("q1", "d1", "0", "-pi/2"), ("q2 - pi/2", "0", "0", "pi/2"), ("0", "q3", "0", "0")),
        "q3^2*cos(q2)",
    ),
    (
        "rrt_offset",
        (("q1", "d1", "a1", "pi/2"), ("q2", "d2", "0", "-pi/2"), ("0", "q3", "0", "0")),
        "-q3*(q3*sin(q2) - a1)",
    ),
    (
        "rrt_scara",
        (("q1", "d1", "a1", "0"), ("q2", "0", "a2", "0"), ("0", "q3", "0", "0")),
        "a1*a2*sin(q2)",
    ),
]


def made(rows: Rows, task_rows: tuple[int, ...] = (0, 1, 2), **settings: object) -> Robot:
    names = dict.fromkeys(("a", "b", "d", "e"), 0.3)
    given = {
        "name": "made",
        "title": "",
        "source": "",
        "limits": ((-1, 1),) * len(rows),
        "parameters": names,
    }
    return Robot(**{**given, "rows": rows, "task_rows": task_rows, **settings})


ODD = [
    made(
        (("q1 + pi/3", "0", "a", "0"), ("q2 + pi/4", "0", "b", "pi")), (0, 1), tool=(("Ty", "d"),)
    ),
    made(
        (("q1", "b", "a", "pi/2"), ("q2", "0", "a", "e"), ("q3", "d", "b", "0")),
        base=(("Rx", "e"), ("Tx", "a")),
    ),
    made((("q1", "0", "a", "0"), ("q2", "0", "b", "0"), ("q3", "0", "a", "0"))),
    made((("q1", "0", "0", "pi/2"), ("q2", "0", "0", "pi/2"), ("q3", "0", "0", "0")), (3, 4, 5)),
    made((("q1", "a", "0", "pi/4"), ("0", "q2", "0", "pi/2"), ("0", "q3", "0", "0"))),
    made(
        (
            ("q1", "0", "a", "pi/2"),
            ("q2", "0", "b", "0"),
            ("0", "q3", "0", "pi/2"),
            ("q4", "d", "a", "-pi/2"),
            ("q5", "0", "0", "pi/2"),
            ("q6", "e", "0", "0"),
        ),
        (0, 1, 2, 3, 4, 5),
    ),
]


def value(expression: Any, values: dict[str, float]) -> float:
    return float(
        expression.subs({symbol: values[symbol.name] for symbol in expression.free_symbols})
    )


def same(first: sp.Expr, second: sp.Expr) -> bool:
    return not reduced(polynomial(sp.expand_trig(first - second))).terms


def assert_value_of_the_engine(arm: Robot) -> None:
    found, generator = determinant(arm), np.random.default_rng(4)
    for _ in range(3):
        lengths = {name: float(generator.uniform(-1, 1)) for name in arm.parameters}
        q = generator.uniform(-np.pi, np.pi, arm.n)
        block = jacobian(arm.chain(lengths), q)[list(arm.task_rows)]
        values = {**lengths, **dict(zip(arm.joints, q.tolist(), strict=True))}
        assert value(found.expression, values) == pytest.approx(
            np.linalg.det(block), rel=1e-9, abs=1e-13
        )


@pytest.mark.parametrize(("name", "rows", "printed"), TABLE, ids=[row[0] for row in TABLE])
def test_every_row_of_the_table_is_found_with_its_sign(name: str, rows: str, printed: str):
    arm = ROBOTS[name]
    assert [("vx", "vy", "vz", "wx", "wy", "wz")[row] for row in arm.task_rows] == rows.split()
    assert same(determinant(arm).expression, parse(printed, arm.names).sympy())


@pytest.mark.parametrize(("name", "rows", "printed"), VARIANTS)
def test_the_other_tables_of_the_same_arms_have_the_signs_of_the_table(
    name: str, rows: Rows, printed: str
):
    arm = replace(ROBOTS[name], rows=rows, factors=())
    assert same(determinant(arm).expression, parse(printed, arm.names).sympy())


def test_the_table_has_every_robot_with_factors():
    assert (
        {name for name, _, _ in TABLE}
        == {arm.name for arm in SQUARE}
        == {a.name for a in ROBOTS.values() if a.factors}
    )


@square
def test_the_robots_own_factors_are_found_with_their_powers_and_constant(arm: Robot):
    found = determinant(arm)
    assert [(name, power) for name, _, power in found.factors] == [
        (f.name, f.power) for f in arm.factors
    ]
    assert found.constant == parse(arm.constant, arm.names).sympy()
    for (_, expression, _), factor in zip(found.factors, arm.factors, strict=True):
        assert expression == parse(factor.expression, arm.names).sympy()


@square
def test_factors_are_found_without_being_told(arm: Robot):
    """Each told factor is, up to its sign and the names, one that is found from the rows alone."""
    told, found = determinant(arm), determinant(replace(arm, factors=()))
    assert same(told.expression, found.expression)
    assert len(told.factors) == len(found.factors)
    for _, expression, power in told.factors:
        assert any(
            power == p and (same(expression, e) or same(expression, -e))
            for _, e, p in found.factors
        )


@square
def test_a_determinant_has_the_engines_value_at_random_configurations_and_lengths(arm: Robot):
    assert_value_of_the_engine(arm)


@pytest.mark.parametrize(
    "arm", ODD, ids=["tool", "parameter as twist", "none", "angular", "slides", "no wrist"]
)
def test_other_robots_have_the_engines_value_too(arm: Robot):
    assert_value_of_the_engine(arm)


def test_the_expression_is_the_product_of_constant_and_factors():
    found = determinant(ROBOTS["puma560"])
    assert found.expression == sp.Mul(found.constant, *(e**power for _, e, power in found.factors))
    assert found.expression.func is sp.Mul


def test_what_the_robot_does_not_name_is_named_by_its_formula():
    arm = ROBOTS["puma560"]
    (wrist, *_) = (f for f in arm.factors if f.expression == "sin(q5)")
    found = determinant(replace(arm, factors=(wrist,)))
    assert [name for name, _, _ in found.factors] == [
        wrist.name,
        "a3*sin(q3) + d4*cos(q3)",
        "a2*cos(q2) + a3*cos(q2 + q3) - d4*sin(q2 + q3)",
    ]


def test_a_factor_that_the_determinant_does_not_have_is_left_out():
    arm = ROBOTS["planar_2r"]
    found = determinant(replace(arm, factors=(replace(arm.factors[0], expression="sin(q2) + l1"),)))
    assert [name for name, _, _ in found.factors] == ["sin(q2)"]


def test_a_block_that_is_singular_everywhere_has_determinant_zero():
    found = determinant(ODD[2])
    assert (found.expression, found.constant, found.factors) == (0, 0, ())


def test_a_spherical_wrist_splits_the_block():
    sizes = {arm.name: [len(block) for block in task_columns(arm)] for arm in SQUARE}
    assert sizes["puma560"] == sizes["stanford"] == [3, 3]
    assert sizes["ur5"] == [6]
    assert sizes["planar_2r"] == [2]


def test_s0s_arm_has_6_roots_of_3_at_its_example():
    arm = ROBOTS["three_axis"]
    q = dict(zip(arm.joints, arm.pose("example").tolist(), strict=True))
    assert value(determinant(arm).expression, {**arm.values(), **q}) == pytest.approx(
        6 * np.sqrt(3), rel=1e-14
    )


def test_a_robot_without_a_square_block_is_refused_with_a_sentence():
    with pytest.raises(
        DeterminantError, match="square task block, got panda with 6 rows and 7 joints"
    ):
        determinant(ROBOTS["panda"])


def test_a_determinant_is_made_once():
    assert determinant(ROBOTS["scara"]) is determinant(ROBOTS["scara"])


def test_a_determinant_of_polynomials_has_sympys_sign():
    a, b, c = sp.symbols("a b c", real=True)
    rows = [[0, a, 1, 0], [b, 0, 0, c], [0, 0, a + b, 2], [1, c, 0, 0]]
    block = [[polynomial(sp.sympify(entry)) for entry in row] for row in rows]
    assert sp.expand(expanded(block).expression() - sp.Matrix(rows).det()) == 0


@pytest.mark.parametrize(
    "text",
    [
        "sin(q1)", "cos(q1)^2", "1 + cos(q1)", "(1 - sin(q1))^3*sin(q1)", "sin(q1)^3*cos(q2)", "cos(q1 + q2)*a/3",
        "-2*(a + cos(q1))^2*(sin(q1 - q2) + a)", "cos(q1) - cos(q2)", "(1 + cos(q1))*(1 - sin(q1))",
        "cos(q1)*(1 - sin(q1))*sin(q2)*(cos(q1) + cos(q2))", "sin(2*q1)*a - a^2*cos(q1)", "7/2",
    ],
)  # fmt: skip
def test_the_factors_in_half_angles_multiply_to_what_was_factored(text: str):
    q1, q2 = sp.symbols("q1 q2", real=True)
    given, half = parse(text, ("q1", "q2", "a")).sympy(), HalfAngles([q1, q2])
    number, powers = half.factored(half.polynomial(given))
    product = number * sp.Mul(*(n**power * e**power for n, e, power in half.trigonometric(powers)))
    assert same(product, given)


def test_a_square_root_of_two_angles_is_kept_whole():
    """sin(q1) = 2 sin(q1/2) cos(q1/2) is one factor, as is the square of sin(q1)."""
    q1 = sp.Symbol("q1", real=True)
    half = HalfAngles([q1])
    for power in (1, 2, 3):
        _, powers = half.factored(polynomial(sp.sin(q1) ** power))
        assert [(e, p) for _, e, p in half.trigonometric(powers)] == [(sp.sin(q1), power)]


def table(*rows: tuple[str, str, str, str]) -> Robot:
    """The robot of a table whose lengths are the names of one letter and a digit in it."""
    words = {cell for row in rows for cell in row if cell[:1] in "ad"}
    return robot_from_table(rows, dict.fromkeys(words, 0.3))


def test_a_factor_is_written_in_single_angles_where_that_is_shorter():
    found = determinant(
        table(("q1", "0", "a1", "pi/2"), ("q2", "d2", "a2", "pi/2"), ("q3", "0", "a3", "0"))
    )
    assert [str(expression) for _, expression, _ in found.factors] == [
        "a2 + a3*cos(q3)",
        "d2*cos(q2)*cos(q3) - (a1 + a2*cos(q2))*sin(q3)",
    ]
    assert sp.count_ops(found.expression) <= 15


def random_table(seed: int) -> Robot:
    rng = np.random.default_rng(seed)
    twists = ("pi/2", "-pi/2", "0", "pi/4", "pi/3", "alpha", "0.7")
    rows = [
        (f"q{i}", str(rng.choice(["0", f"d{i}"])), str(rng.choice(["0", f"a{i}"])), str(rng.choice(twists)))
        for i in (1, 2, 3)
    ]  # fmt: skip
    return table(*rows)


@pytest.mark.parametrize("seed", range(50))
def test_random_arms_of_three_joints_are_written_without_needless_squares(seed: int):
    arm = random_table(seed)
    found = determinant(arm)
    assert_value_of_the_engine(arm)
    for function in found.expression.atoms(sp.sin, sp.cos):
        assert not found.expression.has(1 - function**2, function**2 - 1)


def test_six_oblique_axes_end_in_one_long_factor():
    arm = table(*((f"q{i}", f"d{i}", f"a{i}", "pi/2") for i in range(1, 7)))
    found = determinant(arm)
    assert [name for name, _, _ in found.factors] == [UNFACTORED]
    assert_value_of_the_engine(arm)


def test_what_would_fill_pages_is_refused_with_a_sentence():
    chain = random_chain("RRRRRR", np.random.default_rng(0))
    with pytest.raises(DeterminantError, match="would fill pages; its values at joint angles are"):
        determinant(robot_from_chain(chain, named=True))


@square
def test_a_chain_with_named_lengths_has_the_determinant_of_its_robot(arm: Robot):
    named = robot_from_chain(arm.chain(), named=True, task_rows=arm.task_rows)
    found, known = determinant(named), determinant(arm)
    assert len(found.factors) == len(known.factors)
    assert sp.count_ops(found.expression) <= sp.count_ops(known.expression) + 6
    for q in np.random.default_rng(3).uniform(-2, 2, (3, arm.n)).tolist():
        joints = dict(zip(arm.joints, q, strict=True))
        assert value(found.expression, {**named.parameters, **joints}) == pytest.approx(
            value(known.expression, {**arm.parameters, **joints}), rel=1e-9, abs=1e-12
        )


@pytest.mark.parametrize("name", ["rrt_offset", "puma560", "ur5"])
def test_the_factors_of_a_chain_are_drawn_like_those_of_the_catalogue(name: str):
    arm = ROBOTS[name]
    named = robot_from_chain(arm.chain(), named=True, limits=arm.limits)
    drawn = with_factors(named)
    for factor in drawn.factors:
        assert factor_values(drawn, None, np.zeros(arm.n))[factor.name].shape == ()
    cut, known = section(drawn, cells=60), section(arm, cells=60)
    assert len(cut.curves) == len(known.curves)
    assert cut.extent == pytest.approx(known.extent, abs=1e-9)


def test_an_oblique_offset_of_a_joint_is_added_in_the_factors():
    found = determinant(robot_from_table((("q1", "0", "a1", "0"), ("q2 + b2", "0", "a2", "0")), {"a1": 1, "a2": 1, "b2": 0.3}, task_rows=(0, 1)))  # fmt: skip
    assert [name for name, _, _ in found.factors] == ["sin(b2 + q2)"]
