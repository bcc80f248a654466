"""Verdicts: findings that name the mistake, follow-through, and failures of ours that are never a zero."""

import dataclasses
import json

import numpy as np
import pytest
from answers import EXERCISES, part_of, raw, raws, raws_of, right_raws, telling, variant_of, wrong
from courses import exercise_of
from kinegrade.exercises.calculations.columns import tool_axes
from kinegrade.exercises.exercise import Manual, Mistake, Part, TableOf, references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.markers import read
from kinegrade.grader.marking.answer_key import AnswerKey
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.own_work import remarks
from kinegrade.grader.marking.verdict import Verdict
from kinegrade.solutions.table import read_table

SEEDS = range(4)


def verdicts_of(slug, changes, seed=0, others=None):
    exercise, v = EXERCISES[slug], variant_of(slug, seed)
    answers = references(exercise, v)
    changed = {
        name: change(answers[name]) if callable(change) else change
        for name, change in changes.items()
    }
    found = mark(exercise, v, raws_of(exercise, v, answers | changed), others)
    return {verdict.part: verdict for verdict in found}


def text_of(verdict):
    return " ".join(finding.text for finding in verdict.findings)


def in_millimetres(J):
    return np.concatenate([1000 * J[:3], J[3:]])


def swap_blocks(J):
    return np.concatenate([J[3:], J[:3]])


def flip(i, j):
    def change(J):
        J = J.copy()
        J[i, j] = -J[i, j]
        return J

    return change


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("slug", "name", "change", "words"),
    [
        ("puma_velocities", "puma_velocities_J", np.transpose, "transposed"),
        ("puma_velocities", "puma_velocities_J", swap_blocks, "angular rows seem to stand above"),
        ("puma_velocities", "puma_velocities_J", np.negative, "Every sign is reversed"),
        (
            "puma_velocities",
            "puma_velocities_J",
            flip(0, 1),
            "Only a sign is wrong: row 1, column 2",
        ),
        (
            "rrt",
            "rrt_J",
            lambda J: J * [1, -1, 1],
            "Only a sign is wrong: column 2",
        ),
        (
            "puma_velocities",
            "puma_velocities_J",
            lambda J: np.round(J, 2),
            "fewer decimals; 5 are asked",
        ),
        (
            "puma_velocities",
            "puma_velocities_J",
            lambda J: J[:, ::-1],
            "columns stand in reverse order",
        ),
        ("three_axis", "three_axis_J", swap_blocks, "angular rows seem to stand above"),
        ("three_axis", "three_axis_p", lambda p: 1000 * p, "metres are asked, not millimetres"),
        ("rrt", "rrt_J", swap_blocks, "angular rows seem to stand above"),
        ("rrt", "rrt_T", lambda T: np.swapaxes(T, 1, 2), "transposed"),
        (
            "puma_velocities",
            "puma_velocities_J",
            in_millimetres,
            "metres are asked, not millimetres",
        ),
    ],
)
def test_a_known_mistake_is_named(slug, name, change, words, seed):
    verdict = verdicts_of(slug, {name: change}, seed)[name]
    assert verdict.status != "correct"
    assert words in text_of(verdict)


@pytest.mark.parametrize("slug", ["three_axis", "rrt", "puma_velocities"])
def test_angles_taken_as_degrees_are_named(slug):
    exercise, v = EXERCISES[slug], variant_of(slug)
    units = np.array(exercise.units["q"])
    q = np.where(units == "rad", np.radians(v["q"]), v["q"]).tolist()
    verdicts = mark(exercise, v, raws(references(exercise, {**v, "q": q})))
    assert any("taken as degrees" in text_of(verdict) for verdict in verdicts)


def test_one_wrong_entry_of_a_jacobian_costs_its_share():
    verdict = verdicts_of("puma_velocities", {"puma_velocities_J": flip(0, 1)})["puma_velocities_J"]
    assert verdict.status == "partly"
    assert 3.5 < verdict.points < 4
    assert np.argwhere(~np.array(verdict.right)).tolist() == [[0, 1]]


def test_rates_and_twist_are_judged_from_the_students_own_jacobian():
    exercise, v = EXERCISES["puma_velocities"], variant_of("puma_velocities")
    J = references(exercise, v)["puma_velocities_J"].copy()
    J[:3, 1] *= -1.5
    own = {"puma_velocities_J": J}
    for name in ("puma_velocities_twist", "puma_velocities_qdot"):
        own[name] = part_of(exercise, name).solve(v, {"puma_velocities_J": J})
    verdicts = verdicts_of("puma_velocities", own)
    assert {name: verdicts[name].status for name in own} == dict(
        zip(own, ("partly", "follows", "follows"), strict=True)
    )
    assert "follows from your own puma_velocities_J" in text_of(verdicts["puma_velocities_qdot"])


