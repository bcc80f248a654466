# pyright: basic
"""Closed forms agree with the engine, stay short, and factor as the literature has it."""

import numpy as np
import pytest
import sympy as sp
from kinegrade.solutions.closed_forms.polynomial import polynomial, reduced
from kinegrade.solutions.expression import parse
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS, Robot
from kinegrade.solutions.symbolic import closed_form, shorthand

every = pytest.mark.parametrize("arm", ROBOTS.values(), ids=list(ROBOTS))
EXTRA = Robot(
    name="scara",
    title="SCARA with a wrist in modified rows",
    parameters={"a1": 0.3, "a2": 0.4, "d4": 0.1},
    rows=(
        ("q1", "0", "0", "0"),
        ("q2 + pi/3", "0", "a1", "0"),
        ("0", "q3", "a2", "pi"),
        ("q4", "d4", "0", "0"),
    ),
    limits=((-1, 1),) * 4,
    source="chosen here; limits too",
    convention="modified",
    tool=(("Ty", "a1/2"),),
)


def numbers(matrix: sp.Matrix, values: dict[str, float]) -> np.ndarray:
    return np.array(
        matrix.subs({symbol: values[symbol.name] for symbol in matrix.free_symbols}), dtype=float
    )


@pytest.mark.parametrize("arm", [*ROBOTS.values(), EXTRA], ids=[*ROBOTS, "scara"])
def test_closed_forms_have_the_engines_values(arm: Robot):
    closed, q = arm.symbolic(), np.linspace(0.3, 1.4, arm.n)
    values = {**arm.values(), **dict(zip(arm.joints, q.tolist(), strict=True))}
    printed = arm.frames(None, q)
    assert closed.J.shape == (6, arm.n)
    assert len(closed.frames) == arm.n + 1
    np.testing.assert_allclose(
        numbers(closed.J, values), jacobian(arm.chain(), q), rtol=0, atol=1e-13
    )
    np.testing.assert_allclose(numbers(closed.T, values), printed[-1], rtol=0, atol=1e-13)
    for frame, expected in zip(closed.frames, printed, strict=True):
        np.testing.assert_allclose(numbers(frame, values), expected, rtol=0, atol=1e-13)


@every
def test_closed_forms_have_the_engines_values_at_random_configurations_and_lengths(arm: Robot):
    generator = np.random.default_rng(7)
    closed = arm.symbolic()
    J = sp.lambdify([*closed.parameters, *closed.joints], closed.J, "numpy")
    for _ in range(5):
        lengths = {name: float(generator.uniform(-1, 1)) for name in arm.parameters}
        q = generator.uniform(-np.pi, np.pi, arm.n)
        np.testing.assert_allclose(
            J(*lengths.values(), *q), jacobian(arm.chain(lengths), q), rtol=0, atol=1e-13
        )


@every
def test_symbols_are_real_and_named_after_the_robot(arm: Robot):
    closed = arm.symbolic()
    assert tuple(symbol.name for symbol in (*closed.parameters, *closed.joints)) == arm.names
    assert closed.J.free_symbols <= {*closed.parameters, *closed.joints}
    assert all(symbol.is_real for symbol in closed.J.free_symbols)


@every
def test_a_closed_form_is_made_once(arm: Robot):
    assert arm.symbolic() is arm.symbolic()


@every
def test_linear_columns_are_derivatives_of_the_tool_point(arm: Robot):
    closed = arm.symbolic()
    for j, q in enumerate(closed.joints):
        for row in range(3):
            assert sp.expand(closed.J[row, j] - sp.diff(closed.T[row, 3], q)) == 0


def operations(arm: Robot) -> int:
    return sum(sp.count_ops(entry) for entry in shorthand(arm.symbolic().J))


@pytest.mark.parametrize(
    ("name", "most"), [("puma560", 84), ("ur5", 117), ("stanford", 127), ("panda", 915)]
)
def test_a_jacobian_takes_no_more_operations_than_this(name: str, most: int):
    assert operations(ROBOTS[name]) <= most


