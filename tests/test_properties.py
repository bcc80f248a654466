"""What holds for every chain: random arms of one to twelve joints, with links of no length and of any scale."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kinegrade.solutions.analytic import analytic_jacobian
from kinegrade.solutions.chain import (
    Array,
    Chain,
    ChainError,
    elementary,
    from_modified,
    from_standard,
    product,
)
from kinegrade.solutions.derivatives import hessian, jacobian_dot
from kinegrade.solutions.inverse import displacement, inverse_kinematics
from kinegrade.solutions.jacobian import at_point, in_axes, jacobian
from kinegrade.solutions.kinematics import forward, frames
from kinegrade.solutions.rotation import vector_rotation
from kinegrade.solutions.velocity import (
    damped_inverse,
    joint_rates,
    null_projector,
    pseudoinverse,
    twist,
)

STEP = 1e-3
Arm = tuple[Chain, Array]

angles = st.sampled_from([0.0, math.pi / 2, -math.pi / 2, math.pi]) | st.floats(-3.0, 3.0)
lengths = st.just(0.0) | st.floats(-1.0, 1.0)
vectors = st.tuples(*[st.floats(-2.0, 2.0)] * 3).map(np.array)
poses = st.builds(lambda w, p: _transform(vector_rotation(w), p), vectors, vectors)
quick = settings(max_examples=15, deadline=None)


@st.composite
def arms(draw: st.DrawFn, least: int = 1, most: int = 12) -> Arm:
    """A chain and a configuration of it: any table, base and tool, revolute and prismatic joints."""
    kinds = "".join(draw(st.lists(st.sampled_from("RRP"), min_size=least, max_size=most)))
    table = [[draw(angles), draw(lengths), draw(lengths), draw(angles)] for _ in kinds]
    build = draw(st.sampled_from([from_standard, from_modified]))
    return build(table, kinds, base=draw(poses), tool=draw(poses)), np.array(
        [draw(angles) for _ in kinds]
    )


def _transform(R: Array, p: Array) -> Array:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T


def inverted(T: Array) -> Array:
    return _transform(T[:3, :3].T, -T[:3, :3].T @ T[:3, 3])


def scaled(chain: Chain, scale: float) -> Chain:
    fixed = chain.fixed.copy()
    fixed[:, :3, 3] *= scale
    return Chain(fixed, chain.kinds)


def slope(function: Callable[[Array], Array], q: Array, direction: Array) -> Array:
    at = [function(q + k * STEP * direction) for k in (-2, -1, 1, 2)]
    return (at[0] - 8 * at[1] + 8 * at[2] - at[3]) / (12 * STEP)


def differenced(chain: Chain, q: Array) -> Array:
    """Jacobian (6, n) from differences of the pose multiplied out, which shares no code with the traced program."""
    columns, R = list[Array](), plain(chain, q)[:3, :3]
    for direction in np.eye(chain.n):
        change = slope(lambda x: plain(chain, x), q, direction)
        W = change[:3, :3] @ R.T
        columns.append(np.array([*change[:3, 3], W[2, 1], W[0, 2], W[1, 0]]))
    return np.transpose(columns)


def plain(chain: Chain, q: Array) -> Array:
    """C0 E1 C1 ... En Cn, multiplied out; the joints' own motions are not snapped."""
    turned = [
        _transform(vector_rotation([0, 0, x]), np.zeros(3)) if kind == "R" else elementary("Tz", x)
        for kind, x in zip(chain.kinds, q, strict=True)
    ]
    return product(
        [chain.fixed[0], *(m for E, C in zip(turned, chain.fixed[1:], strict=True) for m in (E, C))]
    )


def magnitude(chain: Chain, q: Array) -> float:
    """Bound of every length in the arm [m], at least 1: errors are measured in it."""
    slides = sum(abs(x) for kind, x in zip(chain.kinds, q, strict=True) if kind == "P")
    return max(1.0, float(np.linalg.norm(chain.fixed[:, :3, 3], axis=-1).sum() + slides))


