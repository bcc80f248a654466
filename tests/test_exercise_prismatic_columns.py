"""The column of a slide: against finite differences, told apart from a turning joint, and in other units."""

import json

import numpy as np
import pytest
from answers import EXERCISES, right_raws, variant_of
from kinegrade.exercises.catalogue.prismatic_columns import UNIT_OPTIONS
from kinegrade.exercises.exercise import references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark

COLUMNS = EXERCISES["prismatic_columns"]
QUARTER = np.pi / 2
DEGREES = 180 / np.pi
SEEDS = range(8)


def link(theta, d, alpha):
    c, s, k, t = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s * k, s * t, 0], [s, c * k, -c * t, 0], [0, t, k, d], [0, 0, 0, 1]])


def pose(v, q):
    rows = [
        (q[0], 0, -QUARTER), (q[1], v["d2"], QUARTER), (0, q[2], 0), (q[3], 0, -QUARTER), (q[4], 0, QUARTER),
        (q[5], v["d6"], 0),
    ]  # fmt: skip
    return np.linalg.multi_dot([link(*row) for row in rows])


def by_differences(v, h=1e-6):
    q, J = np.array(v["q"]), np.zeros((6, 6))
    for i, step in enumerate(h * np.eye(6)):
        change = (pose(v, q + step) - pose(v, q - step)) / (2 * h)
        spin = change[:3, :3] @ pose(v, q)[:3, :3].T
        J[:, i] = *change[:3, 3], spin[2, 1], spin[0, 2], spin[1, 0]
    return J


@pytest.mark.parametrize("seed", SEEDS)
def test_columns_are_those_of_finite_differences(seed):
    v = variant_of("prismatic_columns", seed)
    answers, J, R = references(COLUMNS, v), by_differences(v), pose(v, v["q"])[:3, :3]
    np.testing.assert_allclose(answers["prismatic_columns_J"], J, atol=1e-8)
    np.testing.assert_allclose(answers["prismatic_columns_base"], J[:, 2], atol=1e-8)
    np.testing.assert_allclose(
        answers["prismatic_columns_last"], [*R.T @ J[:3, 2], 0, 0, 0], atol=1e-8
    )


# The new numbers of twist and rates of the same motion, in the order of the changes that are drawn.
TWISTS = (np.diag([1000.0] * 3 + [1.0] * 3), np.eye(6), np.eye(6))
RATES = (
    [1, 1, 1000, 1, 1, 1],
    [1, 1, 1000, 1, 1, 1],
    [DEGREES, DEGREES, 1, DEGREES, DEGREES, DEGREES],
)
LINEAR = np.array([[1.0]] * 3 + [[0.0]] * 3)
REVOLUTE = np.array([1, 1, 0, 1, 1, 1])
FACTORS = {  # of the entries of J, by option
    "a": 1 + 999 * LINEAR + 0 * REVOLUTE,
    "b": 1 + 999 * LINEAR * REVOLUTE,
    "c": 1 + 999 * (1 - REVOLUTE) + 0 * LINEAR,
    "d": 1 - 0.999 * (1 - REVOLUTE) + 0 * LINEAR,
    "e": 1 + (1 / DEGREES - 1) * REVOLUTE + 0 * LINEAR,
    "f": 1 + (DEGREES - 1) * REVOLUTE + 0 * LINEAR,
}


@pytest.mark.parametrize("change", range(3))
def test_one_option_alone_gives_the_same_motion_in_the_new_units(change):
    v = {**variant_of("prismatic_columns"), "change": change}
    answers = references(COLUMNS, v)
    J = answers["prismatic_columns_J"]
    wanted = TWISTS[change] @ J @ np.linalg.inv(np.diag(RATES[change]))
    right = [
        letter
        for letter, factor in FACTORS.items()
        if np.allclose(factor * J, wanted, rtol=1e-9, atol=1e-12)
    ]
    assert right == [answers["prismatic_columns_units"]]
    assert len(UNIT_OPTIONS) == len(FACTORS)


