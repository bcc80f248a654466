"""From a table to transforms: an independent product, the columns as printed, what the source prints."""

import re

import numpy as np
import pytest
from answers import EXERCISES, raws, right_raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.kinematics import forward

EXERCISE = EXERCISES["dh_transforms"]
SEEDS = range(12)
LABELS = {r"$\theta_i$": "theta", r"$\alpha_i$": "alpha", "$a_i$": "a", "$d_i$": "d"}


def value(cell, v):
    """A cell as a student reads it: numbers in degrees, symbols by their value."""
    total = 0.0
    for letter, index, sign, degrees in re.findall(r"\$([a-z])_([0-9])\$|([−-]?) ?([0-9]+)°", cell):
        total += v[letter + index] if letter else np.radians(float(f"{'-' * bool(sign)}{degrees}"))
    return total


def printed_rows(v):
    """The rows of the printed table, by label."""
    lines = [line for line in EXERCISE.statement(v).splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    labels = [LABELS[label] for label in cells[0][1:]]
    return [
        dict(zip(labels, (value(cell, v) for cell in row[1:]), strict=True)) for row in cells[2:]
    ]


def link(theta, alpha, a, d):
    """The matrix that S2 prints, written out."""
    ct, st, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array(
        [
            [ct, -st * ca, st * sa, a * ct],
            [st, ct * ca, -ct * sa, a * st],
            [0, sa, ca, d],
            [0, 0, 0, 1],
        ]
    )


def verdicts_of(v, answers):
    return {
        verdict.part: verdict
        for verdict in mark(EXERCISE, v, right_raws(EXERCISE, v) | raws(answers))
    }


@pytest.mark.parametrize("seed", SEEDS)
def test_the_transforms_follow_from_the_table_as_it_is_printed(seed):
    v = variant_of("dh_transforms", seed)
    first, second, third = (link(**row) for row in printed_rows(v))
    got = references(EXERCISE, v)
    np.testing.assert_allclose(got["dh_transforms_links"], [first, second, third], atol=1e-12)
    np.testing.assert_allclose(
        got["dh_transforms_frames"], [first @ second, first @ second @ third], atol=1e-12
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_the_formulas_of_row_1_come_to_its_numbers(seed):
    v = variant_of("dh_transforms", seed)
    got = references(EXERCISE, v)
    numbers = got["dh_transforms_first"].at({name: v[name] for name in ("q1", "a1", "d1")})
    np.testing.assert_allclose(numbers, got["dh_transforms_links"][0], atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_drawn_arm_is_the_arm_of_the_table(seed):
    v = variant_of("dh_transforms", seed)
    (drawing,) = EXERCISE.drawings(v)
    T = references(EXERCISE, v)["dh_transforms_frames"][-1]
    np.testing.assert_allclose(forward(drawing.chain, drawing.q), T, atol=1e-12)
    np.testing.assert_allclose(drawing.triads[-1].pose, T, atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_one_length_is_negative_and_some_joint_slides(seed):
    v = variant_of("dh_transforms", seed)
    assert sum(v[name] < 0 for name in v if re.fullmatch("[ad][123]", name)) == 1
    assert "P" in v["kinds"]
    assert all(v[f"s{i}"] > 0 for i, kind in enumerate(v["kinds"], 1) if kind == "P")


def test_the_columns_are_printed_in_several_orders():
    headers = {
        EXERCISE.statement(variant_of("dh_transforms", seed)).splitlines()[2] for seed in SEEDS
    }
    assert len(headers) >= 3


@pytest.mark.parametrize("seed", SEEDS)
def test_the_chain_that_s2_prints_is_named_and_earns_nothing(seed):
    v = variant_of("dh_transforms", seed)
    T1, T12, _ = references(EXERCISE, v)["dh_transforms_links"]
    verdict = verdicts_of(v, {"dh_transforms_frames": np.array([T1, T1 @ T1 @ T12])})[
        "dh_transforms_frames"
    ]
    assert verdict.points == 0
    assert any("link 1 comes twice" in finding.text for finding in verdict.findings)


def test_degrees_for_radians_are_named():
    v = variant_of("dh_transforms", 0)
    degrees = v | {name: np.radians(v[name]) for name in v if re.fullmatch("q[123]", name)}
    wrong = {"dh_transforms_links": references(EXERCISE, degrees)["dh_transforms_links"]}
    verdict = verdicts_of(v, wrong)["dh_transforms_links"]
    assert any("taken as degrees" in finding.text for finding in verdict.findings)


def test_links_in_the_modified_order_are_followed_through():
    v = variant_of("dh_transforms", 0)
    links, frames = EXERCISE.asked[1:]
    wrong = links.mistakes[0].solve(v, {})
    given = {
        "dh_transforms_links": wrong,
        "dh_transforms_frames": frames.solve(v, {"dh_transforms_links": wrong}),
    }
    verdicts = verdicts_of(v, given)
    assert verdicts["dh_transforms_links"].status != "correct"
    assert verdicts["dh_transforms_frames"].points == frames.points


def wrong_units(v, columns):
    """The links of somebody who takes the degrees of these columns for radians."""
    table = printed_rows(v)
    for i, row in enumerate(table):
        if "theta" in columns:
            row["theta"] += v["offset"][i] - np.radians(v["offset"][i])
        if "alpha" in columns:
            row["alpha"] = v["alpha"][i]
    return np.array([link(**row) for row in table])


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ("theta", "column of theta, printed in degrees"),
        ("alpha", "angles alpha"),
        ("theta alpha", "of the table"),
    ],
)
@pytest.mark.parametrize("seed", SEEDS)
def test_degrees_of_the_table_taken_for_radians_are_named_and_followed(columns, words, seed):
    v = variant_of("dh_transforms", seed)
    links = wrong_units(v, columns)
    answers = {
        "dh_transforms_links": links,
        "dh_transforms_frames": np.array([links[0] @ links[1], links[0] @ links[1] @ links[2]]),
    }
    verdicts = verdicts_of(v, answers)
    assert words in verdicts["dh_transforms_links"].findings[0].text
    assert verdicts["dh_transforms_frames"].points == verdicts["dh_transforms_frames"].out_of


@pytest.mark.parametrize("seed", SEEDS)
def test_degrees_in_the_formulas_are_named(seed):
    v = variant_of("dh_transforms", seed)
    c, s, turn = f"cos(q1 {v['offset'][0]:+d})", f"sin(q1 {v['offset'][0]:+d})", v["alpha"][0] // 90
    wrong = [
        [c, "0", f"{turn}*{s}", f"a1*{c}"],
        [s, "0", f"{-turn}*{c}", f"a1*{s}"],
        ["0", str(turn), "0", "d1"],
        ["0", "0", "0", "1"],
    ]
    verdict = verdicts_of(v, {"dh_transforms_first": wrong})["dh_transforms_first"]
    assert "column of theta, printed in degrees" in verdict.findings[0].text


@pytest.mark.parametrize("seed", SEEDS)
def test_the_sheet_has_one_minus_sign_and_names_no_source(seed):
    v = variant_of("dh_transforms", seed)
    said = EXERCISE.statement(v)
    assert not [line for line in said.splitlines() if line.startswith("| $") and "-" in line]
    assert "S2" not in said
    slide = v["kinds"].index("P") + 1
    assert f"writes q{slide} for the stroke s{slide}" in EXERCISE.drawings(v)[0].caption