@given(arms())
@quick
def test_the_jacobian_agrees_with_finite_differences(arm: Arm):
    chain, q = arm
    np.testing.assert_allclose(
        jacobian(chain, q), differenced(chain, q), rtol=0, atol=1e-10 * magnitude(chain, q)
    )


@pytest.mark.parametrize("n", [1, 12])
@given(data=st.data())
@settings(max_examples=8, deadline=None)
def test_one_joint_and_twelve_are_as_good_as_six(n: int, data: st.DataObject):
    chain, q = data.draw(arms(n, n))
    size = magnitude(chain, q)
    np.testing.assert_allclose(forward(chain, q), plain(chain, q), rtol=0, atol=1e-14 * size)
    np.testing.assert_allclose(jacobian(chain, q), differenced(chain, q), rtol=0, atol=1e-10 * size)
    assert hessian(chain, q).shape == (6, n, n)
    xi = twist(chain, q, np.ones(n))
    np.testing.assert_allclose(
        twist(chain, q, joint_rates(chain, q, xi)), xi, rtol=0, atol=1e-7 * size
    )


@given(arms(), st.integers(1, 3))
@quick
def test_a_batch_gives_the_numbers_of_its_single_configurations(arm: Arm, count: int):
    chain, q = arm
    batch = q + np.arange(count)[:, None] * 0.1
    tolerance = 1e-13 * magnitude(chain, np.abs(batch).max(axis=0)) ** 2
    qdot = np.cos(batch)
    for of in (
        lambda x: forward(chain, x),
        lambda x: frames(chain, x),
        lambda x: jacobian(chain, x),
        lambda x: jacobian(chain, x, "tool"),
        lambda x: jacobian(chain, x, point="origin"),
        lambda x: hessian(chain, x),
        lambda x: jacobian_dot(chain, x, qdot if x.ndim == 2 else qdot[-1], "tool"),
    ):
        np.testing.assert_allclose(of(batch)[-1], of(batch[-1]), rtol=0, atol=tolerance)


@given(arms(), vectors, vectors)
@quick
def test_a_jacobian_at_any_point_in_any_axes_has_the_columns_of_its_definition(
    arm: Arm, w: Array, point: Array
):
    chain, q = arm
    R, reached = vector_rotation(w), frames(chain, q)[:-1]
    z, o = reached[:, :3, 2], reached[:, :3, 3]
    turns = np.array([kind == "R" for kind in chain.kinds])[:, None]
    linear, angular = np.where(turns, np.cross(z, point - o), z), np.where(turns, z, 0.0)
    expected = np.concatenate([R.T @ linear.T, R.T @ angular.T])
    found = jacobian(chain, q, R, point=point)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14 * magnitude(chain, q) * 10)


@given(arms(), vectors, vectors, vectors, vectors)
@quick
def test_changes_of_axes_and_point_compose_and_have_inverses(
    arm: Arm, a: Array, b: Array, r: Array, s: Array
):
    chain, q = arm
    J, A, B = jacobian(chain, q), vector_rotation(a), vector_rotation(b)
    tolerance = 1e-14 * magnitude(chain, q) * 10
    np.testing.assert_allclose(in_axes(in_axes(J, A), B), in_axes(J, A @ B), rtol=0, atol=tolerance)
    np.testing.assert_allclose(in_axes(in_axes(J, A), A.T), J, rtol=0, atol=tolerance)
    np.testing.assert_allclose(
        at_point(at_point(J, r), s), at_point(J, r + s), rtol=0, atol=tolerance
    )
    np.testing.assert_allclose(
        in_axes(at_point(J, r), A), at_point(in_axes(J, A), A.T @ r), rtol=0, atol=tolerance
    )


