"""The traced Jacobian against finite differences, printed numbers of S0, and its own promises."""

import math
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Literal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kinegrade.solutions.chain import (
    Array,
    Chain,
    ChainError,
    elementary,
    from_frames,
    from_standard,
)
from kinegrade.solutions.jacobian import at_point, in_axes, jacobian, last_frame_columns
from kinegrade.solutions.kinematics import forward, frames
from kinegrade.solutions.program.emit import BLOCK, direct, half_angle, rows, used_angles
from kinegrade.solutions.program.walk import trace
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.rotation import vector_rotation

STEP = 1e-3
PUMA = ROBOTS["puma560"]
TWO = np.zeros((2, 6))


def differenced(chain: Chain, q: Array) -> Array:
    """Base-frame Jacobian (6, n) from five-point differences of forward().

    dp stands above the axial vector of dR R^T.
    """
    columns = list[Array]()
    R = forward(chain, q)[:3, :3]
    for direction in np.eye(chain.n):
        T = [forward(chain, q + k * STEP * direction) for k in (-2, -1, 1, 2)]
        slope = (T[0] - 8 * T[1] + 8 * T[2] - T[3]) / (12 * STEP)
        W = slope[:3, :3] @ R.T
        columns.append(np.array([*slope[:3, 3], W[2, 1], W[0, 2], W[1, 0]]))
    return np.array(columns).T


def rotated(chain: Chain, q: Array, J: Array) -> Array:
    """A base-frame Jacobian in axes of the tool."""
    R = forward(chain, q)[..., :3, :3].swapaxes(-1, -2)
    return np.concatenate([R @ J[..., :3, :], R @ J[..., 3:, :]], axis=-2)


angles = st.sampled_from([0.0, math.pi / 2, -math.pi / 2, math.pi]) | st.floats(-3.0, 3.0)
lengths = st.just(0.0) | st.floats(-1.0, 1.0)


@st.composite
def chains(draw: st.DrawFn) -> tuple[Chain, Array]:
    """Random arms of one to eight joints, with parallel axes and links of no length."""
    kinds = "".join(draw(st.lists(st.sampled_from("RP"), min_size=1, max_size=8)))
    table = [[draw(angles), draw(lengths), draw(lengths), draw(angles)] for _ in kinds]
    ends = [elementary("Ry", draw(angles)) @ elementary("Tx", draw(lengths)) for _ in range(2)]
    q = np.array([draw(angles) for _ in kinds])
    return from_standard(table, kinds, base=ends[0], tool=ends[1]), q


@given(chains())
@settings(max_examples=60, deadline=None)
def test_every_jacobian_agrees_with_finite_differences(arm: tuple[Chain, Array]):
    chain, q = arm
    expected = differenced(chain, q)
    np.testing.assert_allclose(jacobian(chain, q), expected, rtol=0, atol=1e-9)
    np.testing.assert_allclose(jacobian(chain, q[None])[0], expected, rtol=0, atol=1e-9)


@given(chains())
@settings(max_examples=60, deadline=None)
def test_the_tool_frame_jacobian_is_the_base_frame_one_rotated(arm: tuple[Chain, Array]):
    chain, q = arm
    expected = rotated(chain, q, jacobian(chain, q))
    np.testing.assert_allclose(jacobian(chain, q, "tool"), expected, rtol=0, atol=1e-12)
    np.testing.assert_allclose(jacobian(chain, q[None], "tool")[0], expected, rtol=0, atol=1e-12)


