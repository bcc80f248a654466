"""Whose reference answers somebody handed in, in a class of any size."""

import numpy as np
import pytest
from answers import EXERCISES, variant_of
from kinegrade.course.marking.owners import Owners
from kinegrade.course.variants.record import fingerprint
from kinegrade.grader.marking.follow import owner_of
from kinegrade.grader.marking.verdict import Verdict

EXERCISE = EXERCISES["puma_velocities"]
J = "puma_velocities_J"
SEEDS = {f"s{seed}": seed for seed in range(8)}


@pytest.fixture(scope="module")
def answers():
    found = {}
    for student, seed in SEEDS.items():
        found[student] = fingerprint(EXERCISE, variant_of("puma_velocities", seed))
    return found


def wrong(answer, status="incorrect"):
    return [Verdict(J, status, 0.0, 2.0, answer=answer)]


@pytest.mark.parametrize("owner", SEEDS)
def test_the_owner_is_found_as_by_looking_at_everybody(answers, owner):
    owners = Owners([EXERCISE], lambda _: answers)
    copied = (np.array(answers[owner][J]) + 1.5e-3).tolist()
    part = next(part for part in EXERCISE.asked if part.variable == J)
    for student in SEEDS:
        others = {one: own for one, own in answers.items() if one != student}
        by_all = owner_of(part, np.array(copied), others)
        found = owners.of(student, wrong(copied))
        assert found == ({EXERCISE.slug: {owner: answers[owner]}} if by_all else {})
        assert bool(by_all) == (student != owner)


def test_of_several_owners_the_first_is_named(answers):
    twice = {**answers, "s7": answers["s2"]}
    owners = Owners([EXERCISE], lambda _: twice)
    assert [*owners.of("s0", wrong(answers["s2"][J]))[EXERCISE.slug]] == ["s2"]
    assert [*owners.of("s2", wrong(answers["s2"][J]))[EXERCISE.slug]] == ["s7"]


@pytest.mark.parametrize(
    "verdicts",
    [
        wrong(None),
        wrong(np.ones((6, 6)).tolist()),
        [Verdict("of_another_sheet", "incorrect", 0.0, 2.0, answer=[1.0])],
    ],
)
def test_what_tells_nothing_is_nobodys(answers, verdicts):
    assert Owners([EXERCISE], lambda _: answers).of("s0", verdicts) == {}


def test_right_answers_are_not_looked_for(answers):
    owners = Owners([EXERCISE], lambda _: pytest.fail("looked for"))
    assert owners.of("s0", wrong(answers["s1"][J], "correct")) == {}


def test_records_of_an_older_shape_are_passed_over(answers):
    older = {"s1": {J: [1.0, 2.0]}, "s2": {}, "s3": answers["s3"]}
    owners = Owners([EXERCISE], lambda _: older)
    assert owners.of("s0", wrong(answers["s3"][J])) == {EXERCISE.slug: {"s3": older["s3"]}}