@pytest.mark.parametrize(
    "J", [np.eye(6), np.zeros((6, 6)), np.ones((6, 6)), np.diag([1, 1, 1, 0, 0, 0.0])]
)
def test_rates_from_a_trivial_jacobian_earn_nothing(J):
    exercise, v = EXERCISES["puma_velocities"], variant_of("puma_velocities")
    target = [v["vx_c"], 0, 0, 0, 0, 0]
    own = {
        "puma_velocities_J": J,
        "puma_velocities_twist": J @ v["qdot_b"],
        "puma_velocities_qdot": np.linalg.pinv(J) @ target,
    }
    verdicts = mark(exercise, v, raws(own))
    assert sum(verdict.points for verdict in verdicts) == 0


def test_data_of_another_student_are_not_followed_through():
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis")
    own = references(exercise, v)
    p = own["three_axis_p"].copy()
    p[:, 3:] += 0.1  # more than half right, so that A may follow from it
    part = part_of(exercise, "three_axis_A")
    A = part.solve(v, {"three_axis_p": p, "three_axis_z": own["three_axis_z"]})
    sheet = {"three_axis_p": p, "three_axis_A": A}
    alone = verdicts_of("three_axis", sheet)["three_axis_A"]
    seen = verdicts_of("three_axis", sheet, others={"neighbour": {"three_axis_p": p.tolist()}})
    assert (alone.status, alone.points) == ("follows", part.points)
    assert seen["three_axis_A"].points < part.points
    private = [f.text for f in seen["three_axis_p"].findings if f.private]
    assert private == ["This is the reference answer of neighbour's variant."]


def test_a_joint_axis_that_many_share_tells_nobody_whose_it_is():
    z = -references(EXERCISES["three_axis"], variant_of("three_axis"))["three_axis_z"]
    verdict = verdicts_of(
        "three_axis", {"three_axis_z": z}, others={"neighbour": {"three_axis_z": z.tolist()}}
    )
    assert not any(finding.private for finding in verdict["three_axis_z"].findings)


def test_a_named_mistake_is_followed_through():
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis")
    own = references(exercise, v)
    z = -own["three_axis_z"]
    part = part_of(exercise, "three_axis_A")
    A = part.solve(v, {"three_axis_p": own["three_axis_p"], "three_axis_z": z})
    verdicts = verdicts_of("three_axis", {"three_axis_z": z, "three_axis_A": A})
    assert verdicts["three_axis_z"].points == 1  # of 2, for a concept
    assert verdicts["three_axis_A"].points == part.points


@pytest.mark.parametrize("slug", ["rrt", "puma_velocities", "three_axis"])
def test_numbers_made_up_are_not_followed_through(slug):
    """One made-up sheet for a whole class: consistent with itself, right for nobody."""
    paid = []
    for seed in range(24):
        rng = np.random.default_rng(seed)
        exercise, v = EXERCISES[slug], variant_of(slug, seed)
        made_up = {
            part.variable: rng.uniform(-1, 1, getattr(part.answer, "shape", (3, 4)))
            for part in exercise.parts
        }
        for part in exercise.parts[1:]:
            given = {name: made_up[name] for name in part.needs}
            if part.needs and slug != "rrt":
                made_up[part.variable] = part.solve(v, given)
        verdicts = mark(exercise, v, raws(made_up))
        paid.append(sum(verdict.points or 0 for verdict in verdicts))
    # By chance, one of three made-up numbers lies near a right one.
    assert np.mean(paid) < 0.5
    assert max(paid) <= 3


def test_zeros_do_not_follow_from_tiny_numbers():
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis")
    own = references(exercise, v)
    rng = np.random.default_rng(0)
    p = np.repeat(own["three_axis_p"][:, :1], 4, axis=1) + 5e-5 * rng.uniform(-1, 1, (3, 4))
    verdicts = verdicts_of("three_axis", {"three_axis_p": p, "three_axis_A": np.zeros((3, 3))})
    assert verdicts["three_axis_A"].points == 0