@given(arms())
@quick
def test_the_reversed_chain_sees_the_base_move_as_the_tool_does_not(arm: Arm):
    chain, q = arm
    backwards = Chain(np.array([inverted(C) for C in chain.fixed[::-1]]), chain.kinds[::-1])
    T, tolerance = forward(chain, q), 1e-13 * magnitude(chain, q)
    np.testing.assert_allclose(forward(backwards, -q[::-1]), inverted(T), rtol=0, atol=tolerance)
    # its joints run the other way, and so does the motion that it sees: the signs cancel
    found = jacobian(backwards, -q[::-1])[:, ::-1]
    np.testing.assert_allclose(
        found, jacobian(chain, q, T[:3, :3], point="origin"), rtol=0, atol=tolerance
    )


@given(arms(), poses)
@quick
def test_a_twist_turns_with_its_base_and_does_not_see_where_it_stands(arm: Arm, placed: Array):
    chain, q = arm
    moved = Chain(np.concatenate([(placed @ chain.fixed[0])[None], chain.fixed[1:]]), chain.kinds)
    qdot, tolerance = np.cos(np.arange(chain.n)), 1e-13 * magnitude(chain, q)
    expected = in_axes(twist(chain, q, qdot)[:, None], placed[:3, :3].T)[:, 0]
    np.testing.assert_allclose(twist(moved, q, qdot), expected, rtol=0, atol=tolerance)
    np.testing.assert_allclose(
        twist(moved, q, qdot, "tool"), twist(chain, q, qdot, "tool"), rtol=0, atol=tolerance
    )


@given(arms(), poses)
@quick
def test_another_tool_moves_the_point_by_its_offset(arm: Arm, tool: Array):
    chain, q = arm
    held = Chain(np.concatenate([chain.fixed[:-1], (chain.fixed[-1] @ tool)[None]]), chain.kinds)
    offset = forward(chain, q)[:3, :3] @ tool[:3, 3]
    expected, tolerance = at_point(jacobian(chain, q), offset), 1e-13 * magnitude(chain, q)
    np.testing.assert_allclose(jacobian(held, q), expected, rtol=0, atol=tolerance)
    np.testing.assert_allclose(
        jacobian(chain, q, point=forward(chain, q)[:3, 3] + offset),
        expected,
        rtol=0,
        atol=tolerance,
    )


@given(arms(most=7))
@quick
def test_hessian_and_time_derivative_agree_with_finite_differences(arm: Arm):
    chain, q = arm
    tolerance = 1e-9 * magnitude(chain, q)
    for k, direction in enumerate(np.eye(chain.n)):
        expected = slope(lambda x: jacobian(chain, x), q, direction)
        np.testing.assert_allclose(hessian(chain, q)[..., k], expected, rtol=0, atol=tolerance)
    qdot = np.cos(np.arange(chain.n))
    expected = slope(lambda x: jacobian(chain, x, "tool"), q, qdot)
    np.testing.assert_allclose(
        jacobian_dot(chain, q, qdot, "tool"), expected, rtol=0, atol=100 * tolerance
    )


@pytest.mark.parametrize("scale", [1e6, 1e-6])
@given(arm=arms())
@settings(max_examples=10, deadline=None)
def test_huge_and_tiny_lengths_scale_the_linear_rows_and_nothing_else(scale: float, arm: Arm):
    chain, q = arm
    slides = np.array([kind == "P" for kind in chain.kinds])
    other, there = scaled(chain, scale), np.where(slides, scale * q, q)
    unit = np.where(slides, 1.0, scale) * np.array([1.0, 1, 1, 0, 0, 0])[:, None]
    unit += np.array([0.0, 0, 0, 1, 1, 1])[:, None]
    tolerance = 1e-13 * magnitude(chain, q)
    np.testing.assert_allclose(
        jacobian(other, there) / unit, jacobian(chain, q), rtol=0, atol=tolerance
    )
    np.testing.assert_allclose(
        forward(other, there)[:3, 3] / scale, forward(chain, q)[:3, 3], rtol=0, atol=tolerance
    )


