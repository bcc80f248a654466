"""A table that describes the drawn arm is right; one with a single wrong cell is told which."""

import numpy as np
import pytest
from answers import EXERCISES, part_of, raws, variant_of
from kinegrade.exercises.answers import TableOf
from kinegrade.exercises.exercise import references
from kinegrade.grader.kinds.repairs import repairs
from kinegrade.grader.kinds.same_arm import describes_same_arm
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.table import read_table

RRT = EXERCISES["rrt"]
DH = part_of(RRT, "rrt_dh")
NAMES = ("d1", "a1", "d2", "l3", "q1", "q2", "q3")
V = {"d1": 0.5, "a1": 0.3, "d2": 0.2, "q": [0.4, 0.7, 0.6]}
ROWS = [["q1", "d1", "a1", "-pi/2"], ["q2", "d2", "0", "pi/2"], ["0", "q3", "0", "0"]]
ANSWER = TableOf(("d1", "a1", "d2"), "RRP")


def table(rows):
    return read_table(rows, NAMES)


def edited(**cells):
    """The table with cells such as alpha1="pi/2" in place of its own."""
    rows = [list(row) for row in ROWS]
    for place, cell in cells.items():
        column = ("theta", "d", "a", "alpha").index(place[:-1])
        rows[int(place[-1]) - 1][column] = cell
    return rows


SAME = [
    ROWS,
    edited(theta1="q1 + pi", a1="-a1", alpha1="pi/2", theta2="q2 + pi", alpha2="-pi/2", d2="-d2")
    and edited(theta1="q1 + 2*pi"),
    edited(alpha1="3*pi/2"),
    edited(theta2="q2 + pi", alpha2="-pi/2", theta3="pi"),
    edited(theta2="q2 - pi", alpha2="-pi/2", theta3="-pi"),
]


def sentences(wanted, own, v=V):
    return [named.sentence for named in repairs(ANSWER, v, wanted, own)]


@pytest.mark.parametrize("rows", SAME, ids=str)
def test_frames_placed_otherwise_are_right(rows):
    assert describes_same_arm(ANSWER, V, table(ROWS), table(rows))


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        (edited(alpha1="pi/2"), "Row 1: alpha has the wrong sign."),
        (edited(alpha2="-pi/2"), "Row 2: alpha has the wrong sign."),
        (edited(alpha1="pi/2", alpha2="-pi/2"), "All angles alpha have the wrong sign."),
        (edited(alpha1="0"), "Row 1: alpha is a quarter turn off."),
        (edited(alpha1="-90"), "Row 1: alpha is in degrees; radians are asked."),
        (edited(alpha1="-90", alpha2="90"), "The angles alpha are in degrees; radians are asked."),
        (edited(theta2="q2 + pi/2"), "Row 2: theta is a quarter turn off."),
        (edited(theta2="q2 + pi"), "Row 2: theta is half a turn off."),
        (edited(a1="-a1"), "Row 1: a has the wrong sign."),
        (edited(d2="-d2"), "Row 2: d has the wrong sign."),
        (edited(d1="a1", a1="d1"), "Row 1: a and d are exchanged."),
    ],
    ids=str,
)
def test_one_wrong_cell_has_a_name(rows, sentence):
    wanted, own = table(ROWS), table(rows)
    assert not describes_same_arm(ANSWER, V, wanted, own)
    assert sentence in sentences(wanted, own)


def test_the_modified_table_is_named():
    """Standard rows of a modified table: a and alpha belong to the link before the joint."""
    modified = [["q1", "d1", "0", "0"], ["q2", "d2", "a1", "-pi/2"], ["0", "q3", "0", "pi/2"]]
    found = sentences(table(ROWS), table(modified))
    assert found == ["This is the modified table of the arm; the standard one is asked."]


def test_a_joint_variable_in_the_other_column_is_named():
    rows = [*ROWS[:2], ["q3", "0", "0", "0"]]
    found = sentences(table(ROWS), table(rows))
    assert found == ["Row 3: joint 3 slides: q3 belongs in d."]


def test_two_wrong_cells_have_no_name():
    assert repairs(ANSWER, V, table(ROWS), table(edited(d1="0.9", a1="0.1"))) == []


@pytest.mark.parametrize("seed", range(6))
def test_a_table_of_the_same_arm_earns_all_and_so_do_the_parts_in_its_frames(seed):
    v = variant_of("rrt", seed)
    right = references(RRT, v)
    theta, d, a, alpha = (str(cell) for cell in right["rrt_dh"].rows[1])
    rows = [[*map(str, row)] for row in right["rrt_dh"].rows]
    rows[1] = [f"{theta} + pi", d, a, f"-({alpha})"]
    rows[2][0] = "pi"
    own = table(rows)
    answers = {**right, "rrt_dh": own}
    answers["rrt_T"] = part_of(RRT, "rrt_T").solve(v, {"rrt_dh": own})
    assert np.abs(answers["rrt_T"] - right["rrt_T"]).max() > 0.1
    verdicts = {verdict.part: verdict for verdict in mark(RRT, v, raws(answers))}
    assert verdicts["rrt_dh"].status == "correct"
    assert "stand otherwise" in verdicts["rrt_dh"].reading
    assert {verdict.points == verdict.out_of for verdict in verdicts.values()} == {True}


@pytest.mark.parametrize("seed", range(3))
def test_a_sentence_tells_no_value(seed):
    v = variant_of("rrt", seed)
    wanted = references(RRT, v)["rrt_dh"]
    rows = [[str(cell) for cell in row] for row in wanted.rows]
    rows[0][3] = f"-({rows[0][3]})"
    found = [named.sentence for named in repairs(DH.answer, v, wanted, table(rows))]
    assert found
    for said in found:
        assert "pi" not in said
        assert not any(str(v[name]) in said for name in NAMES if name in v)