@given(chains())
@settings(max_examples=30, deadline=None)
def test_the_columns_of_s1_5_26_and_5_27_are_the_tool_frame_jacobian(arm: tuple[Chain, Array]):
    chain, q = arm
    reached = frames(chain, q)
    columns = last_frame_columns(np.linalg.inv(reached[:-1]) @ reached[-1], chain.kinds)
    np.testing.assert_allclose(columns, jacobian(chain, q, "tool"), rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", ROBOTS)
def test_the_jacobian_of_a_robot_agrees_with_finite_differences(name: str):
    robot, rng = ROBOTS[name], np.random.default_rng(1)
    low, high = np.array(robot.limits).T
    for q in rng.uniform(low, high, (5, robot.n)):
        np.testing.assert_allclose(
            jacobian(robot.chain(), q), differenced(robot.chain(), q), rtol=0, atol=1e-9
        )


@pytest.mark.parametrize("batched", [False, True])
def test_s0_section_4_3_1_comes_out_as_printed(batched: bool):
    chain = ROBOTS["three_axis"].chain({"L": 3, "a2": 2, "a3": 2})
    q: Any = (0, -math.pi / 6, math.pi / 6)
    reached = frames(chain, [q])[0] if batched else frames(chain, q)
    J = jacobian(chain, [q])[0] if batched else jacobian(chain, q)
    r3 = math.sqrt(3)
    p = [[0, 0, 3], [0, 0, 3], [1, 0, 3 + r3], [3, 0, 3 + r3]]
    z = [[0, 0, 1], [0, -1, 0], [0, -1, 0]]
    A = [[0, -r3, 0], [3, 0, 0], [0, 3, 2]]
    B = [[0, 0, 0], [0, -1, -1], [1, 0, 0]]
    np.testing.assert_allclose(reached[:, :3, 3], p, rtol=0, atol=1e-14)
    np.testing.assert_allclose(reached[:3, :3, 2], z, rtol=0, atol=1e-14)
    np.testing.assert_allclose(J[:3], A, rtol=0, atol=1e-14)
    np.testing.assert_allclose(J[3:], B, rtol=0, atol=1e-14)
    assert np.linalg.det(J[:3]) == pytest.approx(6 * r3, abs=1e-12)


@pytest.mark.parametrize("frame", ["base", "tool"])
@pytest.mark.parametrize("size", [1, BLOCK - 1, BLOCK, 2 * BLOCK + 5])
def test_a_batch_of_any_size_is_its_single_configurations(
    frame: Literal["base", "tool"], size: int
):
    chain, q = PUMA.chain(), np.random.default_rng(size).uniform(-3, 3, (size, 6))
    J = jacobian(chain, q, frame)
    for k in {0, size // 2, min(BLOCK, size - 1), size - 1}:
        np.testing.assert_allclose(J[k], jacobian(chain, q[k], frame), rtol=0, atol=1e-14)


def test_strided_and_integer_input_is_read_as_it_stands():
    chain, q = PUMA.chain(), np.random.default_rng(3).uniform(-3, 3, (6, 40)).T[::2]
    np.testing.assert_array_equal(jacobian(chain, q), jacobian(chain, q.copy()))
    np.testing.assert_array_equal(
        jacobian(chain, [1, 0, 2, 0, 1, 0]), jacobian(chain, [1.0, 0, 2, 0, 1, 0])
    )


def test_a_result_is_written_where_asked():
    chain, q = PUMA.chain(), np.random.default_rng(4).uniform(-3, 3, (3, 5, 6))
    out = np.full((3, 5, 6, 6), np.nan)
    assert jacobian(chain, q, out=out) is out
    np.testing.assert_array_equal(out, jacobian(chain, q))
    one = np.full((6, 6), np.nan)
    assert jacobian(chain, q[0, 0], "tool", out=one) is one
    np.testing.assert_allclose(one, jacobian(chain, q[0, 0], "tool"), rtol=0, atol=1e-14)


READ_ONLY = np.empty((6, 6))
READ_ONLY.flags.writeable = False


@pytest.mark.parametrize(
    ("out", "found"),
    [
        (np.empty((6, 5)), r"float64 of shape \(6, 5\)"),
        (np.empty((1, 6, 6)), r"float64 of shape \(1, 6, 6\)"),
        (np.empty((6, 6), dtype=np.float32), r"float32 of shape \(6, 6\)"),
        (np.empty((6, 6), dtype=">f8"), r">f8 of shape \(6, 6\)"),
        (np.empty((6, 12))[:, ::2], "strides that are not C-contiguous"),
        (READ_ONLY, "a read-only one"),
        ([[0.0] * 6] * 6, "a list"),
    ],
)
@pytest.mark.parametrize("point", [None, "origin"])
def test_an_unfit_output_array_is_refused_with_a_sentence(out: Any, found: str, point: Any):
    sentence = rf"out takes a writable, C-contiguous array, float64 of shape \(6, 6\), got {found}$"
    with pytest.raises(ChainError, match=sentence):
        jacobian(PUMA.chain(), np.zeros(6), out=out, point=point)


def test_an_unknown_frame_is_refused_with_a_sentence():
    wrong: Any = "world"
    with pytest.raises(ChainError, match="frame takes 'base' or 'tool', got 'world'"):
        jacobian(PUMA.chain(), np.zeros(6), wrong)


def test_axes_may_be_any_rotation_and_the_named_frames_are_two_of_them():
    chain, q = PUMA.chain(), np.random.default_rng(6).uniform(-3, 3, (4, 6))
    R = forward(chain, q)[:, :3, :3]
    np.testing.assert_array_equal(jacobian(chain, q, np.eye(3)), jacobian(chain, q))
    np.testing.assert_allclose(
        jacobian(chain, q, R), jacobian(chain, q, "tool"), rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(
        in_axes(jacobian(chain, q), R), jacobian(chain, q, "tool"), rtol=0, atol=1e-14
    )


def test_the_point_may_be_any_and_the_tool_point_and_the_origin_are_two_of_them():
    chain, q = PUMA.chain(), np.random.default_rng(7).uniform(-3, 3, (4, 6))
    p = forward(chain, q)[:, :3, 3]
    np.testing.assert_array_equal(jacobian(chain, q, point=p), jacobian(chain, q))
    np.testing.assert_array_equal(
        jacobian(chain, q, point="origin"), jacobian(chain, q, point=(0, 0, 0))
    )
    np.testing.assert_allclose(
        jacobian(chain, q, "tool", point=p), jacobian(chain, q, "tool"), rtol=0, atol=1e-14
    )
    # axis 1 passes through the origin
    np.testing.assert_allclose(jacobian(chain, q, point="origin")[:, :3, 0], 0, rtol=0, atol=1e-15)


def test_at_the_origin_a_column_is_the_screw_of_its_axis():
    chain, q = PUMA.chain(), np.random.default_rng(8).uniform(-3, 3, 6)
    reached = frames(chain, q)[:-1, :3]
    screws = np.concatenate(
        [np.cross(reached[..., 3], reached[..., 2]), reached[..., 2]], axis=-1
    ).T
    np.testing.assert_allclose(jacobian(chain, q, point="origin"), screws, rtol=0, atol=1e-14)


def test_a_twist_moves_with_its_jacobian():
    chain, q, qdot = PUMA.chain(), np.full(6, 0.3), np.arange(6.0)
    R, r = vector_rotation([0.3, 0.4, -0.2]), np.array([0.1, 0.2, 0.3])
    xi = jacobian(chain, q) @ qdot
    v, w = xi[:3], xi[3:]
    np.testing.assert_allclose(
        at_point(xi[:, None], r)[:, 0], [*(v + np.cross(w, r)), *w], rtol=0, atol=1e-15
    )
    np.testing.assert_allclose(
        in_axes(xi[:, None], R)[:, 0], [*(R.T @ v), *(R.T @ w)], rtol=0, atol=1e-15
    )


@pytest.mark.parametrize(
    ("q", "frame", "point", "batch"),
    [
        ((), (), (), ()),
        ((4,), (), (), (4,)),
        ((), (4,), (), (4,)),
        ((), (), (4,), (4,)),
        ((2, 1), (3,), (2, 3), (2, 3)),
    ],
)
def test_configurations_axes_and_points_broadcast(q: Any, frame: Any, point: Any, batch: Any):
    R = np.broadcast_to(np.eye(3), (*frame, 3, 3))
    assert jacobian(PUMA.chain(), np.full((*q, 6), 0.3), R, point=np.ones((*point, 3))).shape == (
        *batch,
        6,
        6,
    )


def test_a_result_elsewhere_is_written_where_asked():
    chain, q, out = PUMA.chain(), np.full((3, 6), 0.3), np.full((3, 6, 6), np.nan)
    assert jacobian(chain, q, np.eye(3), out, point="origin") is out
    np.testing.assert_array_equal(out, jacobian(chain, q, point="origin"))
    with pytest.raises(
        ChainError, match=r"float64 of shape \(3, 6, 6\), got float64 of shape \(2, 6, 6\)"
    ):
        jacobian(chain, q, point="origin", out=out[:2])


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: jacobian(PUMA.chain(), TWO, 2 * np.eye(3)), "frame takes right-handed rotations"),
        (
            lambda: jacobian(PUMA.chain(), TWO, np.eye(4)),
            r"frame takes shape \(\.\.\., 3, 3\), got \(4, 4\)",
        ),
        (
            lambda: jacobian(PUMA.chain(), TWO, np.stack([np.eye(3)] * 3)),
            r"frame takes a batch that fits \(2,\), got \(3,\)",
        ),
        (lambda: jacobian(PUMA.chain(), TWO, None), "frame takes real numbers"),
        (
            lambda: jacobian(PUMA.chain(), TWO, "world", point="origin"),
            "frame takes 'base' or 'tool', got 'world'",
        ),
        (
            lambda: jacobian(PUMA.chain(), TWO, point="elbow"),
            r"point takes 'origin' or coordinates \(\.\.\., 3\), got 'elbow'",
        ),
        (
            lambda: jacobian(PUMA.chain(), TWO, point=[1.0, 2.0]),
            r"point takes 'origin' or coordinates .* got shape \(2,\)",
        ),
        (
            lambda: jacobian(PUMA.chain(), TWO, point=[1.0, 2.0, np.nan]),
            "point takes finite numbers",
        ),
        (
            lambda: jacobian(PUMA.chain(), TWO, point=np.ones((3, 3))),
            r"point takes a batch that fits \(2,\), got \(3,\)",
        ),
        (
            lambda: in_axes(np.ones((3, 6)), np.eye(3)),
            r"J takes shape \(\.\.\., 6, n\), got \(3, 6\)",
        ),
        (
            lambda: in_axes(np.ones((2, 6, 1)), np.stack([np.eye(3)] * 3)),
            "rotation takes a batch that fits",
        ),
        (lambda: at_point(np.ones(6), [1, 2, 3]), r"J takes shape \(\.\.\., 6, n\), got \(6,\)"),
        (
            lambda: at_point(np.ones((6, 1)), [1, 2]),
            r"offset takes shape \(\.\.\., 3\), got \(2,\)",
        ),
        (
            lambda: at_point(np.ones((2, 6, 1)), np.ones((3, 3))),
            r"offset takes a batch that fits \(2,\)",
        ),
    ],
)
def test_unfit_axes_and_points_are_refused_with_a_sentence(call: Any, sentence: str):
    with pytest.raises(ChainError, match=sentence):
        call()


