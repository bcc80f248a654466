"""Variants that can tell: what a draw is refused for, found by computing, and what validating says of it."""

import json
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from answers import EXERCISES, variant_of
from courses import SECRET, lever
from kinegrade.course.proof.telling import accepted, all_told, told
from kinegrade.course.proof.telling_table import telling_lines
from kinegrade.course.proof.validation import Validation
from kinegrade.course.variants.variant import REFUSED, canonical, draw_record
from kinegrade.exercises.answers import Numbers
from kinegrade.exercises.draws import angles, length
from kinegrade.exercises.exercise import ExerciseError
from kinegrade.exercises.part import exercise as made
from kinegrade.exercises.part import part
from kinegrade.grader.telling.look import Look
from kinegrade.grader.telling.numbers import idle_numbers
from kinegrade.grader.telling.objections import Objection, objections
from kinegrade.grader.telling.rules import alike, passing
from kinegrade.grader.telling.siblings import siblings
from kinegrade.grader.telling.work import work

ABSOLUTE = "Angles add along the arm."
SAME = "It is the same."


def reach(lengths=(0.4, 1.2), turns=None, structure=()):
    """A planar arm that asks for its tip and where it goes."""

    def draw(rng):
        q = [turns(rng)] * 2 if turns else angles(rng, 2)
        v = {"l1": length(rng, *lengths), "l2": length(rng, *lengths), "q": q}
        if structure:
            v["rows"] = int(rng.integers(1, 3))
        return v

    @part(
        2,
        Numbers((2,), "m", 3),
        mistakes=[
            (ABSOLUTE, lambda l1, l2, q: l1 * unit(q[0]) + l2 * unit(q[1])),
            (SAME, lambda tip: tip),
        ],
    )
    def tip(l1, l2, q):
        """Where is the tip?

        - Add both links.

        There.
        """
        return l1 * unit(q[0]) + l2 * unit(q[0] + q[1])

    @part(1, Numbers((), "m", 3))
    def far(tip, v):
        """How far is that?

        - Pythagoras.

        So far.
        """
        return np.linalg.norm(tip[: v.get("rows", 2)])

    return made(
        "reach",
        title="Reach",
        source="made for tests",
        draw=draw,
        units={"l1": "m", "l2": "m", "q": ["rad"] * 2},
        structure=structure,
        scale=1.0,
        statement="An arm.",
        parts=[tip, far],
    )