def test_an_unreadable_answer_does_not_cost_the_later_parts():
    verdicts = verdicts_of(
        "three_axis", {"three_axis_p": Raw("error", "cell 3 stopped with NameError: q")}
    )
    assert verdicts["three_axis_p"].status == "failed"
    assert text_of(verdicts["three_axis_p"]) == "In your file: cell 3 stopped with NameError: q."
    assert verdicts["three_axis_A"].status == verdicts["three_axis_J"].status == "correct"


def test_a_missing_answer_is_missing_and_worth_nothing():
    verdict = verdicts_of("three_axis", {"three_axis_p": Raw("missing")})["three_axis_p"]
    assert (verdict.status, verdict.points) == ("missing", 0)


def test_a_failure_of_ours_leaves_the_part_not_graded_and_the_others_marked():
    exercise, v = EXERCISES["puma_velocities"], variant_of("puma_velocities")

    def broken(*_):
        raise RuntimeError("a fault in the exercise file")

    name = "puma_velocities_qdot"
    parts = [
        dataclasses.replace(part, check=broken) if part.variable == name else part
        for part in exercise.parts
    ]
    verdicts = mark(dataclasses.replace(exercise, parts=tuple(parts)), v, right_raws(exercise, v))
    assert {verdict.part for verdict in verdicts if verdict.status == "correct"} == {
        part.variable for part in exercise.asked if part.variable != name
    }
    (failed,) = (verdict for verdict in verdicts if verdict.part == name)
    assert (failed.status, failed.points) == ("not_graded", None)


@pytest.mark.parametrize(
    ("cells", "status", "words"),
    [
        ([["q1", "l1", "0", "pi/2"], ["theta2", "0", "l2", "0"]], "correct", ""),
        ([["q1", "0.5", "0", "1.5708"], ["q2", "0", "0.3", "0"]], "correct", ""),
        (
            [["q1", "l1", "0", "-pi/2"], ["q2", "0", "l2", "0"]],
            "partly",
            "The twist turns the other way.",
        ),
        (
            [["0.4", "l1", "0", "pi/2"], ["q2", "0", "l2", "0"]],
            "failed",
            "Row 1, theta: takes q1, got 0.4.",
        ),
        ([["q3", "l1", "0", "pi/2"], ["q2", "0", "l2", "0"]], "failed", "unknown name 'q3'"),
        (
            np.array([[0.4, 0.5, 0, 1.5708], [0.2, 0, 0.3, 0]]),
            "failed",
            "Row 1, theta: takes q1, got 0.4.",
        ),
    ],
)
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_a_table_is_asked_without_a_q(cells, status, words, convention):
    def table(twist):
        return read_table(
            [["q1", "l1", "0", twist], ["q2", "0", "l2", "0"]], ("q1", "q2", "l1", "l2"), convention
        )

    slip = Mistake("The twist turns the other way.", lambda *_: table("-pi/2"))
    answer = TableOf(("l1", "l2"), "RR", convention)
    asked = Part("t_dh", "The table", 3, answer, lambda *_: table("pi/2"), mistakes=(slip,))
    exercise = exercise_of(
        asked, units={"l1": "m", "l2": "m"}, draw=lambda _: {"l1": 0.5, "l2": 0.3}
    )
    handed = {"t_dh": raw(cells)}
    (verdict,) = mark(exercise, exercise.draw(np.random.default_rng(0)), handed)
    assert verdict.status == status
    assert words in text_of(verdict)
    (remark,) = remarks(exercise, {"l1": 0.5, "l2": 0.3}, handed, consistency=True)
    assert remark.ok is (status != "failed")


@pytest.mark.parametrize("by_hand", [False, True])
def test_a_reader_that_fails_leaves_its_part_not_graded_and_the_others_marked(
    monkeypatch, caplog, by_hand
):
    exercise, v = EXERCISES["pseudoinverse"], variant_of("pseudoinverse")
    part = next(part for part in exercise.asked if isinstance(part.answer, Manual) is by_hand)

    def failing(answer, raw, v):
        if answer is part.answer:
            raise RuntimeError("a fault in a reader")
        return read(answer, raw, v)

    monkeypatch.setattr("kinegrade.grader.marking.unjudged.read", failing)
    verdicts = {verdict.part: verdict for verdict in mark(exercise, v, right_raws(exercise, v))}
    failed = verdicts.pop(part.variable)
    assert (failed.status, failed.points) == ("not_graded", None)
    assert "The grader failed on this part" in text_of(failed)
    assert f"{part.variable} could not be marked" in caplog.text
    others = [
        one
        for one in exercise.asked
        if one.variable in verdicts and not isinstance(one.answer, Manual)
    ]
    assert [verdicts[one.variable].status for one in others] == ["correct"] * len(others)


