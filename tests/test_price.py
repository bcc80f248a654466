"""A mistake with a name costs once; made-up and shared numbers lead to nothing."""

import numpy as np
import pytest
from answers import EXERCISES, part_of, raws, variant_of
from kinegrade.exercises.answers import Choice, Numbers
from kinegrade.exercises.exercise import Part, references
from kinegrade.grader.kinds.marker import Named
from kinegrade.grader.marking.follow import is_printed, is_unrelated, shared_with
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.misread import MOST, misread
from kinegrade.grader.marking.price import Bill, Price

PUMA = EXERCISES["puma_velocities"]
J = part_of(PUMA, "puma_velocities_J")
TWIST = part_of(PUMA, "puma_velocities_twist")
PART = Part("t_x", "x?", 4, Numbers((2,), "m"), lambda *_: np.array([0.3, 0.4]))
OTHER = Part("t_y", "y?", 4, Numbers((2,), "m"), lambda *_: np.array([0.3, 0.4]))
VALUE = np.array([0.5, 0.6])


def verdicts_of(exercise, v, answers, **options):
    return {verdict.part: verdict for verdict in mark(exercise, v, raws(answers), **options)}


def text_of(verdict, *, private=False):
    return " ".join(f.text for f in verdict.findings if f.private is private)


@pytest.mark.parametrize(
    ("fault", "share"), [("slip", 0.75), ("presentation", 0.75), ("concept", 0.5), (None, 0)]
)
def test_each_kind_of_mistake_leaves_its_share(fault, share):
    assert Bill().share(PART, Named("Said.", fault), VALUE) == (share, "")


def test_a_course_sets_its_own_prices():
    bill = Bill(Price(slip=0.1, concept=1.0))
    assert bill.share(PART, Named("a", "slip"), VALUE)[0] == 0.9
    assert bill.share(PART, Named("b", "concept"), VALUE)[0] == 0


def test_the_same_mistake_is_charged_once():
    bill, named = Bill(), Named("In millimetres.", "presentation")
    assert bill.share(PART, named, VALUE) == (0.75, "")
    assert bill.share(OTHER, named, VALUE) == (0.75, "")  # nothing was paid so far
    bill.charge(PART, named)
    assert bill.share(OTHER, named, VALUE) == (1.0, "t_x")
    assert bill.share(PART, named, VALUE) == (0.75, "")


def test_the_same_sentence_on_another_entry_is_another_slip():
    bill, named = Bill(), Named("Only entry 1 is wrong.", "slip", local=True)
    bill.charge(PART, named)
    assert bill.share(OTHER, named, VALUE) == (0.75, "")


@pytest.mark.parametrize("value", [np.zeros(2), np.ones(2), np.array([-1.0, 0.0])])
def test_what_anybody_could_guess_is_worth_nothing_under_any_name(value):
    assert Bill().share(PART, Named("Said.", "slip"), value)[0] == 0


def test_a_letter_has_no_price():
    letter = Part("t_c", "?", 1, Choice(("one", "two")), lambda *_: "a")
    assert Bill().share(letter, Named("Said.", "concept"), "b")[0] == 0


def test_few_decimals_cost_once_a_sheet():
    v = variant_of("puma_velocities")
    right = references(PUMA, v)
    short = {name: np.round(value, 2) for name, value in right.items() if name != "x"}
    bill = Bill()
    first = verdicts_of(PUMA, v, short, bill=bill)[J.variable]
    assert first.points == J.points * 0.75
    assert set(bill.charged) == {"decimals"}
    again = verdicts_of(PUMA, v, short, bill=Bill(charged={"decimals": "rrt_J"}))[J.variable]
    assert again.points == J.points
    assert "It was charged in rrt_J already." in text_of(again)


@pytest.mark.parametrize(
    ("change", "words", "share"),
    [
        (lambda J: J[[1, 0, 2, 3, 4, 5]], "Rows 1 and 2 are exchanged.", 0.75),
        (lambda J: J[:, [0, 2, 1, 3, 4, 5]], "Columns 2 and 3 are exchanged.", 0.75),
        (np.transpose, "transposed", 0.75),
        (np.negative, "Every sign is reversed.", 0.5),
    ],
)
@pytest.mark.parametrize("seed", range(3))
def test_a_matrix_that_is_right_but_for_one_thing_keeps_the_rest(change, words, share, seed):
    v = variant_of("puma_velocities", seed)
    answers = {J.variable: change(references(PUMA, v)[J.variable])}
    verdict = verdicts_of(PUMA, v, answers)[J.variable]
    assert words in text_of(verdict)
    assert verdict.points >= share * J.points
    assert verdict.status == "partly"


def test_a_single_wrong_entry_is_named_by_its_place():
    v = variant_of("puma_velocities")
    own = references(PUMA, v)[J.variable].copy()
    own[0, 1] += 0.17
    verdict = verdicts_of(PUMA, v, {J.variable: own})[J.variable]
    assert "Only row 1, column 2 is wrong; all the rest is right." in text_of(verdict)


