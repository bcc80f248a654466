"""What courses ask: exercises written by instructors, of files in tests/exercises/, marked as they should be."""

from pathlib import Path

import numpy as np
import pytest
from answers import raws_of, right_raws
from kinegrade.course.settings.config import Sheet, Student
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.matlab import starter
from kinegrade.course.sheet.notebook import notebooks
from kinegrade.course.variants.drawn import drawn
from kinegrade.exercises.answers import Manual
from kinegrade.exercises.exercise import references
from kinegrade.exercises.files.finding import load
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.screws import screws

FOLDER = Path(__file__).parent / "exercises"
FILES = sorted(path.stem for path in FOLDER.glob("*.py"))
STUDENT = Student("ada", "Ada")


def of(slug, seed=0):
    exercise = load(FOLDER / f"{slug}.py")
    return exercise, drawn(exercise, np.random.default_rng(seed))


def verdicts(exercise, v, **own):
    """Verdicts by the names of the parts, where these answers stand in place of right ones."""
    named = {f"{exercise.slug}_{name}": value for name, value in own.items()}
    raws = {**right_raws(exercise, v), **raws_of(exercise, v, named)}
    return {
        verdict.part.removeprefix(f"{exercise.slug}_"): verdict
        for verdict in mark(exercise, v, raws)
    }


@pytest.mark.parametrize("slug", FILES)
def test_the_reference_earns_all_points(slug):
    exercise, v = of(slug, 5)
    by_hand = [part.variable for part in exercise.asked if isinstance(part.answer, Manual)]
    for verdict in mark(exercise, v, right_raws(exercise, v)):
        assert verdict.part in by_hand or verdict.points == verdict.out_of, verdict


@pytest.mark.parametrize("slug", FILES)
def test_every_known_mistake_is_named(slug):
    exercise, v = of(slug, 5)
    given = references(exercise, v)
    for part in exercise.asked:
        for mistake in part.mistakes:
            wrong = mistake.solve(v, {need: given[need] for need in part.needs})
            found = mark(exercise, v, raws_of(exercise, v, {**given, part.variable: wrong}))
            mine = next(verdict for verdict in found if verdict.part == part.variable)
            assert mine.status != "correct"
            assert any(mistake.sentence in finding.text for finding in mine.findings), (
                mistake.sentence
            )


@pytest.mark.parametrize(
    ("slug", "first"), [("statics_3r", "J"), ("newton_ik", "J"), ("screw_jacobian", "T")]
)
def test_what_is_computed_from_an_own_wrong_part_keeps_its_points(slug, first):
    exercise, v = of(slug, 5)
    own = references(exercise, v)
    wrong = own[f"{slug}_{first}"].copy()
    wrong[:2, -1] *= -1
    own[f"{slug}_{first}"] = wrong
    for part in exercise.asked:
        if f"{slug}_{first}" in part.needs:
            own[part.variable] = part.solve(v, {need: own[need] for need in part.needs})
    found = mark(exercise, v, raws_of(exercise, v, own))
    assert [verdict.part for verdict in found if verdict.status not in ("correct", "follows")] == [
        f"{slug}_{first}"
    ]
    assert all(verdict.points == verdict.out_of for verdict in found if verdict.status == "follows")


def test_torques_follow_from_power_in_a_planar_arm():
    exercise, v = of("statics_3r")
    got = references(exercise, v)
    angle = sum(v["q"])
    fx, fy, m = v["F_tool"]
    F = [np.cos(angle) * fx - np.sin(angle) * fy, np.sin(angle) * fx + np.cos(angle) * fy, m]
    np.testing.assert_allclose(got["statics_3r_F"], F, atol=1e-12)
    J = jacobian(ROBOTS["planar_3r"].chain({name: v[name] for name in ("l1", "l2", "l3")}), v["q"])[
        [0, 1, 5]
    ]
    np.testing.assert_allclose(got["statics_3r_tau"], J.T @ F, atol=1e-12)
    typed = Raw(
        "text",
        [f"{got['statics_3r_tau'][0]:.3f} N m", *(f"{x:.3f}" for x in got["statics_3r_tau"][1:])],
    )
    assert verdicts(exercise, v, tau=typed)["tau"].status == "correct"


def test_space_and_body_jacobian_have_the_angular_rows_on_top():
    exercise, v = of("screw_jacobian")
    got = references(exercise, v)
    lengths = {name: v[name] for name in ("a1", "a2", "d4")}
    chain = ROBOTS["scara"].chain(lengths)
    swap = [3, 4, 5, 0, 1, 2]
    np.testing.assert_allclose(
        got["screw_jacobian_J_s"], jacobian(chain, v["q"], point="origin")[swap], atol=1e-12
    )
    np.testing.assert_allclose(
        got["screw_jacobian_J_b"], jacobian(chain, v["q"], frame="tool")[swap], atol=1e-12
    )
    np.testing.assert_allclose(
        got["screw_jacobian_Ad"] @ got["screw_jacobian_J_b"], got["screw_jacobian_J_s"], atol=1e-12
    )
    np.testing.assert_allclose(
        got["screw_jacobian_J_s"][:, 0], screws(chain)[0][0][swap], atol=1e-12
    )  # S1 stays
    linear_first = verdicts(exercise, v, J_s=got["screw_jacobian_J_s"][swap])["J_s"]
    assert linear_first.points == 0.75 * linear_first.out_of
    assert "angular" in linear_first.findings[0].text
    sheet = Sheet(name="one", exercises=("screw_jacobian",))
    handout, _ = notebooks("Course", sheet, STUDENT, [Assignment(exercise, v)])
    assert "the angular rows stand above the linear ones" in handout.decode()
    script = starter("Course", sheet, STUDENT, [Assignment(exercise, v)])
    assert "angular rows above linear" in script
    assert "linear rows above angular" not in handout.decode() + script


def test_manipulability_is_read_in_any_spelling_and_the_slow_direction_is_named():
    exercise, v = of("ellipsoid_2r")
    for text in ("abs(l1*l2*sin(q2))", "l1*l2*|s2|", "l1*l2*sqrt(sin(q2)^2)"):
        assert verdicts(exercise, v, w=Raw("text", text))["w"].status == "correct"
    assert verdicts(exercise, v, w=Raw("text", "l1*l2*sin(q2)"))["w"].points == 0
    x, y = references(exercise, v)["ellipsoid_2r_axis"]
    assert verdicts(exercise, v, axis=np.array([-2 * x, -2 * y]))["axis"].status == "correct"
    slow = verdicts(exercise, v, axis=np.array([-y, x]))["axis"]
    assert slow.points == 0
    assert "slowest" in slow.findings[0].text
    one_branch = verdicts(exercise, v, best=Raw("num", np.array([np.pi / 2])))["best"]
    assert one_branch.points == 0.5


def test_a_solver_is_right_by_what_it_reaches():
    exercise, v = of("newton_ik")
    right = references(exercise, v)["newton_ik_solve"]

    def another(links, x, q0):
        q = right(links, x, q0)
        return q + 2 * np.pi  # other angles, the same tip

    def stuck(links, x, q0):
        return np.array(q0)

    assert verdicts(exercise, v, solve=another)["solve"].status == "correct"
    assert verdicts(exercise, v, solve=stuck)["solve"].points == 0