@pytest.mark.parametrize("n", [1, 3, 12])
@pytest.mark.parametrize("build", [from_standard, from_modified])
def test_an_arm_of_links_of_no_length_only_turns(build: Callable[..., Chain], n: int):
    chain = build(np.column_stack([np.zeros((n, 3)), np.full(n, 0.4)]), "R" * n)
    q = np.linspace(-1, 1, n)
    J = jacobian(chain, q)
    np.testing.assert_array_equal(J[:3], 0)
    np.testing.assert_allclose(np.linalg.norm(J[3:], axis=0), 1, rtol=0, atol=1e-14)
    assert not hessian(chain, q)[:3].any()


FUNCTIONS: dict[str, Callable[[Chain, Any], Array]] = {
    "forward": forward,
    "frames": frames,
    "jacobian": jacobian,
    "jacobian in the tool frame": lambda chain, q: jacobian(chain, q, "tool"),
    "jacobian at the origin": lambda chain, q: jacobian(chain, q, np.eye(3), point="origin"),
    "hessian": hessian,
    "jacobian_dot": lambda chain, q: jacobian_dot(chain, q, q),
    "twist": lambda chain, q: twist(chain, q, np.ones(4)),
    "joint_rates": lambda chain, q: joint_rates(chain, q, np.ones(6)),
    "damped rates": lambda chain, q: joint_rates(chain, q, np.ones(6), damping=0.1, preferred=q),
    "analytic_jacobian": lambda chain, q: analytic_jacobian(chain, q, "ZYZ"),
}
SAMPLE = from_standard(
    [[0, 0.4, 0.1, 1.2], [0.3, 0, 0.5, 0.2], [0, 0.2, 0, -1.1], [0.2, 0, 0.3, 0.8]], "RRPR"
)
Q = np.random.default_rng(8).uniform(0.5, 2.5, (5, 4))
every = pytest.mark.parametrize("name", FUNCTIONS)


@every
@pytest.mark.parametrize("dtype", [np.float32, np.float16, np.int64, np.int8, np.uint8])
def test_other_numbers_are_read_as_float64(name: str, dtype: Any):
    q = (Q * 4).astype(dtype)
    found = FUNCTIONS[name](SAMPLE, q)
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, FUNCTIONS[name](SAMPLE, q.astype(np.float64)))


@every
def test_arrays_of_any_layout_are_read_and_never_written(name: str):
    expected = FUNCTIONS[name](SAMPLE, Q)
    frozen = Q.copy()
    frozen.flags.writeable = False
    strided = np.repeat(np.repeat(Q, 2, axis=0), 3, axis=1)[::2, ::3]
    backwards = Q[::-1, ::-1].copy()[::-1, ::-1]
    for q in (frozen, strided, backwards, np.asfortranarray(Q), Q.tolist(), Q.astype(">f8")):
        np.testing.assert_array_equal(FUNCTIONS[name](SAMPLE, q), expected)
    np.testing.assert_array_equal(frozen, Q)
    one = np.broadcast_to(Q[0], (3, 4))
    np.testing.assert_array_equal(
        FUNCTIONS[name](SAMPLE, one)[2], FUNCTIONS[name](SAMPLE, Q[:1])[0]
    )


@every
@pytest.mark.parametrize("shape", [(0,), (0, 3), (3, 0)])
def test_an_empty_batch_gives_an_empty_result(name: str, shape: tuple[int, ...]):
    found = FUNCTIONS[name](SAMPLE, np.zeros((*shape, 4)))
    assert found.shape == (*shape, *FUNCTIONS[name](SAMPLE, Q[0]).shape)