def test_all_changes_of_units_are_drawn_and_stand_on_the_sheet():
    drawn = [
        json.loads(json.dumps(COLUMNS.draw(np.random.default_rng(seed)))) for seed in range(12)
    ]
    assert {v["change"] for v in drawn} == {0, 1, 2}
    assert len({COLUMNS.statement(v).splitlines()[-1] for v in drawn}) == 3


def test_the_right_reason_stands_where_its_letter_says_and_moves_between_students():
    drawn = [variant_of("prismatic_columns", seed) for seed in range(16)]
    letters = [references(COLUMNS, v)["prismatic_columns_why"] for v in drawn]
    assert set(letters) == set("abcd")
    for v, letter in zip(drawn, letters, strict=True):
        assert (
            f"**reason {'abcd'.index(letter) + 1}**: A slide moves all points of the hand alike"
            in COLUMNS.statement(v)
        )


@pytest.mark.parametrize("seed", SEEDS)
def test_a_turning_slide_in_an_otherwise_right_j_costs_two_fifths(seed):
    v = variant_of("prismatic_columns", seed)
    answers = references(COLUMNS, v)
    part = next(part for part in COLUMNS.parts if part.variable == "prismatic_columns_J")
    right = right_raws(COLUMNS, v)
    for mistake in (part.mistakes[0], part.mistakes[1], part.mistakes[-1]):
        verdict = mark(COLUMNS, v, right | {part.variable: Raw("num", mistake.solve(v, answers))})[
            2
        ]
        assert verdict.points == pytest.approx(2.4)
        assert [finding.text for finding in verdict.findings] == [mistake.sentence]
    other = answers[part.variable].copy()
    other[:, 1] *= -1
    verdict = mark(COLUMNS, v, right | {part.variable: Raw("num", other)})[2]
    assert 3 < verdict.points < 4


@pytest.mark.parametrize("name", ["last", "base"])
def test_a_column_times_the_stroke_is_named(name):
    v = variant_of("prismatic_columns", 3)
    variable = f"prismatic_columns_{name}"
    times = references(COLUMNS, v)[variable] * v["q"][2]
    verdicts = mark(COLUMNS, v, right_raws(COLUMNS, v) | {variable: Raw("num", times)})
    verdict = next(verdict for verdict in verdicts if verdict.part == variable)
    assert verdict.points == verdict.out_of / 2
    assert "stroke" in verdict.findings[0].text


def test_the_column_of_the_slide_holds_no_lengths_while_others_do():
    v = variant_of("prismatic_columns", 1)
    longer = {
        **v,
        "d2": v["d2"] + 0.3,
        "d6": v["d6"] + 0.2,
        "q": [x + 0.4 * (i == 2) for i, x in enumerate(v["q"])],
    }
    before, after = (references(COLUMNS, x) for x in (v, longer))
    for name in ("last", "base"):
        np.testing.assert_allclose(
            after[f"prismatic_columns_{name}"], before[f"prismatic_columns_{name}"], atol=1e-12
        )
    moved = np.abs(after["prismatic_columns_J"] - before["prismatic_columns_J"])[:3].max(axis=0)
    assert (moved[:2] > 0.01).all()
    assert moved[2] < 1e-12


def test_a_slide_that_turns_the_hand_is_named_and_the_whole_of_j_follows():
    v = variant_of("prismatic_columns", 2)
    part = next(part for part in COLUMNS.parts if part.variable == "prismatic_columns_base")
    whole = next(part for part in COLUMNS.parts if part.variable == "prismatic_columns_J")
    answers = references(COLUMNS, v)
    wrong = part.mistakes[1].solve(v, answers)
    J = whole.solve(v, {**answers, part.variable: wrong})
    np.testing.assert_allclose(J[:, 2], wrong)
    verdicts = mark(
        COLUMNS,
        v,
        right_raws(COLUMNS, v) | {part.variable: Raw("num", wrong), whole.variable: Raw("num", J)},
    )
    base, after = verdicts[1:3]
    assert base.points == base.out_of / 2
    assert "how fast does the hand turn" in base.findings[0].text
    assert after.points == after.out_of
