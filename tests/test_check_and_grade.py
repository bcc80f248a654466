"""A check on the student's machine and the grade never contradict each other."""

import numpy as np
import pytest
from answers import EXERCISES, SLUGS, raws_of, variant_of
from kinegrade.course.habits import HABITS, Code
from kinegrade.exercises.exercise import ExerciseError, references, solve
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.own_work import remarks

TAKEN = [habit for habit in HABITS if habit.title not in ("empty", "somebody else's variant")]
FOLLOWS = "can be read and follows from your own"


def handed_in(exercise, v, habit):
    """What a student of this habit hands in; cells that do not run leave an error behind."""
    found = {}
    for name, answer in habit.spoil(exercise, v, references(exercise, v)).items():
        found[name] = Raw("error", "cell 3 stopped") if isinstance(answer, Code) else answer
    return raws_of(exercise, v, found)


def compared(exercise, v, raws):
    """Verdict and remark of every part."""
    verdicts = {verdict.part: verdict for verdict in mark(exercise, v, raws)}
    told = {remark.part: remark for remark in remarks(exercise, v, raws, consistency=True)}
    assert [*verdicts] == [*told]
    return [(verdicts[name], told[name]) for name in verdicts]


def assert_they_agree(verdict, remark):
    if verdict.status in ("missing", "failed"):
        assert not remark.ok, (verdict, remark)
    if remark.text.startswith(FOLLOWS):
        assert verdict.status in ("correct", "follows", "partly"), (verdict, remark)
        assert verdict.points > 0, (verdict, remark)
    if verdict.status == "follows":  # of a choice, or what a check judges, nothing is said
        said = remark.text.startswith(FOLLOWS) or remark.text == "can be read"
        assert said, (verdict, remark)
    if any("Nothing follows" in finding.text for finding in verdict.findings):
        assert not remark.text.startswith(FOLLOWS), (verdict, remark)


@pytest.mark.parametrize("habit", TAKEN, ids=lambda habit: habit.title)
@pytest.mark.parametrize("slug", SLUGS)
def test_check_and_grade_say_the_same_of_every_answer_of_the_demo_class(slug, habit):
    exercise, v = EXERCISES[slug], variant_of(slug)
    for verdict, remark in compared(exercise, v, handed_in(exercise, v, habit)):
        assert_they_agree(verdict, remark)


def carried_on(exercise, v, part, mistake):
    """Answers with one mistake and all that follows from it; the right one where nothing does."""
    given, right = {}, references(exercise, v)
    for other in exercise.parts:
        name = other.variable
        try:
            with np.errstate(all="ignore"):
                given[name] = solve(exercise.slug, other, v, given)
        except ExerciseError:
            given[name] = right[name]
        if other is part:
            wrong = mistake.solve(v, {need: given[need] for need in part.needs})
            given[name] = part.answer.declared(wrong, v)
    return raws_of(exercise, v, given)


@pytest.mark.parametrize("slug", SLUGS)
def test_check_and_grade_say_the_same_where_a_known_mistake_is_carried_on(slug):
    exercise, v = EXERCISES[slug], variant_of(slug)
    for part in exercise.asked:
        for mistake in part.mistakes:
            raws = carried_on(exercise, v, part, mistake)
            for verdict, remark in compared(exercise, v, raws):
                assert_they_agree(verdict, remark)