def test_printed_numbers_taken_otherwise_are_named():
    v = variant_of("puma_velocities")
    q = [v["q"][1], v["q"][0], *v["q"][2:]]
    own = references(PUMA, {**v, "q": q})[J.variable]
    verdict = verdicts_of(PUMA, v, {J.variable: own})[J.variable]
    assert text_of(verdict) == "It fits q[1] and q[2] exchanged."
    assert verdict.points >= 0.75 * J.points
    own = references(PUMA, {**v, "q": [*v["q"][:2], -v["q"][2], *v["q"][3:]]})[J.variable]
    assert "It fits the other sign of q[3]." in text_of(
        verdicts_of(PUMA, v, {J.variable: own})[J.variable]
    )


def test_ways_to_misread_are_few_and_all_different(exercise):
    v = variant_of(exercise.slug)
    ways = misread(exercise, v)
    assert len(ways) <= MOST
    assert len({sentence for sentence, *_ in ways}) == len(ways)
    assert all(taken != v for *_, taken in ways)


def test_the_same_wrong_personal_numbers_lead_to_nothing_for_either():
    v, w = variant_of("puma_velocities", 0), variant_of("puma_velocities", 1)
    made = references(PUMA, v)[J.variable] + 0.1
    for mine, peer in ((v, "ben"), (w, "ada")):
        own = {J.variable: made, TWIST.variable: TWIST.solve(mine, {J.variable: made})}
        found = verdicts_of(PUMA, mine, own, peers={peer: {J.variable: made.tolist()}})
        assert found[TWIST.variable].points == 0
        assert text_of(found[J.variable], private=True) == f"{peer} handed in the same numbers."
        assert "another student has the same numbers" in text_of(found[TWIST.variable])
        assert peer not in text_of(found[TWIST.variable])


def test_a_shared_joint_axis_still_follows():
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis")
    own = references(exercise, v)
    z, A = -own["three_axis_z"], part_of(exercise, "three_axis_A")
    answers = {**own, "three_axis_z": z}
    answers[A.variable] = A.solve(v, answers)
    peers = {"ben": {"three_axis_z": z.tolist()}}
    found = verdicts_of(exercise, v, answers, peers=peers)
    assert (found[A.variable].status, found[A.variable].points) == ("follows", A.points)


def test_only_wrong_numbers_can_be_shared():
    reference = np.arange(2.0, 8.0).reshape(2, 3) / 7
    peers = {"ben": {"t_x": reference.tolist()}}
    assert shared_with(PART, reference, reference, peers) == ""
    assert shared_with(PART, reference + 0.3, reference, peers) == ""
    wrong = {"ben": {"t_x": (reference + 0.3).tolist()}}
    assert shared_with(PART, reference + 0.3, reference, wrong) == "ben"


def test_who_has_many_numbers_right_computed_them_and_the_other_took_them():
    reference = np.arange(2.0, 14.0).reshape(2, 6) / 7
    answer = reference + np.array([[0.0], [0.3]])
    peers = {"ben": {"t_x": answer.tolist()}}
    assert shared_with(PART, answer, reference, peers) == ""
    assert shared_with(PART, answer, reference + 1, peers) == "ben"


def test_made_up_numbers_are_related_to_nothing_and_honest_ones_to_something():
    rng = np.random.default_rng(0)
    related = 0
    for seed in range(20):
        reference = references(PUMA, variant_of("puma_velocities", seed))[J.variable]
        assert not is_unrelated(J, reference, reference[:, ::-1] * -1)
        related += not is_unrelated(J, reference, rng.uniform(-1, 1, (6, 6)))
    assert related == 0


@pytest.mark.parametrize("slug", ["puma_velocities", "three_axis", "desired_pose", "statics"])
def test_a_made_up_sheet_earns_next_to_nothing(slug):
    exercise, earned = EXERCISES[slug], []
    for seed in range(12):
        rng, v = np.random.default_rng(seed), variant_of(slug, seed)
        made = {}
        for part in exercise.parts:
            given = {name: made[name] for name in part.needs}
            value = rng.uniform(-1, 1, getattr(part.answer, "shape", ()))
            if part.needs:
                value = part.solve(v, given)
            made[part.variable] = value
        asked = {part.variable: made[part.variable] for part in exercise.asked}
        earned.append(sum(x.points or 0 for x in mark(exercise, v, raws(asked))))
    assert np.mean(earned) < 0.05 * exercise.points


def test_an_array_that_the_sheet_prints_is_worth_nothing_under_any_name():
    exercise = EXERCISES["find_the_mistake"]
    for seed in range(4):
        v = variant_of("find_the_mistake", seed)
        printed = np.array(v["W"])
        assert is_printed(exercise, v, printed)
        assert not is_printed(exercise, v, printed + 0.01)
        verdict = verdicts_of(exercise, v, {"find_the_mistake_J": printed})["find_the_mistake_J"]
        assert verdict.points == 0
