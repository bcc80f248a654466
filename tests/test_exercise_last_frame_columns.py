"""Columns in the last frame: from the printed numbers, against finite differences, and told apart from base axes."""

import numpy as np
import pytest
from answers import EXERCISES, right_raws, variant_of
from kinegrade.course.sheet.given import given_cell
from kinegrade.exercises.exercise import references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark

COLUMNS = EXERCISES["last_frame_columns"]
QUARTER = np.pi / 2
SEEDS = range(8)


def link(theta, d, a, alpha):
    c, s, k, t = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array(
        [[c, -s * k, s * t, a * c], [s, c * k, -c * t, a * s], [0, t, k, d], [0, 0, 0, 1]]
    )


def sheet(v):
    """The numbers of the sheet by name, as the student's notebook has them."""
    numbers = {}
    exec(f"import numpy as np\n{given_cell(COLUMNS, v)}", numbers)  # noqa: S102 - our own cell
    return {name.removeprefix("last_frame_columns_"): x for name, x in numbers.items()}


def links(given, q):
    rows = [
        (0, 0, QUARTER), (0, given["a2"], 0), (0, given["a3"], 0), (0, given["a4"], -QUARTER), (0, 0, QUARTER),
        (given["d6"], 0, 0),
    ]  # fmt: skip
    return [link(theta, *row) for theta, row in zip(q, rows, strict=True)]


def pose(given, q):
    return np.linalg.multi_dot(links(given, q))


def by_differences(given, h=1e-6):
    """J in base axes from poses beside q."""
    q, J = given["q"], np.zeros((6, 6))
    for i, step in enumerate(h * np.eye(6)):
        change = (pose(given, q + step) - pose(given, q - step)) / (2 * h)
        spin = change[:3, :3] @ pose(given, q)[:3, :3].T
        J[:, i] = *change[:3, 3], spin[2, 1], spin[0, 2], spin[1, 0]
    return J


def column(T):
    (nx, ox, ax, px), (ny, oy, ay, py), (nz, oz, az, _), _ = T
    return np.array([-nx * py + ny * px, -ox * py + oy * px, -ax * py + ay * px, nz, oz, az])


@pytest.mark.parametrize("seed", SEEDS)
def test_a_sheet_solved_from_what_is_printed_alone_is_right(seed):
    v = variant_of("last_frame_columns", seed)
    given = sheet(v)
    J0, R = by_differences(given), pose(given, given["q"])[:3, :3]
    answers = {
        "A": column(given["TA"]),
        "B": column(given["TB"]),
        "J": np.concatenate([R.T @ J0[:3], R.T @ J0[3:]]),
        "base": J0,
    }
    raws = {
        f"last_frame_columns_{name}": Raw("num", np.round(value, 3))
        for name, value in answers.items()
    }
    assert [verdict.status for verdict in mark(COLUMNS, v, raws)] == ["correct"] * 4


@pytest.mark.parametrize("seed", SEEDS)
def test_the_printed_transforms_are_those_of_the_table_and_their_columns_those_of_j(seed):
    v = variant_of("last_frame_columns", seed)
    given, answers = sheet(v), references(COLUMNS, v)
    for name, i in zip("AB", v["columns"], strict=True):
        T = np.linalg.multi_dot([*links(given, given["q"])[i - 1 :], np.eye(4)])
        np.testing.assert_allclose(given[f"T{name}"], T, atol=5.01e-5)
        J = answers["last_frame_columns_J"]
        np.testing.assert_allclose(answers[f"last_frame_columns_{name}"], J[:, i - 1], atol=5e-4)
        assert "the pose of frame 6 in frame $i-1$" in COLUMNS.statement(v)
        assert rf"T{name} is $\mathbf T_{{{i - 1}}}^{{6}}$" in COLUMNS.statement(v)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_column_on_paper_may_come_from_exact_transforms_too(seed):
    v = variant_of("last_frame_columns", seed)
    J = references(COLUMNS, v)["last_frame_columns_J"]
    exact = {
        f"last_frame_columns_{name}": J[:, i - 1]
        for name, i in zip("AB", v["columns"], strict=True)
    }
    raws = right_raws(COLUMNS, v) | {name: Raw("num", np.round(x, 3)) for name, x in exact.items()}
    assert [verdict.status for verdict in mark(COLUMNS, v, raws)] == ["correct"] * 4