@pytest.mark.parametrize(("count", "kinds"), [(2, "RRR"), (3, "RXR")])
def test_transforms_that_do_not_fit_the_joints_are_refused(count: int, kinds: str):
    with pytest.raises(ChainError, match=r"transforms takes shape \(3, 4, 4\)"):
        last_frame_columns([np.eye(4)] * count, kinds)


def test_results_never_share_memory():
    chain, q = PUMA.chain(), np.zeros(6)
    first = jacobian(chain, q)
    first[:] = 7
    assert not (jacobian(chain, q) == 7).any()


def test_threads_may_share_a_chain():
    chain = ROBOTS["puma560"].chain({"a2": 0.5})
    batches = [np.random.default_rng(k).uniform(-3, 3, (3000, 6)) for k in range(8)]
    with ThreadPoolExecutor(8) as pool:
        together = list(pool.map(lambda q: jacobian(chain, q), batches))
    for J, q in zip(together, batches, strict=True):
        np.testing.assert_array_equal(J, jacobian(chain, q))


def test_a_program_is_compiled_once_and_kept_on_its_chain():
    chain = from_standard([[0, 0, 1, 0]], "R")
    assert not chain.compiled
    jacobian(chain, [0.1])
    kept = dict(chain.compiled)
    jacobian(chain, [[0.2]])
    assert list(kept) == ["base"]
    assert chain.compiled == kept


