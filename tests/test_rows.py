"""The order of rows is the exercise's: its sheet, its script and what is found in an answer follow it."""

import json

import numpy as np
import pytest
from courses import exercise_of
from kinegrade.course.proof.validate import validate_file
from kinegrade.course.settings.config import Sheet, Student
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.matlab import starter
from kinegrade.course.sheet.notebook import notebooks
from kinegrade.exercises.exercise import Formulas, Numbers, Part
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS

SWAP = [3, 4, 5, 0, 1, 2]
ORDERS = ("linear, angular", "angular, linear")
UNITS = {
    "linear, angular": [["m/rad", "m/rad", "1", "m/rad"]] * 3 + [["1"] * 4] * 3,
    "angular, linear": [["1"] * 4] * 3 + [["m/rad", "m/rad", "1", "m/rad"]] * 3,
}
SAYS = {
    "linear, angular": "the linear rows stand above the angular ones",
    "angular, linear": "the angular rows stand above the linear ones",
}
ADA = Student("ada", "Ada Lovelace")


def space_jacobian(v, _):
    """Of a SCARA arm about the base origin, linear rows above angular ones."""
    chain = ROBOTS["scara"].chain({name: v[name] for name in ("a1", "a2", "d4")})
    return jacobian(chain, v["q"], point="origin")


def drawn(rng):
    lengths = {name: round(float(rng.uniform(0.2, 0.8)), 3) for name in ("a1", "a2", "d4")}
    return lengths | {"q": [round(float(x), 3) for x in rng.uniform(0.3, 1.2, 4)]}


def screw(rows):
    """An exercise that asks for a Jacobian in that order of rows."""
    order = SWAP if rows == "angular, linear" else [*range(6)]
    part = Part(
        "t_J",
        "J?",
        8,
        Numbers((6, 4), UNITS[rows]),
        lambda v, given: space_jacobian(v, given)[order],
    )
    units = {**dict.fromkeys(("a1", "a2", "d4"), "m"), "q": ["rad", "rad", "m", "rad"]}
    return exercise_of(part, draw=drawn, units=units, rows=rows)


def variant(seed=1):
    return json.loads(json.dumps(drawn(np.random.default_rng(seed))))


def markdown(*exercises):
    """Texts of a sheet of these exercises."""
    pairs = [Assignment(exercise, variant()) for exercise in exercises]
    sheet = Sheet(name="one", title="Sheet", exercises=("t",))
    cells = json.loads(notebooks("Tests", sheet, ADA, pairs)[0])["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]


@pytest.mark.parametrize("rows", ORDERS)
def test_the_sheet_says_the_order_of_its_exercises(rows):
    heading, *others = markdown(screw(rows), screw(rows))
    assert (
        f"Units are metres, radians and seconds. In every Jacobian and twist {SAYS[rows]}. Round only"
        in heading
    )
    assert [text for text in others if "stand above" in text] == []


def test_where_exercises_differ_each_says_its_own_order():
    heading, *others = markdown(*map(screw, ORDERS))
    assert "stand above" not in heading
    assert "radians and seconds. Round only what you hand in" in heading
    said = [text for text in others if "stand above" in text]
    for text, rows, number in zip(said, ORDERS, (1, 2), strict=True):
        assert text.startswith(f"## {number}. ")
        assert f"In the Jacobians and twists of this exercise {SAYS[rows]}." in text


@pytest.mark.parametrize("rows", ORDERS)
def test_the_script_says_the_order_of_its_exercise(rows):
    sheet = Sheet(name="one", title="Sheet", exercises=("t",), matlab=True)
    first, second = rows.split(", ")
    text = starter("Course", sheet, ADA, [Assignment(screw(rows), variant())])
    assert f"t_J = [];  % 6 x 4 numbers, {first} rows above {second}; 4 decimals" in text


@pytest.mark.parametrize("rows", ORDERS)
def test_the_other_order_is_named_and_costs_a_quarter(rows):
    exercise, v = screw(rows), variant()
    order = SWAP if rows == "angular, linear" else [*range(6)]
    right = space_jacobian(v, {})[order]
    (found,) = mark(exercise, v, {"t_J": Raw("num", right)})
    assert (found.status, found.points) == ("correct", 8)
    (found,) = mark(exercise, v, {"t_J": Raw("num", right[SWAP])})
    first, second = rows.split(", ")
    assert (found.status, found.points) == ("partly", 0.75 * found.out_of)
    assert [finding.text for finding in found.findings] == [
        f"The {second} rows seem to stand above the {first} ones; {first} rows come first."
    ]


@pytest.mark.parametrize("rows", ORDERS)
def test_formulas_in_the_other_order_are_named_too(rows):
    entries = ["l1*cos(q1)", "l1*sin(q1)", "0", "q1", "0", "1"]
    part = Part("t_J", "J?", 6, Formulas((6,), ("l1", "q1")), lambda *_: entries)
    exercise = exercise_of(
        part, draw=lambda rng: {"l1": float(rng.uniform(0.2, 0.8)), "q": [0.4]}, units={}, rows=rows
    )
    (found,) = mark(
        exercise, {"l1": 0.5, "q": [0.4]}, {"t_J": Raw("text", entries[3:] + entries[:3])}
    )
    first, second = rows.split(", ")
    assert f"The {second} rows seem to stand above the {first} ones" in found.findings[0].text


def test_six_rates_have_no_rows_to_be_swapped():
    part = Part("t_q", "q?", 6, Numbers((6,), "rad/s"), lambda v, _: v["x"] * np.arange(1.0, 7.0))
    (found,) = mark(
        exercise_of(part), {"x": 0.5}, {"t_q": Raw("num", 0.5 * np.array([4, 5, 6, 1, 2, 3.0]))}
    )
    assert [finding.text for finding in found.findings if "rows" in finding.text] == []


SCREW = '''
"""A Jacobian with angular rows first."""
import numpy as np
from kinegrade.exercises.draws import angles, length
from kinegrade.exercises.exercise import Exercise, Numbers, Part
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS


def J(v, given):
    lengths = {name: v[name] for name in ("a1", "a2", "d4")}
    return jacobian(ROBOTS["scara"].chain(lengths), v["q"], point="origin")[[3, 4, 5, 0, 1, 2]]


EXERCISE = Exercise(
    slug="screw", title="Screws", source="made for tests", rows="angular, linear", statement=lambda v: "A SCARA arm.",
    draw=lambda rng: {"a1": length(rng), "a2": length(rng), "d4": length(rng),
                      "q": [*angles(rng, 2, [(0, 1)]), length(rng), *angles(rng, 1)]},
    units={"a1": "m", "a2": "m", "d4": "m", "q": ["rad", "rad", "m", "rad"]}, scale=lambda v: v["a1"] + v["a2"],
    parts=(Part("screw_J", "The space Jacobian", 3,
                Numbers((6, 4), [["1"] * 4] * 3 + [["m/rad", "m/rad", "1", "m/rad"]] * 3, 3), J, credit="block"),),
)
'''


def test_an_exercise_with_angular_rows_first_is_valid(tmp_path):
    path = tmp_path / "screw.py"
    path.write_text(SCREW, encoding="utf-8")
    assert validate_file(path, 8).failures == ()
