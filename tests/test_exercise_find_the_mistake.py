"""A Jacobian with one mistake: one right name, and a repair that is not the printed matrix."""

import re
from collections import Counter
from itertools import combinations

import numpy as np
import pytest
from answers import EXERCISES, right_raws, variant_of
from kinegrade.course.sheet.given import printed
from kinegrade.exercises.arm import arm_of
from kinegrade.exercises.arms.twisted import FORMS, KINDS, robot
from kinegrade.exercises.calculations.columns import right
from kinegrade.exercises.catalogue.find_the_mistake import OPTIONS, SLIPS
from kinegrade.exercises.catalogue.find_the_mistake import slip_of as slip_of_arm
from kinegrade.exercises.exercise import references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.jacobian import jacobian

EXERCISE = EXERCISES["find_the_mistake"]
SEEDS = range(40)


def transforms(v):
    return arm_of(robot(v["form"]), v).frames


def slip_of(v):
    return slip_of_arm(arm_of(robot(v["form"]), v), np.array(v["W"]))


def variant_with(slip):
    return next(
        v
        for v in (variant_of("find_the_mistake", seed) for seed in range(200))
        if slip_of(v) == slip
    )


def verdicts(v, J=None, letter=None):
    own = {} if J is None else {"find_the_mistake_J": Raw("num", np.array(J))}
    own |= {} if letter is None else {"find_the_mistake_name": Raw("text", letter)}
    return mark(EXERCISE, v, right_raws(EXERCISE, v) | own)


def frames_from_the_text(v):
    """T_0^0 ... T_0^4 from the printed table and numbers alone."""
    values = {"0": 0.0, r"\pi/2": np.pi / 2, r"-\pi/2": -np.pi / 2}
    values |= {
        f"{name[0]}_{name[1]}": v[name] for name in EXERCISE.units if isinstance(v.get(name), float)
    }
    values |= {f"q_{i}": x for i, x in enumerate(v["q"], 1)}
    T = [np.eye(4)]
    for row in re.findall(
        r"\| \$\d\$ \| \$(.*?)\$ \| \$(.*?)\$ \| \$(.*?)\$ \| \$(.*?)\$ \|", EXERCISE.statement(v)
    ):
        theta, d, a, alpha = (values[cell] for cell in row)
        c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
        T.append(
            T[-1]
            @ [
                [c, -s * ca, s * sa, a * c],
                [s, c * ca, -c * sa, a * s],
                [0, sa, ca, d],
                [0, 0, 0, 1],
            ]
        )
    return T


@pytest.mark.parametrize("seed", SEEDS)
def test_the_sheet_alone_is_enough(seed):
    """J by differences of the frames that the printed table gives; the mistake by what each option says."""
    v = variant_of("find_the_mistake", seed)
    T, tip, h = frames_from_the_text(v), frames_from_the_text(v)[-1][:3, 3], 1e-6
    J = np.zeros((6, 4))
    for i in range(4):
        q = [x + h * (i == j) for j, x in enumerate(v["q"])]
        J[:3, i] = (frames_from_the_text({**v, "q": q})[-1][:3, 3] - tip) / h
        J[3:, i] = T[i][:3, 2] * (i != 2)
    z, o = [t[:3, 2] for t in T], [t[:3, 3] for t in T]
    R = T[-1][:3, :3]

    def matrix(linear, angular):
        return np.array([[*linear(i), *angular(i)] for i in range(4)]).T

    def axis(i):
        return z[i] * (i != 2)

    wrong = {
        "a": matrix(
            lambda i: z[3] if i == 2 else np.cross(z[i + 1], tip - o[i]),
            lambda i: z[i + 1] * (i != 2),
        ),
        "b": matrix(lambda i: z[2] if i == 2 else np.cross(z[i], o[i + 1] - o[i]), axis),
        "c": matrix(lambda i: z[2] if i == 2 else np.cross(z[i], tip), axis),
        "d": matrix(lambda i: z[2] if i == 2 else np.cross(tip - o[i], z[i]), axis),
        "e": matrix(lambda i: np.cross(z[i], tip - o[i]), lambda i: z[i]),
        "f": np.concatenate([J[:3], np.array(z[:4]).T]),
        "g": np.concatenate([J[3:], J[:3]]),
        "h": np.concatenate([R.T @ J[:3], R.T @ J[3:]]),
    }
    fitting = [letter for letter, matrix in wrong.items() if np.abs(matrix - v["W"]).max() < 1e-3]
    assert fitting == [references(EXERCISE, v)["find_the_mistake_name"]]
    assert [x.status for x in verdicts(v, np.round(J, 3), fitting[0])] == ["correct", "correct"]
    np.testing.assert_allclose(
        jacobian(robot(v["form"]).chain(only_lengths(v)), v["q"]), J, atol=1e-5
    )