def test_the_puma_program_shares_products_and_merges_parallel_axes():
    program = trace(PUMA.chain(), "base")
    assert len(program.steps) <= 75
    used = {program.angles[i] for i in used_angles(program)}
    assert used == {((1, 0),), ((1, 1),), ((1, 1), (1, 2)), ((1, 3),), ((1, 4),)}


@pytest.mark.parametrize(
    ("turn", "expected"),
    [
        (np.eye(4), ((1, 0), (1, 1))),
        (elementary("Rz", 0.7), ((1, 0), (1, 1))),
        (elementary("Rx", math.pi), ((1, 0), (-1, 1))),
        (elementary("Ry", math.pi), ((1, 0), (-1, 1))),
    ],
)
def test_parallel_axes_share_one_angle_however_they_are_offset_or_turned(
    turn: Array, expected: Any
):
    chain = from_frames([np.eye(4), elementary("Tx", 0.5) @ turn], "RR", tool=elementary("Tx", 0.3))
    assert expected in trace(chain, "base").angles
    q = np.array([0.4, 0.9])
    np.testing.assert_allclose(jacobian(chain, q), differenced(chain, q), rtol=0, atol=1e-9)


def test_axes_that_are_almost_parallel_keep_their_own_angles():
    chain = from_frames([np.eye(4), elementary("Rx", 1e-10)], "RR", tool=elementary("Tx", 1.0))
    q = np.array([0.4, 0.9])
    np.testing.assert_allclose(
        jacobian(chain, q, "tool"), rotated(chain, q, jacobian(chain, q)), rtol=0, atol=1e-15
    )
    assert jacobian(chain, [0.0, 0.0])[4, 1] == -1e-10