@pytest.mark.parametrize("spoil", [False, True])
def test_a_verdict_survives_json(exercise, spoil):
    v = variant_of(exercise.slug)
    answers = references(exercise, v)
    if spoil:
        answers = {part.variable: wrong(part, answers[part.variable], v) for part in exercise.asked}
    for verdict in mark(exercise, v, raws_of(exercise, v, answers)):
        assert Verdict.from_json(json.loads(json.dumps(verdict.to_json()))) == verdict


def test_no_verdict_holds_a_reference_value_that_was_not_handed_in(exercise):
    v = variant_of(exercise.slug)
    answers = references(exercise, v)
    own = {part.variable: wrong(part, answers[part.variable], v) for part in exercise.asked}
    verdicts = {verdict.part: verdict for verdict in mark(exercise, v, raws_of(exercise, v, own))}
    for part in exercise.asked:
        verdict = verdicts[part.variable]
        assert verdict.status != "correct"
        said = " ".join([verdict.reading, text_of(verdict)])
        shown = json.dumps([verdict.answer, verdict.right])
        told = telling(part, answers[part.variable], v) - telling(part, own[part.variable], v)
        assert [text for text in told if text in said or text in shown] == []


def test_every_mistake_that_an_exercise_knows_is_named(exercise):
    for seed in SEEDS:
        v = variant_of(exercise.slug, seed)
        key = AnswerKey(exercise, v)
        for part in exercise.asked:
            given = {need: key.reference[need] for need in part.needs}
            for mistake in part.mistakes:
                own = raws_of(exercise, v, key.reference | {part.variable: mistake.solve(v, given)})
                verdicts = {verdict.part: verdict for verdict in mark(exercise, v, own, key=key)}
                said = text_of(
                    verdicts[part.variable]
                )  # on some draws two mistakes lead to the same
                assert any(known.sentence in said for known in part.mistakes), (part.variable, seed)


def test_what_is_marked_by_hand_waits_with_its_text_and_earns_nothing_yet():
    exercise = EXERCISES["pseudoinverse"]
    (part,) = (part for part in exercise.asked if isinstance(part.answer, Manual))
    waiting = verdicts_of("pseudoinverse", {part.variable: "My reason.\nAnd another."})[
        part.variable
    ]
    assert (waiting.status, waiting.points, waiting.answer) == (
        "not_graded",
        None,
        "My reason.\nAnd another.",
    )
    missing = verdicts_of("pseudoinverse", {part.variable: Raw("missing")})[part.variable]
    assert (missing.status, missing.points) == ("missing", 0)


def test_a_function_as_it_was_handed_out_is_not_answered():
    nothing = Raw("error", "call 1: not a matrix of numbers: None")
    verdict = verdicts_of("implement_it", {"implement_it_jacobian": Raw("calls", [nothing] * 12)})
    blank = verdict["implement_it_jacobian"]
    assert (blank.status, blank.points, text_of(blank)) == (
        "missing",
        0,
        "The function returns nothing.",
    )


def in_tool_axes(exercise, v):
    arm = exercise.arm(v)
    return tool_axes(arm.frames, arm.kinds)


def test_rates_follow_from_a_jacobian_in_the_tool_frame():
    exercise, v = EXERCISES["puma_velocities"], variant_of("puma_velocities")
    J = part_of(exercise, "puma_velocities_J")
    later = [part_of(exercise, name) for name in ("puma_velocities_twist", "puma_velocities_qdot")]
    own = {J.variable: in_tool_axes(exercise, v)}
    own |= {part.variable: part.solve(v, own) for part in later}
    points = {verdict.part: verdict.points for verdict in mark(exercise, v, raws(own))}
    assert [points[name] for name in own] == [J.points / 2, *(part.points for part in later)]


def test_a_wrong_value_from_a_cell_that_stopped_half_way_says_so():
    half = Raw("num", np.zeros((6, 3)), note="cell 9 stopped with IndexError: index 3")
    verdict = verdicts_of("rrt", {"rrt_J": half})["rrt_J"]
    assert text_of(verdict).endswith("In your file: cell 9 stopped with IndexError: index 3.")
    assert text_of(verdicts_of("rrt", {"rrt_J": Raw("missing", note="never mind")})["rrt_J"]) == ""
