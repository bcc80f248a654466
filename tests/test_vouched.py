"""What follows in letters keeps all where own numbers follow from the same named mistake."""

import numpy as np
import pytest
from answers import EXERCISES, raws_of, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.table import read_table

RRT = EXERCISES["rrt"]
LETTERS = ("rrt_J_symbolic", "rrt_det", "rrt_singular")


def with_table(v, change):
    """Answers of somebody who goes on rightly from a table with other cells."""
    right = references(RRT, v)
    rows = [[str(cell) for cell in row] for row in right["rrt_dh"].rows]
    change(rows)
    names = sorted({name for row in right["rrt_dh"].rows for cell in row for name in cell.names})
    given = {"rrt_dh": read_table(rows, names)}
    for part in RRT.parts[1:]:
        given[part.variable] = part.solve(v, given)
    return given


def other_alpha(rows):
    rows[0][3] = f"-({rows[0][3]})"


def two_wrong_cells(rows):
    other_alpha(rows)
    rows[0][1] = "0.123"


def marked(v, answers):
    return {verdict.part: verdict for verdict in mark(RRT, v, raws_of(RRT, v, answers))}


@pytest.mark.parametrize("seed", range(3))
def test_the_sign_of_one_alpha_costs_no_more_than_its_price(seed):
    v = variant_of("rrt", seed)
    verdicts = marked(v, with_table(v, other_alpha))
    lost = sum(verdict.out_of - verdict.points for verdict in verdicts.values())
    assert 0 < lost <= 0.25 * verdicts["rrt_dh"].out_of
    assert verdicts["rrt_J_symbolic"].status == "follows"


def without_numbers(v, answers):
    return {name: answers[name] for name in ("rrt_dh", *LETTERS)}


def with_made_up_numbers(v, answers):
    rng = np.random.default_rng(0)
    made = {"rrt_T": rng.uniform(-1, 1, (3, 4, 4)), "rrt_J": rng.uniform(-1, 1, (6, 3))}
    return answers | made


@pytest.mark.parametrize("handed", [without_numbers, with_made_up_numbers])
def test_letters_without_own_numbers_are_worth_half(handed):
    v = variant_of("rrt", 0)
    answers = handed(v, with_table(v, other_alpha))
    verdicts = marked(v, answers)
    right_entries = 0.75  # what a wrong but named formula sheet earns at most
    assert verdicts["rrt_J_symbolic"].status == "partly"
    assert verdicts["rrt_J_symbolic"].points <= right_entries * verdicts["rrt_J_symbolic"].out_of
    assert verdicts["rrt_det"].points == 0.5 * verdicts["rrt_det"].out_of


def test_a_mistake_without_a_name_is_not_vouched_for():
    v = variant_of("rrt", 0)
    verdicts = marked(v, with_table(v, two_wrong_cells))
    assert verdicts["rrt_J"].status == "follows"
    assert verdicts["rrt_J_symbolic"].status == "partly"
