"""One Jacobian in three frames, against finite differences of poses written out from the sheet."""

import numpy as np
import pytest
from answers import EXERCISES, raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.mark import mark

EXERCISE = EXERCISES["frames"]
SEEDS = range(8)
ANGLES = {"pi/2": np.pi / 2, "-pi/2": -np.pi / 2, "0": 0.0}


def table(v):
    """Cells as they are printed."""
    lines = EXERCISE.statement(v).splitlines()
    rows = [line for line in lines if line.startswith("| $") and r"\theta" not in line]
    return [[cell.strip(" $").replace("\\", "").replace("_", "") for cell in row.split("|")[2:-1]] for row in rows]


def pose(v, q):
    """Product of the four link transforms of the printed table."""
    values = ANGLES | {name: x for name, x in v.items() if isinstance(x, float)}
    values |= {f"q{i}": x for i, x in enumerate(q, 1)}
    T = np.eye(4)
    for row in table(v):
        t, d, a, al = (values[cell] for cell in row)
        c, s, ca, sa = np.cos(t), np.sin(t), np.cos(al), np.sin(al)
        T = T @ [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
    return T


def spatial_columns(v, q, h=1e-6):
    """For each joint dT/dq T^-1, a body's velocity in base axes at the base origin, above its angular velocity."""
    columns = []
    for e in np.eye(4):
        W = (pose(v, q + h * e) - pose(v, q - h * e)) / (2 * h) @ np.linalg.inv(pose(v, q))
        columns.append([*W[:3, 3], W[2, 1], W[0, 2], W[1, 0]])
    return np.array(columns).T


@pytest.mark.parametrize("seed", SEEDS)
def test_the_three_jacobians_are_derivatives_of_the_pose(seed):
    v = variant_of("frames", seed)
    got, q = references(EXERCISE, v), np.array(v["q"])
    T = pose(v, q)
    R, p = T[:3, :3], T[:3, 3]
    origin = spatial_columns(v, q)
    J = np.vstack([origin[:3] - np.cross(p[:, None], origin[3:], axis=0), origin[3:]])
    np.testing.assert_allclose(got["frames_T"], T, atol=1e-12)
    np.testing.assert_allclose(got["frames_origin"], origin, atol=1e-8)
    np.testing.assert_allclose(got["frames_J"], J, atol=1e-8)
    np.testing.assert_allclose(got["frames_tool"], np.vstack([R.T @ J[:3], R.T @ J[3:]]), atol=1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_matrix_leads_from_the_tool_to_the_base_origin(seed):
    got = references(EXERCISE, variant_of("frames", seed))
    np.testing.assert_allclose(got["frames_X"] @ got["frames_tool"], got["frames_origin"], atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_printed_twist_is_in_the_named_frame_and_in_no_other(seed):
    v = variant_of("frames", seed)
    got, qdot = references(EXERCISE, v), np.array(v["qdot"])
    R = pose(v, v["q"])[:3, :3]
    fourth = np.vstack([R.T @ got["frames_origin"][:3], R.T @ got["frames_origin"][3:]])
    twists = [M @ qdot for M in (got["frames_J"], got["frames_tool"], got["frames_origin"], fourth)]
    near = [bool(np.abs(twist - v["xi"]).max() <= 6e-4) for twist in twists]
    assert near == [letter == got["frames_which"] for letter in "abcd"]


def test_all_four_frames_are_drawn():
    assert {references(EXERCISE, variant_of("frames", seed))["frames_which"] for seed in range(30)} == set("abcd")


def test_conversions_follow_from_a_wrong_jacobian():
    v = variant_of("frames")
    got = references(EXERCISE, v)
    T, J = got["frames_T"], got["frames_J"].copy()
    J[:3, 1] *= -1
    R, p = T[:3, :3], T[:3, 3]
    own = {
        "frames_J": J,
        "frames_tool": np.vstack([R.T @ J[:3], R.T @ J[3:]]),
        "frames_origin": np.vstack([J[:3] + np.cross(p[:, None], J[3:], axis=0), J[3:]]),
    }
    found = {verdict.part: verdict for verdict in mark(EXERCISE, v, raws(got | own))}
    assert found["frames_J"].status == "partly"
    assert [found[name].points for name in ("frames_tool", "frames_origin", "frames_X")] == [2, 2, 3]
