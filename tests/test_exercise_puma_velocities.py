"""The Puma's velocities: three wordings of one question, postures of four families, readings that are named."""

import re

import numpy as np
import pytest
from answers import EXERCISES, right_raws, variant_of
from kinegrade.exercises.arm import arm_of
from kinegrade.exercises.arms.puma import FAMILIES, elbow_height
from kinegrade.exercises.catalogue.puma_velocities import ALONE, FREE, HELD, WORDINGS
from kinegrade.exercises.exercise import references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.velocity import joint_rates

EXERCISE = EXERCISES["puma_velocities"]
SEEDS = range(40)
S3 = {"q": [0.1, 0.5, 0.1, 0.8, 0.1, 0.2], "qdot_b": [1, 1.4, 1.7, 0.2, 0.3, 0.1], "vx_c": 2.0}
OF_S3 = {
    HELD: [-1.3146195, -2.6644359, -1.7822710, -25.5529862, 3.6305368, 26.7717356],
    FREE: [-1.3146195, -2.6644359, -1.7822710, 0, 0, 0],
    ALONE: [0.56, -2.39, -1.53, 0, 0, 0],
}
IN_TOOL_AXES = {
    "the whole twist along the x axis of the tool": (6, [11.0, 2.59, -1.65, -45.7, -5.1, 36.8]),
    "the linear velocity only, along the x axis of the tool": (3, [11.034, 2.587, -1.651, 0, 0, 0]),
    "the x component only, along the x axis of the tool": (1, [3.244, -2.880, -4.020, 0, 0, 0]),
}


def of_s3(wording):
    return {**S3, "wording": wording, "family": "near wrist-singular"}


def arm_at(q):
    return arm_of(ROBOTS["puma560"], {"q": q})


def verdict(v, rates, J=None):
    given = right_raws(EXERCISE, v) | {
        "puma_velocities_qdot": Raw("num", np.array(rates, dtype=float))
    }
    if J is not None:
        given |= {
            "puma_velocities_J": Raw("num", J),
            "puma_velocities_twist": Raw("num", J @ np.array(v["qdot_b"])),
        }
    return mark(EXERCISE, v, given)[-1]


@pytest.mark.parametrize("wording", WORDINGS)
def test_each_wording_of_question_c_of_s3_has_the_known_rates(wording):
    got = references(EXERCISE, of_s3(wording))["puma_velocities_qdot"]
    np.testing.assert_allclose(got, OF_S3[wording], atol=1e-6 if wording != ALONE else 5e-3)


def test_every_wording_and_every_family_is_drawn():
    drawn = [variant_of("puma_velocities", seed) for seed in SEEDS]
    assert {v["wording"] for v in drawn} == set(WORDINGS)
    assert {v["family"] for v in drawn} == set(FAMILIES)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_posture_belongs_to_its_family(seed):
    v = variant_of("puma_velocities", seed)
    answers = references(EXERCISE, v)
    smallest = np.linalg.svd(answers["puma_velocities_J"], compute_uv=False)[-1]
    largest = np.abs(answers["puma_velocities_qdot"]).max()
    if v["family"] == "near wrist-singular":
        assert 0.02 <= smallest <= 0.06
        assert largest >= 3
        assert v["wording"] == HELD
        assert "large joint rates are right" in EXERCISE.statement(v)
    else:
        assert smallest >= 0.1
        assert largest < 6
        assert "large" not in EXERCISE.statement(v)
    if v["family"].startswith("elbow"):
        assert elbow_height(arm_at(v["q"])) * (1 if v["family"] == "elbow up" else -1) >= 0.1


def test_the_elbow_of_a_raised_arm_is_up_and_of_a_hanging_one_down():
    assert elbow_height(arm_at([0.3, np.pi / 4, -np.pi / 2 - 0.5, 0, 0, 0])) > 0.1
    assert elbow_height(arm_at([0.3, -np.pi / 4, np.pi / 2 - 1.0, 0, 0, 0])) < -0.1


@pytest.mark.parametrize("seed", SEEDS)
def test_the_sheet_alone_is_enough(seed):
    """The table, q and the wording are read off the printed text; J comes from differences."""
    v = variant_of("puma_velocities", seed)
    said = EXERCISE.statement(v)
    rows = re.findall(r"\| \$\d\$ \| \$q_\d\$ \| \$(.*?)\$ \| \$(.*?)\$ \| \$(.*?)\$ \|", said)
    table = [
        (float(d), float(a), {r"\pi/2": np.pi / 2, r"-\pi/2": -np.pi / 2, "0": 0.0}[turn])
        for d, a, turn in rows
    ]

    def pose(q):
        T = np.eye(4)
        for (d, a, alpha), x in zip(table, q, strict=True):
            c, s, ca, sa = np.cos(x), np.sin(x), np.cos(alpha), np.sin(alpha)
            T = T @ [
                [c, -s * ca, s * sa, a * c],
                [s, c * ca, -c * sa, a * s],
                [0, sa, ca, d],
                [0, 0, 0, 1],
            ]
        return T

    J = by_differences(pose, np.array(v["q"]))
    rows = 6 if "**held**" in said else 3 if "**free**" in said else 1
    assert (rows == 1) == ("**Only**" in said)
    rates = np.linalg.pinv(J[:rows]) @ np.eye(6)[0, :rows] * v["vx_c"]
    answers = references(EXERCISE, v)
    np.testing.assert_allclose(answers["puma_velocities_J"], J, atol=1e-7)
    np.testing.assert_allclose(answers["puma_velocities_qdot"], rates, atol=1e-4)


