"""A function for every arm: the reference against the engine, as printed code, by file, and wrong in known ways."""

import json

import numpy as np
import pytest
from answers import EXERCISES, answer_code, right_raws, variant_of
from kinegrade.course.sheet.given import given_cell, printed
from kinegrade.course.sheet.submissions import Submission
from kinegrade.exercises.catalogue.implement_it import GROUPS, PUBLISHED, published
from kinegrade.exercises.catalogue.implement_it import reference as jacobian
from kinegrade.exercises.exercise import references
from kinegrade.grader.collecting.ask import Limits
from kinegrade.grader.kinds.markers import handed_in
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.chain import from_standard
from kinegrade.solutions.jacobian import jacobian as jacobian_of_chain

EXERCISE = EXERCISES["implement_it"]
PART = EXERCISE.parts[0]
NAME = PART.variable


def robots(v):
    return [robot for group in GROUPS for robot in v[group]]


def verdict_of(v, raw):
    return mark(EXERCISE, v, right_raws(EXERCISE, v) | {NAME: raw})[0]


def by_function(v, function):
    return verdict_of(v, handed_in(PART.answer, function, v))


def text_of(verdict):
    return " ".join(finding.text for finding in verdict.findings)


@pytest.mark.parametrize("seed", range(10))
def test_the_reference_is_the_engines_jacobian_and_that_of_differences(seed):
    for dh, kinds, q in robots(variant_of("implement_it", seed)):
        chain, h = from_standard(dh, kinds), 1e-6
        J = jacobian(np.array(dh), kinds, np.array(q))
        np.testing.assert_allclose(J, jacobian_of_chain(chain, q), atol=1e-12)
        tips = [
            [tip(dh, kinds, np.add(q, sign * step)) for step in h * np.eye(len(q))]
            for sign in (1, -1)
        ]
        np.testing.assert_allclose(J[:3], np.subtract(*tips).T / (2 * h), atol=1e-8)


def tip(dh, kinds, q):
    T = np.eye(4)
    for (theta, d, a, alpha), kind, x in zip(dh, kinds, q, strict=True):
        for angle, slide, turn in ((theta, d, np.array([[0, -1], [1, 0]])),):
            c, s = np.cos(angle + x * (kind == "R")), np.sin(angle + x * (kind == "R"))
            Z, X = np.eye(4), np.eye(4)
            Z[:2, :2], Z[2, 3] = c * np.eye(2) + s * turn, slide + x * (kind == "P")
            X[1:3, 1:3], X[0, 3] = np.cos(alpha) * np.eye(2) + np.sin(alpha) * turn, a
            T = T @ Z @ X
    return T[:3, 3]


def test_the_hidden_robots_are_of_the_announced_kinds_and_stay_hidden():
    v = variant_of("implement_it")
    assert {group: {kinds for _, kinds, _ in v[group]} for group in GROUPS} == {
        group: set(patterns) for group, patterns in GROUPS.items()
    }
    assert all(np.allclose(np.array(dh)[:, 3], 0) for dh, _, _ in v["planar"])
    assert all("P" in kinds for _, kinds, _ in v["prismatic"])
    assert not set(printed(EXERCISE, v)) & set(GROUPS)


def test_the_printed_solution_runs_with_nothing_but_numpy():
    v = variant_of("implement_it", 1)
    names = {"np": np}
    exec(answer_code(PART, references(EXERCISE, v)[NAME]), names)  # noqa: S102 - our own text
    assert by_function(v, names[NAME]).status == "correct"


def test_the_published_robots_are_given_with_their_numbers():
    v = variant_of("implement_it", 2)
    names = {"np": np}
    exec(given_cell(EXERCISE, v), names)  # noqa: S102 - our own text
    for i, (kinds, ((dh, also, q),)) in enumerate(
        zip(PUBLISHED, published(v).values(), strict=True), 1
    ):
        assert kinds == also
        assert f"robot {i} `{kinds}`" in EXERCISE.statement(v)
        np.testing.assert_array_equal(names[f"implement_it_dh_{i}"], dh)
        np.testing.assert_array_equal(names[f"implement_it_joints_{i}"], q)


@pytest.mark.parametrize(("wrong", "points"), [((), 8), ((1,), 5.33), ((0, 2), 2.67)])
def test_a_file_of_results_for_the_published_robots_is_marked_robot_by_robot(
    tmp_path, wrong, points
):
    v = variant_of("implement_it", 3)
    results = [jacobian(*call[0]) for call in published(v).values()]
    data = {NAME: [(-J if i in wrong else J).tolist() for i, J in enumerate(results)]}
    submission = Submission(tmp_path / "sheet.json", json.dumps(data).encode())
    raws = submission.raws(submission.asks(EXERCISE, v), Limits())
    found = verdict_of(v, raws[NAME])
    assert found.points == points
    assert all(f"robot {i + 1}: 0 of 1 right" in text_of(found) for i in wrong)


def test_a_function_that_knows_no_prismatic_joint_keeps_the_other_groups():
    v = variant_of("implement_it")
    found = by_function(v, lambda dh, kinds, q: jacobian(dh, "R" * len(kinds), q))
    assert (found.status, found.points) == ("partly", 6)
    assert "prismatic: 0 of 4 right" in text_of(found)
    assert "7R: 3 of 3 right" in text_of(found)


def test_a_function_for_planar_arms_alone_keeps_its_group():
    def flat(dh, _, q):
        angles = np.cumsum(np.array(dh)[:, 0] + q)
        steps = np.array(dh)[:, 2] * np.array([np.cos(angles), np.sin(angles)])
        x, y = np.cumsum(steps[:, ::-1], axis=1)[:, ::-1]
        zero = np.zeros_like(x)
        return np.array([-y, x, zero, zero, zero, zero + 1])

    found = by_function(variant_of("implement_it"), flat)
    assert (found.status, found.points) == ("partly", 2)


@pytest.mark.parametrize("number", range(len(PART.mistakes)))
@pytest.mark.parametrize("seed", range(3))
def test_a_known_mistake_is_named(number, seed):
    v = variant_of("implement_it", seed)
    mistake = PART.mistakes[number]
    found = by_function(v, mistake.solve(v, {}))
    assert mistake.sentence in text_of(found)
    assert found.points <= 6


def test_the_same_matrix_for_every_arm_earns_nothing():
    v = variant_of("implement_it")
    for constant in (np.zeros, np.ones):
        assert by_function(v, lambda _, kinds, __, fill=constant: fill((6, len(kinds)))).points == 0
    assert by_function(v, lambda *_: np.eye(6)).points == 0