def modified(theta, d, a, alpha):
    c, s, k, t = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array(
        [[c, -s, 0, a], [s * k, c * k, -t, -d * t], [s * t, c * t, k, d * k], [0, 0, 0, 1]]
    )


def own_way(given, q, link, right_angle):
    """J in the last frame and its rotation by somebody who has another link transform or another right angle."""
    rows = [
        (0, 0, right_angle), (0, given["a2"], 0), (0, given["a3"], 0), (0, given["a4"], -right_angle),
        (0, 0, right_angle), (given["d6"], 0, 0),
    ]  # fmt: skip
    links = [link(theta, *row) for theta, row in zip(q, rows, strict=True)]
    T = [np.linalg.multi_dot([*links[i:], np.eye(4)]) for i in range(6)]
    return np.array([column(to_last) for to_last in T]).T, T[0][:3, :3]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("link", "right_angle", "factor", "word"),
    [(modified, QUARTER, 1, "modified"), (link, 90, 180 / np.pi, "degrees")],
)
def test_another_convention_and_degrees_are_named_in_both_matrices(
    seed, link, right_angle, factor, word
):
    v = variant_of("last_frame_columns", seed)
    given = sheet(v)
    J, R = own_way(given, factor * np.array(given["q"]), link, right_angle)
    base = np.concatenate([R @ J[:3], R @ J[3:]])
    raws = right_raws(COLUMNS, v)
    raws |= {"last_frame_columns_J": Raw("num", J), "last_frame_columns_base": Raw("num", base)}
    found = mark(COLUMNS, v, raws)[2:]
    J_verdict, base_verdict = found
    assert J_verdict.points == J_verdict.out_of / 2
    assert base_verdict.points == base_verdict.out_of
    assert word in J_verdict.findings[0].text
    said = [finding.text for finding in base_verdict.findings]
    assert "It was charged in last_frame_columns_J already." in said
    alone = mark(
        COLUMNS,
        v,
        right_raws(COLUMNS, v) | {"last_frame_columns_base": Raw("num", turned_by(R, v))},
    )[3]
    assert (alone.points, word in alone.findings[0].text) == (alone.out_of / 2, True)


def turned_by(R, v):
    J = references(COLUMNS, v)["last_frame_columns_J"]
    return np.concatenate([R @ J[:3], R @ J[3:]])


def test_reversed_linear_rows_and_an_unturned_jacobian_are_named():
    v = variant_of("last_frame_columns", 1)
    J = references(COLUMNS, v)["last_frame_columns_J"]
    raws = right_raws(COLUMNS, v)
    reversed_rows = raws | {"last_frame_columns_J": Raw("num", np.concatenate([-J[:3], J[3:]]))}
    assert "Every sign of the linear rows" in mark(COLUMNS, v, reversed_rows)[2].findings[0].text
    unturned = mark(COLUMNS, v, raws | {"last_frame_columns_base": Raw("num", J)})[3]
    assert unturned.points == unturned.out_of / 2
    assert "still in the axes of frame 6" in unturned.findings[0].text


def test_base_axes_in_place_of_the_last_frame_are_named_and_followed():
    v = variant_of("last_frame_columns", 0)
    answers = references(COLUMNS, v)
    base = answers["last_frame_columns_base"]
    R = answers["last_frame_columns_T"][0, :3, :3]
    twice = np.concatenate([R @ base[:3], R @ base[3:]])
    raws = right_raws(COLUMNS, v)
    raws |= {"last_frame_columns_J": Raw("num", base), "last_frame_columns_base": Raw("num", twice)}
    J, turned = mark(COLUMNS, v, raws)[2:]
    assert J.status != "correct"
    assert any("base axes" in finding.text for finding in J.findings)
    assert turned.points == turned.out_of
    assert "your own last_frame_columns_J" in turned.findings[-1].text