@every
@pytest.mark.parametrize(
    ("q", "sentence"),
    [
        (np.zeros(3), r"q takes shape \(\.\.\., 4\), got \(3,\)"),
        (np.float64(1.0), r"q takes shape \(\.\.\., 4\), got \(\)"),
        (np.zeros((4, 5)), r"q takes shape \(\.\.\., 4\), got \(4, 5\)"),
        (np.array([0.0, np.nan, 0.0, 0.0]), "q takes finite numbers, got NaN or infinity"),
        (np.array([0.0, 0.0, -np.inf, 0.0]), "q takes finite numbers, got NaN or infinity"),
        (np.array(["a"] * 4), "q takes real numbers"),
        (np.zeros(4, dtype=complex), "q takes real numbers"),
    ],
)
def test_what_is_no_configuration_is_refused_with_a_sentence(name: str, q: Any, sentence: str):
    with pytest.raises(ChainError, match=sentence):
        FUNCTIONS[name](SAMPLE, q)


@given(arms())
@quick
def test_rates_of_least_squares_leave_only_what_no_joint_can_move(arm: Arm):
    chain, q = arm
    J, xi = jacobian(chain, q), np.cos(np.arange(6.0))
    values = np.linalg.svd(J, compute_uv=False)
    if ((values > 1e-13 * values[0]) & (values < 1e-4 * values[0])).any():
        return  # too close to singular for a comparison of digits
    rates = joint_rates(chain, q, xi)
    np.testing.assert_allclose(
        J.T @ (J @ rates - xi), 0, rtol=0, atol=1e-9 * magnitude(chain, q) ** 2
    )
    N = null_projector(J)
    for found, expected in ((J @ N, 0 * J), (N @ N, N), (N.T, N)):
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-10 * magnitude(chain, q))
    assert np.trace(N) == pytest.approx(
        chain.n - np.linalg.matrix_rank(J, tol=1e-8 * values[0]), abs=1e-8
    )


@given(arms(), st.floats(1e-3, 10.0))
@quick
def test_damped_rates_solve_their_normal_equations_and_stay_bounded(arm: Arm, damping: float):
    chain, q = arm
    J, D = jacobian(chain, q), damped_inverse(jacobian(chain, q), damping)
    left = (J.T @ J + damping**2 * np.eye(chain.n)) @ D
    np.testing.assert_allclose(left, J.T, rtol=0, atol=1e-12 * magnitude(chain, q) ** 3 / damping)
    assert np.linalg.norm(D, 2) <= (1 + 1e-12) / (2 * damping)


@given(arms(most=7), st.integers(0, 2**32 - 1))
@quick
def test_inverse_kinematics_is_never_worse_than_its_start_and_says_what_it_reached(
    arm: Arm, seed: int
):
    chain, start = arm
    rng = np.random.default_rng(seed)
    limits = np.stack(
        [start - rng.uniform(0, 1, chain.n), start + rng.uniform(0, 1, chain.n)], axis=-1
    )
    target = forward(chain, start + rng.normal(0, 0.3, chain.n))
    found = inverse_kinematics(chain, target, start, limits=limits, iterations=40)
    missing = displacement(forward(chain, found.q), target)
    assert found.position_error == pytest.approx(np.linalg.norm(missing[:3]), abs=1e-12)
    assert found.rotation_error == pytest.approx(np.linalg.norm(missing[3:]), abs=1e-12)
    assert ((limits[:, 0] <= found.q) & (found.q <= limits[:, 1])).all()
    assert found.iterations <= 40
    if found.converged:
        assert found.rotation_error <= 1e-9
        assert found.position_error <= 1e-8 * magnitude(chain, np.abs(limits).max(axis=1))


@given(arms())
@quick
def test_the_pseudoinverse_of_a_transpose_is_the_transposed_pseudoinverse(arm: Arm):
    J = jacobian(*arm)
    values = np.linalg.svd(J, compute_uv=False)
    if not ((values > 1e-13 * values[0]) & (values < 1e-4 * values[0])).any():
        np.testing.assert_allclose(
            pseudoinverse(J.T), pseudoinverse(J).T, rtol=0, atol=1e-8 / values[0]
        )
