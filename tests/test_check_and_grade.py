"""Self-check, check and grade never contradict each other about the same answer."""

import io
from contextlib import redirect_stdout, suppress

import numpy as np
import pytest
from answers import EXERCISES, SLUGS, raws_of, variant_of
from kinegrade.course.commands.demo import _code
from kinegrade.course.commands.habits import HABITS, Code
from kinegrade.course.sheet.self_check import self_check
from kinegrade.exercises.exercise import ExerciseError, references, solve
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.own_work import remarks

TAKEN = [habit for habit in HABITS if habit.title not in ("empty", "somebody else's variant")]
WITHOUT_LOOPS = [habit for habit in TAKEN if "loop" not in habit.title]
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


def self_checked(exercise, v, habit):
    """What the sheet's own cell says of every part, where the answers are typed as a student would."""
    scope = {"np": np}
    for part in exercise.asked:
        answers = habit.spoil(exercise, v, references(exercise, v))
        if part.variable not in answers:
            continue
        with suppress(SyntaxError):
            exec(_code(part, answers[part.variable]), scope)  # noqa: S102
    out = io.StringIO()
    with redirect_stdout(out):
        exec(self_check(exercise.asked), scope)  # noqa: S102
    return dict(line.split(None, 1) for line in out.getvalue().splitlines())


@pytest.mark.parametrize("habit", WITHOUT_LOOPS, ids=lambda habit: habit.title)
@pytest.mark.parametrize("slug", SLUGS)
def test_the_sheets_own_cell_and_check_and_grade_say_the_same(slug, habit):
    exercise, v = EXERCISES[slug], variant_of(slug)
    told = self_checked(exercise, v, habit)
    for verdict, remark in compared(exercise, v, handed_in(exercise, v, habit)):
        if verdict.part not in told:  # on paper
            continue
        words = told[verdict.part]
        if words.startswith("ready"):
            assert verdict.status not in ("missing", "failed"), (verdict, words)
            assert "can be read" in remark.text or "marked by hand" in remark.text, remark
        elif words == "not answered yet":
            assert verdict.status in ("missing", "failed"), (verdict, words)
            assert not remark.ok
        else:
            assert verdict.status == "failed", (verdict, words)
            assert not remark.ok


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
