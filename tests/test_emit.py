"""Whatever path a Jacobian takes - plain math, rows, blocks, folds - it is the same Jacobian."""

import math
from typing import Any, Literal

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kinegrade.solutions.chain import Array, Chain, ChainError, elementary, snapped
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward, frames
from kinegrade.solutions.program.emit import (
    BLOCK,
    FEW,
    compiled,
    direct,
    evaluate,
    half_angle,
    plain,
    rows,
    used_angles,
)
from kinegrade.solutions.program.links import folded
from kinegrade.solutions.program.walk import trace
from kinegrade.solutions.robots import ROBOTS

PUMA = ROBOTS["puma560"].chain()
FRAMES: tuple[Literal["base", "tool"], ...] = ("base", "tool")


def oblique(kinds: str) -> Chain:
    """A chain whose links are turned and shifted anyhow, as nothing in the literature is."""
    rng = np.random.default_rng(len(kinds))
    links = [np.eye(4) for _ in range(len(kinds) + 1)]
    for link in links:
        for motion in ("Rz", "Rx", "Rz", "Tx", "Ty", "Tz"):
            link[:] = link @ elementary(
                motion, rng.uniform(-3, 3) if motion[0] == "R" else rng.uniform(-0.5, 0.5)
            )
    return Chain(np.array(links), kinds)


CHAINS = {name: robot.chain() for name, robot in ROBOTS.items()}
CHAINS |= {
    kinds: oblique(kinds) for kinds in ("R", "P", "RRPRRR", "RRRRRRR", "PRPRPR", "RRRRRRRRRRRR")
}
chains = pytest.mark.parametrize("name", CHAINS)


def textbook(chain: Chain, q: Array) -> tuple[Array, Array]:
    """Frames (n + 1, 4, 4) and base-frame Jacobian (6, n) by matmul and cross."""
    reached = [chain.fixed[0]]
    for kind, x, C in zip(chain.kinds, q, chain.fixed[1:], strict=True):
        reached.append(reached[-1] @ elementary("Rz" if kind == "R" else "Tz", x) @ C)
    p, columns = reached[-1][:3, 3], list[Array]()
    for kind, T in zip(chain.kinds, reached, strict=False):
        z, o = T[:3, 2], T[:3, 3]
        columns.append(np.concatenate([np.cross(z, p - o), z] if kind == "R" else [z, np.zeros(3)]))
    return np.array(reached), np.array(columns).T


@chains
def test_all_programs_are_what_matmul_and_cross_give(name: str):
    chain = CHAINS[name]
    for q in np.random.default_rng(1).uniform(-np.pi, np.pi, (4, chain.n)):
        reached, J = textbook(chain, q)
        R = reached[-1, :3, :3].T
        np.testing.assert_allclose(jacobian(chain, q), J, rtol=0, atol=1e-13)
        np.testing.assert_allclose(
            jacobian(chain, q, "tool"), np.vstack([R @ J[:3], R @ J[3:]]), rtol=0, atol=1e-13
        )
        np.testing.assert_allclose(forward(chain, q), reached[-1], rtol=0, atol=1e-13)
        np.testing.assert_allclose(frames(chain, q), reached, rtol=0, atol=1e-13)


@chains
@pytest.mark.parametrize("reach", [1e-8, math.pi, 100.0])
def test_rows_and_plain_math_give_the_same_numbers(name: str, reach: float):
    chain = CHAINS[name]
    q = np.random.default_rng(2).uniform(-reach, reach, (5 * FEW, chain.n))
    for frame in FRAMES:
        J = jacobian(chain, q, frame)
        for row, expected in zip(q, J, strict=True):
            np.testing.assert_allclose(jacobian(chain, row, frame), expected, rtol=0, atol=1e-13)


@chains
def test_rows_and_plain_math_agree_around_every_quarter_turn_up_to_100_radians(name: str):
    chain, turns = CHAINS[name], np.arange(-64, 65) * (math.pi / 2)
    beside = [
        turns,
        np.nextafter(turns, np.inf),
        np.nextafter(turns, -np.inf),
        turns + 1e-9,
        turns - 1e-5,
    ]
    q = np.concatenate(beside)[:, None] * np.where(np.arange(chain.n) % 2, 1.0, -1.0)
    J = jacobian(chain, q)
    for row, expected in zip(q, J, strict=True):
        np.testing.assert_allclose(jacobian(chain, row), expected, rtol=0, atol=1e-12)


def angles_everywhere() -> Array:
    """Multiples of a quarter turn and their neighbours, and angles of every size."""
    rng, turns = np.random.default_rng(3), np.arange(-200, 201) * (math.pi / 2)
    wide = [
        rng.uniform(-1, 1, 40) * 10.0**k for k in (-300, -160, -20, -8, 0, 1, 2, 4, 8, 16, 100, 300)
    ]
    far = np.round(rng.uniform(-3e5, 3e5, 50)) * math.pi
    return np.concatenate(
        [
            turns,
            np.nextafter(turns, np.inf),
            np.nextafter(turns, -np.inf),
            far,
            *wide,
            [0.0, 5e-324],
        ]
    )


