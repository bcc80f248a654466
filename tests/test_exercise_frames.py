"""One Jacobian in three frames, against finite differences of poses written out from the sheet."""

import numpy as np
import pytest
from answers import EXERCISES, raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.mark import mark

EXERCISE = EXERCISES["frames"]
SEEDS = range(8)
ANGLES = {"pi/2": np.pi / 2, "-pi/2": -np.pi / 2, "0": 0.0}


def table(v):
    """Cells as they are printed."""
    lines = EXERCISE.statement(v).splitlines()
    rows = [line for line in lines if line[2:].lstrip("$")[:1].isdigit()]
    return [
        [cell.strip(" $").replace("\\", "").replace("_", "") for cell in row.split("|")[2:-1]]
        for row in rows
    ]


def link(t, d, a, al):
    c, s, ca, sa = np.cos(t), np.sin(t), np.cos(al), np.sin(al)
    return np.array(
        [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
    )


def poses(v, q, constant_angle=True):
    """Frames 0 to 4 of the printed table, or of the one without the angle in row 3."""
    values = ANGLES | {name: x for name, x in v.items() if isinstance(x, float)}
    values |= {f"q{i}": x for i, x in enumerate(q, 1)}
    rows = [[values[cell] for cell in row] for row in table(v)]
    rows[2][0] *= constant_angle
    found = [np.eye(4)]
    for row in rows:
        found.append(found[-1] @ link(*row))
    return found


def pose(v, q):
    return poses(v, q)[-1]


def columns(frames, kinds="RRPR"):
    p = frames[-1][:3, 3]
    pairs = [(T[:3, 2], np.cross(T[:3, 2], p - T[:3, 3])) for T in frames[:-1]]
    return np.array(
        [
            [*v, *z] if kind == "R" else [*z, 0, 0, 0]
            for kind, (z, v) in zip(kinds, pairs, strict=True)
        ]
    ).T


def shift(p):
    x, y, z = p
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


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
    np.testing.assert_allclose(
        got["frames_X"] @ got["frames_tool"], got["frames_origin"], atol=1e-12
    )


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
    assert {
        references(EXERCISE, variant_of("frames", seed))["frames_which"] for seed in range(30)
    } == set("abcd")


def verdicts(v, **answers):
    right = references(EXERCISE, v)
    found = mark(
        EXERCISE, v, raws(right | {f"frames_{name}": value for name, value in answers.items()})
    )
    return {verdict.part.removeprefix("frames_"): verdict for verdict in found}


@pytest.mark.parametrize("seed", SEEDS)
def test_the_asked_matrix_is_the_only_one_for_all_twists_and_one_from_the_jacobians_alone_is_named(
    seed,
):
    v = variant_of("frames", seed)
    got = references(EXERCISE, v)
    X = got["frames_origin"] @ np.linalg.pinv(got["frames_tool"])
    np.testing.assert_allclose(X @ got["frames_tool"], got["frames_origin"], atol=1e-9)
    found = verdicts(v, X=X)["X"]
    assert found.points == found.out_of / 2
    assert "not for every twist" in found.findings[0].text


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("of", "word"),
    [
        (lambda R, S: [[R.T, S @ R.T], [0 * R, R.T]], "the wrong way round"),
        (lambda R, S: [[R, S], [0 * R, R]], "upper right block"),
        (lambda R, S: [[R, 0 * R], [S @ R, R]], "angular velocity first"),
    ],
)
def test_wrong_blocks_of_the_matrix_are_named(seed, of, word):
    v = variant_of("frames", seed)
    T = references(EXERCISE, v)["frames_T"]
    found = verdicts(v, X=np.block(of(T[:3, :3], shift(T[:3, 3]))))["X"]
    assert found.points < found.out_of
    assert word in found.findings[0].text


@pytest.mark.parametrize("seed", SEEDS)
def test_a_forgotten_right_angle_in_row_3_is_named_and_what_comes_after_it_follows(seed):
    v = variant_of("frames", seed)
    frames = poses(v, v["q"], constant_angle=False)
    T, J = frames[-1], columns(frames)
    R, S = T[:3, :3], shift(T[:3, 3])
    tool, origin = np.vstack([R.T @ J[:3], R.T @ J[3:]]), np.vstack([J[:3] + S @ J[3:], J[3:]])
    found = verdicts(v, T=T, J=J, tool=tool, origin=origin, X=np.block([[R, S @ R], [0 * R, R]]))
    assert "Row 3" in found["T"].findings[0].text
    assert "Row 3" in found["J"].findings[0].text
    assert [found[name].points for name in ("origin", "X")] == [2, 3]
    assert any(
        "Row 3" in finding.text for finding in found["tool"].findings
    )  # an easier matrix, which is not followed


@pytest.mark.parametrize("seed", SEEDS)
def test_a_slide_taken_as_a_turning_joint_is_named(seed):
    v = variant_of("frames", seed)
    found = verdicts(v, J=columns(poses(v, v["q"]), "RRRR"))["J"]
    assert "joint 3 were revolute" in found.findings[0].text


@pytest.mark.parametrize("seed", SEEDS)
def test_another_frame_or_a_shift_too_many_is_named(seed):
    v = variant_of("frames", seed)
    T, J = poses(v, v["q"])[-1], references(EXERCISE, v)["frames_J"]
    R, S = T[:3, :3], shift(T[:3, 3])
    fourth = np.vstack([R.T @ (J[:3] + S @ J[3:]), R.T @ J[3:]])
    found = verdicts(v, tool=fourth, origin=fourth)
    assert "point has been moved as well" in found["tool"].findings[0].text
    assert "in tool axes" in found["origin"].findings[0].text
    tool = np.vstack([R.T @ J[:3], R.T @ J[3:]])
    late = np.vstack([tool[:3] + S @ tool[3:], tool[3:]])
    assert (
        "start from the Jacobian in base axes"
        in verdicts(v, origin=late)["origin"].findings[0].text
    )


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
    assert [found[name].points for name in ("frames_tool", "frames_origin", "frames_X")] == [
        2,
        2,
        3,
    ]
