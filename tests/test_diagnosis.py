"""Wrong answers explained by known mistakes of any arm: the right ones, and never others."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from kinegrade.exercises.arm import Arm
from kinegrade.grader.diagnosis.bank import Bank, mistakes_of
from kinegrade.grader.diagnosis.explain import Alternatives, Seen, explained, hinted
from kinegrade.grader.diagnosis.mistake import Known
from kinegrade.grader.diagnosis.steps import steps_of
from kinegrade.grader.diagnosis.wording import either, two_mistakes
from kinegrade.solutions.robots import ROBOTS

NAMES = ["planar_2r", "three_axis", "rrt_offset", "scara", "stanford", "puma560", "panda"]
CONVENTIONS = (Path(__file__).parents[1] / "docs" / "conventions.md").read_text(encoding="utf-8")
ALLOWED = 2e-3
DECIMALS = 3
SHOWS = {None: 3e-3, 3: 4e-3, 2: 1.2e-2}  # by which an answer so rounded differs from the right one


def arm_of(name: str, rng: np.random.Generator) -> Arm:
    """With numbers of a sheet: no right angles, and nothing zero."""
    robot = ROBOTS[name]
    lengths = {length: round(rng.uniform(0.3, 1.2), 2) for length in robot.parameters}
    angles = rng.uniform(0.3, 1.2, robot.n) * rng.choice([-1, 1], robot.n)
    slides = np.array([kind == "P" for kind in robot.kinds])
    return Arm(robot, lengths, np.where(slides, np.abs(angles), angles).round(3))


def known_of(arm: Arm, what: str) -> Alternatives:
    reference = getattr(arm, what)
    bank = Bank([steps_of(arm)])
    view = bank.view([reference], {})
    assert view is not None
    return Alternatives(bank, view, [reference])


def seen(value: np.ndarray) -> Seen:
    return Seen([value], [np.full(value.shape, ALLOWED)])


def same_answers(known: Alternatives, value: np.ndarray, off: float) -> set[str]:
    """Titles of the mistakes that lead to an answer."""
    rules, (answers,) = known.singles
    close = (np.abs(answers - value) <= off).reshape(len(answers), -1).all(axis=1)
    return {rules[place][0].title for place in np.flatnonzero(close)}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("what", ["J", "T"])
@pytest.mark.parametrize("decimals", [None, 3, 2])
def test_a_known_mistake_is_never_explained_by_another_one(name, what, decimals):
    rng = np.random.default_rng(7)
    met = 0
    for _ in range(2):
        known = known_of(arm_of(name, rng), what)
        rules, (answers,) = known.singles
        for (mistake,), answer in zip(rules, answers, strict=True):
            off = np.abs(answer - known.references[0]).max()
            if not off > SHOWS[decimals]:  # nor is it where it is not a number
                continue
            value = answer if decimals is None else np.round(answer, decimals)
            told: Any = explained(known, seen(value), DECIMALS)
            assert told is not None, mistake.title
            allowed = ALLOWED if decimals != 2 else 5.1e-3
            assert told.titles <= same_answers(known, value, allowed), mistake.title
            families = {title.partition(":")[0] for title in told.titles}
            assert mistake.family in families
            met += 1
    assert met > 20


@pytest.mark.parametrize("kind", ["random", "shuffled", "noisy", "neighbour's"])
def test_an_answer_without_a_mistake_of_the_library_has_no_name(kind):
    rng = np.random.default_rng(11)
    for number in range(450):
        name = NAMES[number % len(NAMES)]
        what = "T" if number % 3 == 0 else "J"
        known = known_of(arm_of(name, rng), what)
        right = known.references[0]
        if kind == "random":
            value = rng.uniform(-1.5, 1.5, right.shape)
        elif kind == "shuffled":
            value = rng.permutation(right.ravel()).reshape(right.shape)
        elif kind == "noisy":
            off = rng.uniform(1.5 * ALLOWED, 10 * ALLOWED, right.shape)
            value = right + off * rng.choice([-1, 1], right.shape)
        else:
            value = getattr(arm_of(name, rng), what)
        assert explained(known, seen(value), DECIMALS) is None
        if number % 45 == 0:  # pairs take longer
            assert hinted(known, seen(value), DECIMALS) is None


def test_the_right_answer_at_two_decimals_has_no_name():
    known = known_of(arm_of("puma560", np.random.default_rng(1)), "J")
    value = np.round(known.references[0], 2)
    assert explained(known, seen(value), DECIMALS) is None
    assert hinted(known, seen(value), DECIMALS) is None


@pytest.mark.parametrize("name", ["a2", "d4"])
def test_another_value_of_a_length_is_named_and_not_told(name):
    arm = arm_of("puma560", np.random.default_rng(2))
    other = Arm(arm.robot, {**arm.lengths, name: arm.lengths[name] + 0.17}, arm.q)
    told: Any = explained(known_of(arm, "J"), seen(other.J), DECIMALS)
    assert told.sentence == f"It fits another value of {name}; all else agrees."
    assert told.fault == "slip"


def test_a_forgotten_length_is_said_to_be_forgotten():
    arm = arm_of("puma560", np.random.default_rng(2))
    without = Arm(arm.robot, {**arm.lengths, "a2": 0.0}, arm.q)
    told: Any = explained(known_of(arm, "J"), seen(without.J), DECIMALS)
    assert told.sentence == "It fits a2 = 0: that number seems to be forgotten."
    assert told.fault == "concept"


@pytest.mark.parametrize("joint", [2, 3])
@pytest.mark.parametrize("what", ["J", "T"])
def test_another_angle_is_named_and_not_told(joint, what):
    arm = arm_of("puma560", np.random.default_rng(3))
    q = arm.q.copy()
    q[joint - 1] += 0.4
    told: Any = explained(known_of(arm, what), seen(getattr(arm.at(q), what)), DECIMALS)
    assert told.sentence == f"It fits another angle of joint {joint}; all else agrees."


def test_another_stroke_is_named():
    arm = arm_of("stanford", np.random.default_rng(3))
    q = arm.q + np.array([0, 0, 0.2, 0, 0, 0])
    told: Any = explained(known_of(arm, "J"), seen(arm.at(q).J), DECIMALS)
    assert told.sentence == "It fits another stroke of joint 3; all else agrees."


def test_two_mistakes_are_a_hint_without_a_price():
    arm = arm_of("puma560", np.random.default_rng(4))
    known = known_of(arm, "J")
    rules, (answers,) = known.pairs
    titles = [{one.title, other.title} for one, other in rules]
    place = titles.index({"sign of alpha: 1", "lever from the base"})
    assert explained(known, seen(answers[place]), DECIMALS) is None
    told: Any = hinted(known, seen(answers[place]), DECIMALS)
    assert told.fault is None
    assert told.sentence == (
        "It is consistent with two mistakes: alpha of row 1 has the other sign; and the levers "
        "begin at the base."
    )


def test_a_planar_arm_has_no_pairs():
    known = known_of(arm_of("planar_2r", np.random.default_rng(4)), "J")
    _, (answers,) = known.pairs
    assert all(hinted(known, seen(answer), DECIMALS) is None for answer in answers[::25])


def test_one_mistake_and_one_wrong_entry_are_a_hint():
    known = known_of(arm_of("puma560", np.random.default_rng(5)), "J")
    rules, (answers,) = known.singles
    titles = [mistake.title for (mistake,) in rules]
    value = answers[titles.index("sign of alpha: 1")].copy()
    value[1, 3] += 0.3
    told: Any = hinted(known, seen(value), DECIMALS)
    assert told.sentence.startswith("But for row 2, column 4 it fits one mistake. Row 1: alpha")
    assert told.fault is None


def test_what_another_answer_was_explained_by_narrows_the_class():
    arm = arm_of("rrt_offset", np.random.default_rng(6))
    known = known_of(arm, "J")
    rules, (answers,) = known.singles
    for (mistake,), answer in zip(rules, answers, strict=True):
        told: Any = explained(known, seen(answer), DECIMALS)
        if told is not None and len(told.titles) > 1 and mistake.title in told.titles:
            narrowed: Any = explained(known, seen(answer), DECIMALS, [{mistake.title}])
            assert narrowed.sentence == mistake.sentence
            assert explained(known, seen(answer), DECIMALS, [{"nothing known"}]) == told
            return
    pytest.fail("no class of this arm has several mistakes")


def mistakes() -> list:
    found = []
    for name in ROBOTS:
        steps = steps_of(arm_of(name, np.random.default_rng(8)))
        for setting in ((0, 0), (1, 1)):
            found += mistakes_of(steps, setting)
    return found


def test_no_sentence_tells_a_value():
    told = {text for mistake in mistakes() for text in (mistake.sentence, mistake.clause)}
    for text in told:
        plain = text.replace("3.14 in place of pi", "").replace("3.14 stands for pi", "")
        assert not re.search(r"\d\.\d", plain), text
        assert "{" not in text
    assert len(told) > 100


def test_sentences_end_and_clauses_do_not():
    for mistake in mistakes():
        assert mistake.sentence.endswith((".", "?"))
        assert not mistake.clause.endswith(".")


@pytest.mark.parametrize("topic", sorted({mistake.topic for mistake in mistakes()} - {""}))
def test_a_topic_stands_on_the_conventions_page(topic):
    assert f"**{topic}.**" in CONVENTIONS


A, B, C, D = [Known(x, f"It is {x}.", x, "slip", "numbers").of() for x in "abcd"]


@pytest.mark.parametrize(
    ("found", "sentence"),
    [
        ([A], "It is a."),
        ([A, B], "Either a, or b."),
        ([A, B, C], "Either a, or b, or c."),
        ([A, B, C, D], "Either a, or b, or c; other mistakes come to the same."),
    ],
)
def test_several_mistakes_are_said_in_one_sentence(found, sentence):
    assert either(found) == sentence


@pytest.mark.parametrize(
    ("found", "sentence"),
    [
        ([], ""),
        ([(A, B)], "It is consistent with two mistakes: a; and b."),
        ([(A, B), (A, C)], "It is consistent with two mistakes, one of which: a."),
        ([(A, B), (C, D)], "It is consistent with two mistakes: a, and b; or c, and d."),
        ([(A, B), (C, D), (A, C), (B, D)], ""),
    ],
)
def test_pairs_are_said_in_one_sentence(found, sentence):
    assert two_mistakes(found) == sentence