@pytest.mark.parametrize("turn", [half_angle, direct])
def test_cosines_and_sines_are_right_to_the_last_digits_at_every_finite_angle(turn: Any):
    angle = angles_everywhere()
    cosine, sine = np.empty_like(angle), np.empty_like(angle)
    with np.errstate(divide="raise", over="raise", invalid="raise"):
        turn(angle, cosine, sine)
    with mpmath.workdps(360):
        exact = [
            (float(mpmath.cos(x)), float(mpmath.sin(x))) for x in map(mpmath.mpf, angle.tolist())
        ]
    np.testing.assert_allclose(cosine, [c for c, _ in exact], rtol=0, atol=6e-16)
    np.testing.assert_allclose(sine, [s for _, s in exact], rtol=0, atol=6e-16)


@pytest.mark.parametrize("turn", [half_angle, direct])
def test_cosine_and_sine_may_be_found_where_the_angle_lies(turn: Any):
    angle = np.linspace(-4, 4, 50)
    cosine, sine = np.empty_like(angle), angle.copy()
    turn(sine, cosine, sine)
    np.testing.assert_allclose(
        np.array([cosine, sine]), [np.cos(angle), np.sin(angle)], rtol=0, atol=6e-16
    )


@pytest.mark.parametrize("size", [0, 1, FEW, FEW + 1, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK + 7])
@pytest.mark.parametrize("name", ["puma560", "planar_2r", "PRPRPR"])
def test_no_size_of_a_batch_is_special(name: str, size: int):
    chain = CHAINS[name]
    q = np.random.default_rng(4).uniform(-3, 3, (size, chain.n))
    J = jacobian(chain, q)
    assert J.shape == (size, 6, chain.n)
    for k in {0, size // 2, size - 2, size - 1} & set(range(size)):
        np.testing.assert_allclose(J[k], jacobian(chain, q[k]), rtol=0, atol=1e-13)


def test_a_batch_of_one_configuration_equals_the_single_call_exactly():
    q = np.random.default_rng(5).uniform(-3, 3, 6)
    np.testing.assert_array_equal(jacobian(PUMA, q[None])[0], jacobian(PUMA, q))


@pytest.mark.parametrize("wanted", ["base", "tool", "pose", "frames"])
def test_rows_touch_nothing_but_their_own_part_of_a_larger_array(wanted: Any):
    q = np.random.default_rng(6).uniform(-3, 3, (40, 6))
    shape = compiled(PUMA, wanted).shape
    whole = np.full((50, *shape), 7.0)
    evaluate(PUMA, wanted, q, whole[5:45])
    np.testing.assert_array_equal(whole[5:45], evaluate(PUMA, wanted, q))
    assert (whole[:5] == 7).all()
    assert (whole[45:] == 7).all()


def test_blocks_in_one_output_array_reduce_like_one_batch():
    q = np.random.default_rng(7).uniform(-3, 3, (5000, 6))
    out = np.empty((1000, 6, 6))
    largest = max(
        np.abs(jacobian(PUMA, q[k : k + 1000], out=out)).max() for k in range(0, 5000, 1000)
    )
    assert largest == pytest.approx(np.abs(jacobian(PUMA, q)).max(), abs=1e-13)


def test_a_single_result_is_an_ordinary_array_of_its_own():
    q = np.zeros(6)
    jacobian(PUMA, q)
    for J in (jacobian(PUMA, q), jacobian(PUMA, q, "tool"), forward(PUMA, q)):
        assert J.flags.owndata
        assert J.flags.writeable
        assert J.flags.c_contiguous
        assert J.dtype == np.float64


@pytest.mark.parametrize(
    "q",
    [
        [0.0] * 6,
        np.zeros(6, dtype=np.float32),
        np.zeros(6, dtype=int),
        np.zeros((1, 6)),
        np.zeros((6, 6))[0].tolist(),
    ],
)
def test_only_one_float_array_is_a_plain_call_and_all_others_give_the_same(q: Any):
    jacobian(PUMA, np.zeros(6))
    assert plain(PUMA, "base", np.zeros(6)) is not None
    assert plain(PUMA, "base", q) is None
    np.testing.assert_array_equal(
        np.reshape(jacobian(PUMA, q), (6, 6)), jacobian(PUMA, np.zeros(6))
    )


@pytest.mark.parametrize(
    "bad", [[math.nan] + [0.0] * 5, [math.inf, -math.inf, 0.0, 0.0, 0.0, 0.0], [0.0] * 5]
)
def test_what_is_wrong_is_still_said_after_many_plain_calls(bad: list[float]):
    jacobian(PUMA, np.zeros(6))
    assert plain(PUMA, "base", np.array(bad)) is None
    with pytest.raises(ChainError, match="q takes"):
        jacobian(PUMA, np.array(bad))


def test_finite_values_with_an_infinite_sum_are_no_error():
    chain = CHAINS["PRPRPR"]
    q = np.array([1.5e308, 0.0, 1.5e308, 0.0, 0.0, 0.0])
    assert jacobian(chain, q).shape == jacobian(chain, q).shape == (6, 6)


def test_only_angles_that_are_read_cost_a_sine():
    program = trace(PUMA, "base")
    assert ((1, 5),) in program.angles
    assert ((1, 5),) not in {program.angles[i] for i in used_angles(program)}
    sizes = list[tuple[int, ...]]()

    def counted(angle: Array, cosine: Array, sine: Array) -> None:
        sizes.append(angle.shape)
        direct(angle, cosine, sine)

    rows(program, counted)(np.zeros((20, 6)), np.empty((20, 36)))
    assert sizes == [(5, 20)]


def test_levers_in_axes_of_their_joint_keep_programs_short():
    steps = {
        name: len(trace(ROBOTS[name].chain(), "base").steps)
        for name in ("puma560", "planar_2r", "ur5")
    }
    assert steps["puma560"] <= 47
    assert steps["planar_2r"] <= 4
    assert steps["ur5"] <= 47


def test_the_shorter_of_two_ways_to_the_tool_frame_is_taken():
    steps = {
        name: len(trace(ROBOTS[name].chain(), "tool").steps)
        for name in ("puma560", "stanford_spong")
    }
    assert steps["puma560"] <= 70  # levers in axes of their joint; 99 by cross products
    assert steps["stanford_spong"] <= 59  # by cross products; 67 otherwise


def test_steps_come_just_before_their_use():
    program = trace(CHAINS["RRRRRRR"], "base")
    first = {step.target: i for i, step in enumerate(program.steps)}
    last = {
        x: i for i, step in enumerate(program.steps) for x in (step.left, step.right) if x in first
    }
    waiting = [sum(first[x] < i <= last[x] for x in last) for i in range(len(program.steps))]
    assert max(waiting) < 40


def test_dense_turns_become_shifts_of_angles():
    program = trace(CHAINS["RRPRRR"], "base")
    assert any(program.shifts)
    assert len(program.steps) <= 300


@pytest.mark.parametrize("name", ROBOTS)
def test_arms_with_square_axes_keep_their_exact_quarter_turns(name: str):
    assert not any(trace(ROBOTS[name].chain(), "base").shifts)


turns = st.sampled_from([0.0, math.pi / 2, -math.pi / 2, math.pi, 1e-10, 1e-7]) | st.floats(
    -3.1, 3.1
)


@given(st.tuples(turns, turns, turns), st.sampled_from(["Rx", "Ry"]))
@settings(max_examples=200, deadline=None)
def test_a_folded_turn_is_the_same_turn(amounts: tuple[float, float, float], about: str):
    first, tilt, last = amounts
    C = snapped(
        elementary("Rz", first)
        @ elementary(about, tilt)
        @ elementary("Rz", last)
        @ elementary("Ty", 0.3)
    )
    before, D, behind = folded(C)
    np.testing.assert_allclose(
        elementary("Rz", before) @ D @ elementary("Rz", behind), C, rtol=0, atol=2e-15
    )
    assert np.count_nonzero(D[:3, :3]) <= np.count_nonzero(C[:3, :3])
    if not C[:2, 2].any():
        assert before == behind == 0.0


@chains
def test_no_result_has_a_negative_zero_where_joints_stand_at_zero(name: str):
    """A student would see -0. where the sheet has 0."""
    chain = CHAINS[name]
    one = np.eye(chain.n)
    for q in (np.zeros(chain.n), *one, *-one, np.tile(-one, (2 * FEW, 1))):
        for values in (*(jacobian(chain, q, frame) for frame in FRAMES), forward(chain, q)):
            assert not np.signbit(values[values == 0]).any()
        values = frames(chain, q)
        assert not np.signbit(values[values == 0]).any()


@pytest.mark.parametrize("size", [1e3, 1e6, 1e12, 1e300])
def test_large_angles_lose_nothing_where_their_sum_is_rounded(size: float):
    """The same arm at the same angles brought within a turn, each as exactly as floats allow."""
    chain = ROBOTS["puma560"].chain()
    q = np.random.default_rng(8).uniform(-size, size, (2 * FEW, 6))
    within = np.arctan2(np.sin(q), np.cos(q))
    for frame in FRAMES:
        expected = jacobian(chain, within, frame)
        np.testing.assert_allclose(jacobian(chain, q, frame), expected, rtol=0, atol=2e-15)
        for row, J in zip(q, expected, strict=True):
            np.testing.assert_allclose(jacobian(chain, row, frame), J, rtol=0, atol=2e-15)


def test_angles_whose_sum_is_no_float_have_a_jacobian():
    chain = ROBOTS["planar_2r"].chain()
    one = jacobian(chain, [1e308] * 2)
    many = jacobian(chain, np.full((2 * FEW, 2), 1e308))
    assert np.isfinite(one).all()
    np.testing.assert_allclose(many, np.broadcast_to(one, many.shape), rtol=0, atol=2e-15)


def test_a_long_slide_is_no_large_angle():
    chain = ROBOTS["rrt_offset"].chain()
    near, far = forward(chain, [0.3, 0.2, 1.0]), forward(chain, [0.3, 0.2, 1001.0])
    assert np.linalg.norm(far[:3, 3] - near[:3, 3]) == pytest.approx(1000.0, rel=1e-12)