def unit(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def against(exercise, **numbers):
    v = {"l1": 0.6, "l2": 0.8, "q": [0.5, 0.7], **numbers}
    return {(one.kind, one.what) for one in objections(Look(exercise, v))}


def test_a_draw_in_which_everything_shows_is_not_refused():
    assert against(reach()) == set()


def test_a_mistake_that_gives_the_right_answer_is_refused_by_its_sentence():
    assert ("rule", ABSOLUTE) in against(reach(), q=[0.0, 0.7])


def test_a_mistake_that_shows_in_no_draw_speaks_against_none():
    look = Look(reach(), variant_of_reach())
    assert passing(look.key, look.exercise.asked[0], [(SAME, look.key.reference["reach_tip"])])
    assert ("rule", SAME) not in against(reach())


def variant_of_reach():
    return {"l1": 0.6, "l2": 0.8, "q": [0.5, 0.7]}


@pytest.mark.parametrize("small", ["l1", "l2"])
def test_a_length_that_hardly_matters_is_refused_by_its_name(small):
    assert ("number", small) in against(reach(), **{small: 0.05})


def test_an_entry_of_a_vector_is_held_against_the_parts_that_take_it():
    look = Look(reach(), variant_of_reach())
    assert look.uses["q[1]"] == {"reach_tip"}
    assert look.uses["l1"] == {"reach_tip", "reach_far"}  # a length is carried on


def test_a_number_that_matters_in_no_draw_speaks_against_none():
    look = Look(EXERCISES["three_axis"], variant_of("three_axis", 3))
    assert "three_axis_dq" not in look.uses["L"]
    assert "L" not in {one.what for one in objections(look)}


def test_a_number_that_never_shows_is_told_and_not_refused():
    """Millimetres at three decimals of a metre: no draw is better."""
    tiny = reach(lengths=(0.01, 0.05))
    v, refused = accepted(tiny, 0)
    notes = {note for note, _ in told(tiny, v, refused).notes}
    assert ("number hidden", "reach_tip", "l1") in {(n.kind, n.part, n.what) for n in notes}


@pytest.mark.parametrize(
    ("q", "refused"),
    [([0.7, 0.5, 0.4], False), ([0.7, 0.5, 1.56], True), ([0.7, 0.5, -1.58], True)],
)
def test_a_factor_that_is_nearly_zero_where_it_is_not_meant_is_refused(q, refused):
    look = Look(EXERCISES["three_axis"], {**variant_of("three_axis", 3), "q": q})
    assert ("factor" in {one.kind for one in objections(look)}) is refused


def test_a_singular_posture_that_is_meant_is_not_refused_and_a_second_one_is():
    exercise = EXERCISES["inverse_velocities"]
    v = next(v for v in map(variant_of_inverse, range(20)) if abs(np.sin(v["q"][4])) < 1e-3)
    assert (
        next((one for one in objections(Look(exercise, v)) if one.kind == "factor"), None) is None
    )
    elbow = {**v, "q": [*v["q"][:2], -np.arctan2(0.4318, 0.0203), *v["q"][3:]]}
    assert "factor" in {one.kind for one in objections(Look(exercise, elbow))}


def variant_of_inverse(seed):
    return variant_of("inverse_velocities", seed)


def test_draws_are_compared_with_those_of_the_same_structure():
    by_rows = reach(structure=("rows",))
    one = Look(by_rows, {**variant_of_reach(), "rows": 1})
    other = Look(by_rows, {**variant_of_reach(), "rows": 2})
    assert one.structure != other.structure
    for look in (one, other):
        assert [sibling.structure for sibling in siblings(look)] == 6 * [look.structure]


def test_a_structure_that_is_met_once_is_compared_with_draws_of_any():
    rare = Look(reach(structure=("rows",)), {**variant_of_reach(), "rows": 7})
    assert len({sibling.structure for sibling in siblings(rare)}) == 2


def test_a_record_takes_the_first_attempt_that_tells():
    """Half of the draws have a right angle that hides a mistake."""
    some = reach(turns=lambda rng: [0.0, 0.6][int(rng.integers(2))])
    records = [draw_record(SECRET, "one", f"s{i}", some, ()) for i in range(12)]
    assert all(record.numbers["q"] == [0.6, 0.6] for record in records)
    assert any(record.attempt for record in records)


@pytest.mark.parametrize("room", ["variants.variant", "proof.telling"])
def test_where_no_draw_tells_the_one_against_which_least_speaks_is_taken(
    tmp_path, monkeypatch, room
):
    """Real arms have lengths that a few decimals hardly show: they have sheets all the same."""
    counts = iter([3, 2, *[1 if i == 5 else 4 for i in range(REFUSED)]])
    never = Objection("number", "lever_p", "L")
    seen = []

    def against(look):
        count = next(counts)
        seen.append((count, look.v))
        return iter([never] * count)

    monkeypatch.setattr(f"kinegrade.course.{room}.objections", against)
    if room == "variants.variant":
        numbers = draw_record(SECRET, "one", "ada", lever(tmp_path), ()).numbers
    else:
        numbers, refused = accepted(lever(tmp_path), 0)
        assert len(refused) == REFUSED
    assert len(seen) == REFUSED
    assert numbers == min(seen, key=lambda one: one[0])[1]


def test_pairs_of_mistakes_that_lead_to_one_answer_are_told():
    look = Look(reach(), variant_of_reach())
    (tip, _) = look.exercise.asked
    wrong = np.array([1.0, 2.0])
    rules = [("one", wrong), ("other", wrong + 1e-5), ("third", -wrong)]
    assert [*alike(look.key, tip, rules)] == [("one", "other")]


def test_numbers_that_matter_for_no_part_are_told_and_choices_are_no_reason_to_say_so():
    assert idle_numbers(Look(EXERCISES["puma_velocities"], variant_of("puma_velocities")).key) == [
        "q[6]"
    ]
    assert idle_numbers(Look(EXERCISES["frames"], variant_of("frames")).key) == []


def test_forms_of_unequal_work_are_told_unless_they_are_known_as_harder():
    puma = EXERCISES["puma_velocities"]
    lines = {}
    for known in ({}, puma.harder):
        declared = replace(puma, harder=known)
        found = [told(declared, variant_of("puma_velocities", seed), []) for seed in range(20)]
        lines[bool(known)] = _lines(declared, found)
    assert any("37 numbers where wording is 'orientation held" in line for line in lines[False])
    assert not any("numbers where" in line for line in lines[True])


def _lines(exercise, found):
    return [
        *telling_lines(
            Validation(exercise.slug, 3, 9, len(found), 0.0, (), telling=all_told(found))
        )
    ]


def test_the_work_of_a_part_is_counted_in_numbers_that_move_it():
    assert work(Look(reach(), variant_of_reach())) == {"reach_tip": 4, "reach_far": 4}


def test_harder_takes_names_of_structure():
    with pytest.raises(ExerciseError, match="harder takes names that stand in structure, got form"):
        replace(reach(), harder={"form": (1,)})


def test_a_hundred_draws_of_an_exercise_lose_less_than_three_in_five(exercise):
    """Every known mistake that can show does, and every number that a part uses matters."""
    draws = 100 if exercise.slug in CHEAP else 12
    refused = Counter()
    for seed in range(draws):
        v = json.loads(json.dumps(exercise.draw(np.random.default_rng(5000 + seed))))
        refused.update([one.kind for one in objections(Look(exercise, v))][:1])
    assert refused.total() <= 0.6 * draws, refused


CHEAP = ("dh_transforms", "implement_it", "inverse_velocities", "pseudoinverse", "puma_velocities")


def test_what_is_drawn_for_a_class_hides_nothing_that_its_structure_shows(exercise):
    taken = set()
    for student in range(6):
        record = draw_record(SECRET, "one", f"s{student}", exercise, taken)
        taken.add(canonical(record.numbers))
        assert not [*objections(Look(exercise, record.numbers))]
    assert len(taken) == 6