def only_lengths(v):
    return {name: v[name] for name in robot(v["form"]).parameters}


@pytest.mark.parametrize("seed", SEEDS)
def test_no_two_mistakes_look_alike(seed):
    v = variant_of("find_the_mistake", seed)
    T = transforms(v)
    matrices = [right(T, KINDS), *(slip.columns(T, KINDS) for slip in SLIPS)]
    assert min(np.abs(a - b).max() for a, b in combinations(matrices, 2)) >= 0.05


def test_letters_and_forms_vary_over_students():
    drawn = [variant_of("find_the_mistake", seed) for seed in range(200)]
    letters = Counter(references(EXERCISE, v)["find_the_mistake_name"] for v in drawn)
    assert set(letters) == set("abcdefgh")
    assert max(letters.values()) < 50
    assert len({v["form"] for v in drawn}) > 0.9 * len(FORMS)


def test_the_students_file_does_not_hold_the_name_of_the_mistake():
    v = variant_of("find_the_mistake")
    assert set(printed(EXERCISE, v)) <= {*EXERCISE.units, "form"}


def test_naming_alone_earns_at_most_thirty_percent():
    name, repair = EXERCISE.parts
    assert name.points <= 0.3 * EXERCISE.points
    assert len(name.answer.options) == len(OPTIONS) == len(SLIPS) >= 5
    assert repair.points == EXERCISE.points - name.points


@pytest.mark.parametrize("slip", range(len(SLIPS)))
def test_the_printed_matrix_is_no_repair_whole_or_touched_up(slip):
    v = variant_with(slip)
    W = np.array(v["W"])
    assert (verdicts(v, W)[1].points, verdicts(v, W)[1].reading) == (
        0,
        "This is the printed matrix as it was.",
    )
    touched = W.copy()
    touched[0, 0] += 0.1
    assert verdicts(v, touched)[1].points == 0


@pytest.mark.parametrize("slip", range(len(SLIPS)))
def test_only_columns_that_were_wrong_carry_points_and_broken_ones_cost(slip):
    v = variant_with(slip)
    J, W = references(EXERCISE, v)["find_the_mistake_J"], np.array(v["W"])
    spoiled = (np.abs(W - J) > 3e-3).any(axis=0)
    first = int(np.flatnonzero(spoiled)[0])
    one = np.where(np.arange(4) == first, J, W)
    assert verdicts(v, one)[1].points == pytest.approx(7 / spoiled.sum(), abs=0.01)
    if not spoiled.all():
        broken = one + 0.1 * ~spoiled
        assert verdicts(v, broken)[1].points < verdicts(v, one)[1].points


@pytest.mark.parametrize("slip", range(len(SLIPS)))
def test_another_mistake_in_the_repair_is_named(slip):
    v = variant_with((slip + 1) % len(SLIPS))
    found = verdicts(v, SLIPS[slip].columns(transforms(v), KINDS))[1]
    assert found.status != "correct"
    assert SLIPS[slip].sentence in found.reading