def by_differences(pose, q, h=1e-5):
    columns = []
    for step in h * np.eye(len(q)):
        turned = (pose(q + step) - pose(q - step)) / (2 * h)
        S = turned[:3, :3] @ pose(q)[:3, :3].T
        columns.append([*turned[:3, 3], S[2, 1], S[0, 2], S[1, 0]])
    return np.array(columns).T


@pytest.mark.parametrize("asked", WORDINGS)
@pytest.mark.parametrize("answered", WORDINGS)
def test_another_wording_than_the_asked_one_is_named(asked, answered):
    v = of_s3(asked)
    found = verdict(v, references(EXERCISE, of_s3(answered))["puma_velocities_qdot"])
    words = {
        HELD: "the whole twist",
        FREE: "the linear velocity only",
        ALONE: "the x component only",
    }[answered]
    if asked == answered:
        assert (found.status, found.reading) == ("correct", "")
    else:
        assert found.reading.startswith(f"This meets {words}")
        assert found.status in ("partly", "incorrect")
        assert found.points <= 1.5


@pytest.mark.parametrize("wording", WORDINGS)
@pytest.mark.parametrize("words", IN_TOOL_AXES)
def test_tool_axes_are_named_in_every_wording(wording, words):
    count, known = IN_TOOL_AXES[words]
    rates = joint_rates(
        ROBOTS["puma560"].chain(), S3["q"], np.eye(6)[0, :count] * 2, slice(count), "tool"
    )
    np.testing.assert_allclose(rates, known, atol=0.06)
    assert words in verdict(of_s3(wording), rates).reading


def test_rates_with_the_asked_velocity_but_not_the_least_norm_earn_half():
    v = of_s3(FREE)
    found = verdict(v, [*OF_S3[FREE][:3], 0.5, -0.4, 0.3])
    assert (found.status, found.points) == ("partly", 1.5)
    assert "the sheet asks for the rates of least norm" in found.reading


def test_rates_that_meet_one_component_alone_are_met_by_chance_and_earn_nothing():
    v = of_s3(ALONE)
    found = verdict(v, [2 / references(EXERCISE, v)["puma_velocities_J"][0, 0], 0, 0, 0, 0, 0])
    assert (found.status, found.points) == ("incorrect", 0)
    assert "the x component only; the sheet asks for the rates of least norm" in found.reading


@pytest.mark.parametrize("seed", SEEDS)
def test_rates_from_a_jacobian_at_four_decimals_are_right_even_close_to_the_singularity(seed):
    v = variant_of("puma_velocities", seed)
    J = np.round(references(EXERCISE, v)["puma_velocities_J"], 4)
    rows = len(WORDINGS[v["wording"]].rows)
    rates = np.linalg.pinv(J[:rows]) @ np.eye(6)[0, :rows] * v["vx_c"]
    assert verdict(v, np.round(rates, 4), J).status == "correct"
    assert verdict(v, np.round(rates, 4)).status == "correct"


def test_rates_that_miss_the_twist_are_wrong_however_large_the_right_ones_are():
    v = of_s3(HELD)
    assert verdict(v, np.array(OF_S3[HELD]) * 1.05).status != "correct"
    assert verdict(v, np.add(OF_S3[HELD], [0, 0, 0, 0.5, 0, 0])).status != "correct"


def test_what_is_drawn_is_printed_or_a_choice_of_form_that_can_be_pinned():
    assert list(EXERCISE.units) == ["q", "qdot_b", "vx_c"]
    assert EXERCISE.structure == ("wording", "family")


def test_one_row_of_the_jacobian_is_no_matrix_and_a_speed_no_vector():
    v = next(
        v for v in (variant_of("puma_velocities", seed) for seed in SEEDS) if v["wording"] == ALONE
    )
    way = next(iter(EXERCISE.parts[-1].explain(v, references(EXERCISE, v)))).text
    assert r"\mathbf J_x^{+} v_{x,c}" in way
    assert r"\mathbf J_v" not in way
    assert r"\mathbf v" not in way