def test_constant_columns_cost_no_steps():
    assert trace(from_standard([[0, 0, 0, 0]] * 3, "PPP"), "base").steps == ()
    assert len(trace(ROBOTS["planar_2r"].chain(), "base").steps) == 4


@pytest.mark.parametrize("frame", ["base", "tool"])
@pytest.mark.parametrize("name", ROBOTS)
def test_constant_zeros_have_no_sign(name: str, frame: Literal["base", "tool"]):
    constants = [x for x in trace(ROBOTS[name].chain(), frame).outputs if isinstance(x, float)]
    assert not any(math.copysign(1, x) < 0 for x in constants if x == 0)


@pytest.mark.parametrize("turn", [half_angle, direct])
def test_cosines_and_sines_are_exact_to_the_last_digits(turn: Any):
    angle = np.concatenate(
        [np.linspace(-20, 20, 4001), np.array([0.0, math.pi, -math.pi, math.pi / 2, 1e-300])]
    )
    cosine, sine = np.empty_like(angle), np.empty_like(angle)
    turn(angle, cosine, sine)
    np.testing.assert_allclose(cosine, np.cos(angle), rtol=0, atol=6e-16)
    np.testing.assert_allclose(sine, np.sin(angle), rtol=0, atol=6e-16)


def test_rows_with_numpys_own_sines_give_the_same_jacobian():
    program, q = trace(PUMA.chain(), "base"), np.random.default_rng(5).uniform(-3, 3, (50, 6))
    out = np.empty((50, 36))
    rows(program, direct)(q, out)
    np.testing.assert_allclose(out.reshape(50, 6, 6), jacobian(PUMA.chain(), q), rtol=0, atol=1e-14)