def test_the_puma_takes_at_most_65_operations_after_common_subexpressions():
    arm = ROBOTS["puma560"]
    replaced, (reduced,) = sp.cse(shorthand(arm.symbolic().J))
    assert (
        sum(sp.count_ops(entry) for _, entry in replaced)
        + sum(sp.count_ops(entry) for entry in reduced)
        <= 65
    )


@pytest.mark.parametrize(
    ("name", "determinant"),
    [
        ("planar_2r", "l1*l2*sin(q2)"),
        ("three_axis", "a2*a3*cos(q3)*(a3*cos(q2 + q3) - a2*sin(q2))"),
        ("rrt_spherical", "-q3^2*sin(q2)"),
        ("rrt_offset", "-q3*(a1 + q3*sin(q2))"),
    ],
)
def test_the_determinant_of_the_task_block_is_the_literatures(name: str, determinant: str):
    arm = ROBOTS[name]
    block = arm.symbolic().J.extract(list(arm.task_rows), list(range(arm.n)))
    assert sp.simplify(sp.expand_trig(block.det() - parse(determinant, arm.names).sympy())) == 0


@pytest.mark.parametrize(
    "text",
    [
        "a*cos(q1)*cos(q2) - a*cos(q1)*sin(q2) + d*sin(q1)",
        "-a*q1 - d*q1",
        "a^2*d + 2*a*d^2 - d^3/3 + 1",
        "sqrt(3)*(sqrt(3)*a + d)*cos(q1)/2",
        "(cos(q1) + a)*(sin(q2) - d)*(q1 + 2)",
        "0",
        "-7",
    ],
)
def test_a_polynomial_is_printed_with_no_more_operations_and_the_same_value(text: str):
    given = parse(text, ("a", "d", "q1", "q2")).sympy()
    printed = polynomial(given).expression()
    assert sp.expand(printed - given) == 0
    assert sp.count_ops(printed) <= sp.count_ops(sp.expand(given))


def test_the_derivative_of_a_polynomial_is_sympys():
    q, a = sp.Symbol("q1", real=True), sp.Symbol("a", real=True)
    given = a * q**2 * sp.cos(2 * q) - q * sp.sin(q) * sp.cos(q) + a
    assert sp.expand(polynomial(given).diff(q).expression() - sp.diff(given, q)) == 0


def test_a_square_of_a_sine_becomes_one_of_the_cosine():
    q, p = sp.Symbol("q1", real=True), sp.Symbol("q2", real=True)
    given = polynomial(sp.sin(q) ** 5 * sp.cos(p) + sp.sin(q) ** 2 + sp.cos(q) ** 2)
    left = reduced(given)
    assert (
        sp.expand(left.expression() - ((1 - sp.cos(q) ** 2) ** 2 * sp.sin(q) * sp.cos(p) + 1)) == 0
    )


def test_planar_entries_are_those_of_the_textbook():
    arm = ROBOTS["planar_2r"]
    l1, l2, s1, s12, c1, c12 = (
        sp.Symbol(name, real=True) for name in ("l1", "l2", "s_1", "s_12", "c_1", "c_12")
    )
    expected = sp.Matrix([[-l1 * s1 - l2 * s12, -l2 * s12], [l1 * c1 + l2 * c12, l2 * c12]])
    assert shorthand(arm.symbolic().J[:2, :]) == expected
    assert sp.latex(shorthand(arm.symbolic().J[0, 1])) == "- l_{2} s_{12}"


def test_shorthand_keeps_what_is_no_sum_of_joints():
    q1, q2, a = (sp.Symbol(name, real=True) for name in ("q1", "q2", "a"))
    kept = sp.cos(q1 - q2) + sp.sin(q1 + sp.pi / 5) + sp.cos(2 * q1) + sp.sin(a)
    assert shorthand(kept) == kept
    assert shorthand(a * sp.cos(q2 + q1)) == a * sp.Symbol("c_12", real=True)


def test_a_flipped_parallel_axis_subtracts_its_angle():
    J = closed_form(EXTRA).J
    assert J.atoms(sp.cos) <= {sp.cos(x) for x in _angles()}


def _angles() -> list[sp.Expr]:
    q1, q2, q4 = (sp.Symbol(f"q{i}", real=True) for i in (1, 2, 4))
    return [q1, q1 + q2, q1 + q2 - q4, -q1 - q2 + q4]
