"""Every kind of answer from raw value to verdict: what is right in any wording, what is named, what earns nothing."""

import numpy as np
import pytest
from courses import exercise_of
from kinegrade.exercises.exercise import (
    Choice,
    Configurations,
    ExerciseError,
    Formulas,
    Function,
    Manual,
    Mistake,
    Numbers,
    Outcome,
    Part,
    references,
)
from kinegrade.exercises.properties import list_share
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from sympy import Abs, Symbol, sin

V = {"l1": 0.8, "l2": 0.5, "q": [0.4, 0.9]}
NAMES = ("l1", "l2", "q1", "q2")
J = [
    ["-l1*sin(q1) - l2*sin(q1 + q2)", "-l2*sin(q1 + q2)"],
    ["l1*cos(q1) + l2*cos(q1 + q2)", "l2*cos(q1 + q2)"],
    ["1", "1"],
]


def verdict(part, raw, v=V):
    exercise = exercise_of(part, draw=lambda rng: {**V, "l1": float(rng.uniform(0.4, 1.2))})
    raw = (
        raw
        if isinstance(raw, Raw)
        else Raw("text", raw)
        if isinstance(raw, str | list)
        else Raw("num", raw)
    )
    (found,) = mark(exercise, v, {part.variable: raw})
    return found


def said(found):
    return " ".join([found.reading, *(finding.text for finding in found.findings)])


def formulas(shape=(3, 2), reference=J, **more):
    return Part("t_x", "x?", 4, Formulas(shape, NAMES), lambda *_: reference, **more)


@pytest.mark.parametrize(
    "text",
    [
        J,
        [["-l1*s1 - l2*s12", "-l2*s12"], ["l1*c1 + l2*c12", "l2*c12"], ["1", "1"]],
        [
            ["-(l1*s1 + l2*s12)", "-l2*sin(th1 + th2)"],
            ["c1*l1 + l2*c12", "l2*(c1*c2 - s1*s2)"],
            ["1", "s2^2 + c2^2"],
        ],
        "[[-l1*s1 - l2*s12, -l2*s12], [l1*c1 + l2*c12, l2*c12], [1, 1]]",
        "Matrix([[-l1*s1 - l2*sin(q1 + q2), -l2*sin(q1 + q2)], [l1*cos(q1) + l2*cos(q1 + q2), l2*c12], [1, 1]])",
        "[-l1*s1 - l2*s12, -l2*s12; l1*c1 + l2*c12, l2*c12; 1, 1]",
        [
            ["-L1*np.sin(θ₁) − L2·sin(θ1+θ2)", "-l_2*sin(q_1 + q_2)"],
            ["l1*c1 + l2*c12", "l2*c12"],
            ["1.0", "1"],
        ],
    ],
)
def test_formulas_are_right_in_any_wording(text):
    found = verdict(formulas(), text)
    assert (found.status, found.points) == ("correct", 4)


MANIPULABILITY = Abs(
    Symbol("l1", real=True) * Symbol("l2", real=True) * sin(Symbol("q2", real=True))
)


@pytest.mark.parametrize("reference", ["abs(l1*l2*sin(q2))", "Abs(l1*l2*sin(q2))", MANIPULABILITY])
@pytest.mark.parametrize(
    ("text", "points"),
    [
        ("abs(l1*l2*sin(q2))", 4),
        ("|l1*l2*s2|", 4),
        ("l1*l2*|sin(q2)|", 4),
        ("l1*l2*Abs(sin(q2))", 4),
        ("np.abs(-l1*l2*s2)", 4),
        ("sqrt(sin(q2)^2)*l1*l2", 4),
        ("l1*l2*sin(q2)", 0),
        ("-l1*l2*sin(q2)", 0),
        ("l1*l2*|sin(q1)|", 0),
        ("|l1|*|l2|*|q2|", 0),
    ],
)
def test_a_manipulability_is_a_formula_with_an_absolute_value(reference, text, points):
    assert verdict(formulas((), reference), text).points == points


def test_a_bar_that_may_open_or_close_is_shown_with_a_caret():
    found = verdict(formulas((), "abs(q1)"), "||q1||")
    assert found.status == "failed"
    assert "This bar may open or close: write abs(...).\n||q1||\n ^" in said(found)


@pytest.mark.parametrize(
    ("change", "points", "words"),
    [
        ({(0, 0): "l1*s1 + l2*s12"}, 3, "Only a sign is wrong: row 1, column 1"),
        ({(0, 1): "-l2*s2"}, 3, ""),
        ({(2, 1): "0"}, 2, ""),  # a wrong constant voids its column
    ],
)
def test_a_wrong_formula_costs_its_entry(change, points, words):
    rows = [list(row) for row in J]
    for (i, j), text in change.items():
        rows[i][j] = text
    found = verdict(formulas(), rows)
    assert (found.status, found.points) == ("partly", points)
    assert words in said(found)


def test_formulas_with_the_own_numbers_put_in_are_named_and_earn_nothing_for_it():
    numbers = [["-0.8*s1 - 0.5*s12", "-0.5*s12"], ["0.8*c1 + 0.5*c12", "0.5*c12"], ["1", "1"]]
    found = verdict(formulas(), numbers)
    assert found.points == 0
    assert (
        "With your numbers put in it is right, but formulas are asked: they take l1, l2."
        in said(found)
    )
    values = np.array([[-0.794, -0.482], [0.871, 0.134], [1, 1]])
    assert "they take l1, l2, q1, q2" in said(verdict(formulas(), values))


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        ([["-l1*s1", "-l2*s12"]], "takes shape (3, 2), got (1, 2)"),
        ([["a", "b"], ["c"]], "rows of different lengths"),
        ([["l1*s1 +", "0"], ["0", "0"], ["0", "0"]], "row 1, column 1: "),
        (
            [["l1 s1", "0"], ["0", "0"], ["0", "0"]],
            "row 1, column 1: a sign such as * is missing before 's1'",
        ),
        ("eval('1')", "has no meaning"),
        (Raw("num", np.full((3, 2), np.nan)), "not finite"),
    ],
)
def test_formulas_that_cannot_be_read_say_where(raw, words):
    found = verdict(formulas(), raw)
    assert (found.status, found.points) == ("failed", 0)
    assert words.lower() in said(found).lower()


def test_a_typed_formula_that_cannot_be_read_is_shown_with_a_caret():
    found = verdict(formulas((), "l1*cos(q1)"), "l1*cos(q1) l2")
    assert found.findings[0].text.splitlines()[1:] == ["l1*cos(q1) l2", "           ^"]


def test_a_transposed_matrix_of_formulas_is_named():
    square = formulas((2, 2), J[:2])
    found = verdict(square, [list(column) for column in zip(*J[:2], strict=True)])
    assert found.points == 0.75 * found.out_of
    assert "transposed" in said(found)


def test_a_known_mistake_in_formulas_is_named():
    absolute = [
        ["-l1*sin(q1) - l2*sin(q2)", "-l2*sin(q2)"],
        ["l1*cos(q1) + l2*cos(q2)", "l2*cos(q2)"],
        ["1", "1"],
    ]
    part = formulas(
        mistakes=(Mistake("The second angle is measured from link 1.", lambda *_: absolute),)
    )
    found = verdict(part, [["-l1*s1 - l2*s2", "-l2*s2"], ["l1*c1 + l2*c2", "l2*c2"], ["1", "1"]])
    assert "The second angle is measured from link 1." in said(found)


def test_a_name_that_the_variant_lacks_is_unknown():
    part = Part("t_x", "x?", 1, Formulas((), ("l1", "l9", "q1")), lambda *_: "l1")
    assert "l9" in said(verdict(part, "l1 + l9"))


CHOICE = Part("t_x", "x?", 2, Choice(("red", "green", "blue")), lambda *_: "b")


@pytest.mark.parametrize(
    "text", ["b", "B", "(b)", " b) ", "green", "b) green", "Green", ["b"], [["b"]], "b\u200b"]
)
def test_a_choice_is_its_letter_or_its_text(text):
    assert verdict(CHOICE, text).points == 2


@pytest.mark.parametrize("text", ["a", "c", "red"])
def test_another_choice_is_wrong(text):
    assert (verdict(CHOICE, text).status, verdict(CHOICE, text).points) == ("incorrect", 0)


@pytest.mark.parametrize("raw", ["d", "ab", "a or b", np.array(2.0), ["b", "c"]])
def test_what_is_no_choice_is_refused(raw):
    found = verdict(CHOICE, raw)
    assert found.status == "failed"
    assert "takes one of the letters a, b, c" in said(found).lower()


LENGTH = Part("t_x", "x?", 2, Numbers((), "m", decimals=3), lambda v, _: v["l1"] / 2)


@pytest.mark.parametrize("text", ["0.4", "0.4 m", "400 mm", "40cm", "2/5", "4e-1 m"])
def test_a_scalar_is_read_with_its_unit(text):
    assert verdict(LENGTH, text).points == 2


@pytest.mark.parametrize(
    ("raw", "status", "words"),
    [
        ("0.4 s", "failed", "takes a value in m, got 0.4 s"),
        ("0.4 rad", "failed", "takes a value in m, got 0.4 rad"),
        ("0,4", "failed", "point"),
        (np.array(400.0), "partly", "metres are asked, not millimetres"),
        (np.array(40.0), "partly", "metres are asked, not centimetres"),
        (np.array([0.4, 0.4]), "failed", "takes one number, got (2,)"),
    ],
)
def test_a_wrong_unit_is_named(raw, status, words):
    found = verdict(LENGTH, raw)
    assert (found.status, found.points) == (status, {"failed": 0, "partly": 1.5}[status])
    assert words.lower() in said(found).lower()


WRENCH = Part(
    "t_x", "x?", 6, Numbers((6,), ["N"] * 3 + ["N m"] * 3, decimals=2),
    lambda v, _: v["l1"] * np.array([12.5, 3.25, -8.1, 4.4, 19.6, -7.7]),
)  # fmt: skip
TORQUES = Part(
    "t_x", "x?", 2, Numbers((2,), "N m", decimals=2), lambda v, _: v["l1"] * np.array([12.5, -8.1])
)  # fmt: skip


@pytest.mark.parametrize(
    ("raw", "status", "words"),
    [
        (["10 N", "2.6 N", "-0.00648 kN", "3.52 Nm", "15.68 N*m", "-6160 N mm"], "correct", ""),
        (
            ["10 N m", "2.6", "-6.48", "3.52", "15.68", "-6.16"],
            "failed",
            "entry 1: takes a value in N, got 10 N m",
        ),
        (["10", "2.6", "-6.48", "3.52 J", "15.68", "-6.16"], "correct", ""),
        (
            ["10", "2.6", "-6.48", "3.52 m", "15.68", "-6.16"],
            "failed",
            "entry 4: takes a value in N m, got 3.52 m",
        ),
        (
            np.array([10, 2.6, -6.48, 3520, 15680, -6160]),
            "partly",
            "1000 times too large: N m are asked, not N mm",
        ),
    ],
)
def test_forces_and_moments_are_read_with_their_units(raw, status, words):
    found = verdict(WRENCH, raw)
    points = {"correct": 6, "failed": 0, "partly": 4.5}[status]
    assert (found.status, found.points) == (status, points)
    assert words.lower() in said(found).lower()


def test_a_torque_in_newton_millimetres_is_named_and_not_taken_for_a_length():
    value = 0.8 * np.array([12.5, -8.1])
    assert "Moments are 1000 times too large: N m are asked, not N mm." in said(
        verdict(TORQUES, 1000 * value)
    )
    assert "Moments are 100 times too large: N m are asked, not N cm." in said(
        verdict(TORQUES, 100 * value)
    )


@pytest.mark.parametrize(
    ("unit", "factor", "words"),
    [
        ("m/s", 1000, "Lengths are 1000 times too large"),
        ("m/s^2", 1000, "Lengths are 1000 times too large"),
        ("m/rad", 100, "Lengths are 100 times too large"),
        ("rad/s^2", 180 / np.pi, "Angles are in degrees"),
        ("N/m", 1000, ""),
        ("m^2", 1000, ""),
        ("kg", 1000, ""),
    ],
)
def test_other_units_are_named_where_they_stand_above_the_line(unit, factor, words):
    part = Part(
        "t_x", "x?", 2, Numbers((3,), unit), lambda v, _: v["l1"] * np.array([1.5, 2.5, 3.7])
    )
    found = said(verdict(part, factor * 0.8 * np.array([1.5, 2.5, 3.7])))
    assert words in found if words else not found


@pytest.mark.parametrize(
    ("unit", "typed"), [("mm", ["350 mm", "0.1 m"]), ("deg", ["20 deg", "pi/9 rad"])]
)
def test_a_typed_unit_is_brought_to_the_asked_one(unit, typed):
    values = {"mm": [350.0, 100.0], "deg": [20.0, 20.0]}[unit]
    part = Part("t_x", "x?", 2, Numbers((2,), unit, decimals=2), lambda *_: np.array(values))
    assert verdict(part, typed).status == "correct"


def test_degrees_are_named():
    angle = Part("t_x", "x?", 2, Numbers((2,), "rad", decimals=3), lambda v, _: np.array(v["q"]))
    assert "Angles are in degrees: radians are asked." in said(verdict(angle, np.degrees(V["q"])))
    assert verdict(angle, ["22.9183 deg", "0.9 rad"]).points == 2


def test_numbers_may_be_typed_as_formulas_without_names():
    part = Part(
        "t_x",
        "x?",
        2,
        Numbers((2, 2), decimals=3),
        lambda *_: np.array([[0.5, np.sqrt(3) / 2], [0, -2]]),
    )
    for typed in (
        [["1/2", "sqrt(3)/2"], ["0", "-2"]],
        "[[1/2, sqrt(3)/2], [0, -2]]",
        "[1/2, √3/2; 0, −2]",
    ):
        assert verdict(part, typed).points == 2


def elbows(_, __, value):
    right, share = list_share(value, [[-1.2], [np.pi - 1.2]], 1e-3)
    finding = "" if share == 1 else "Is there another one half a turn away?"
    return Outcome(right=right, share=share, finding=finding)


LISTED = Part("t_x", "x?", 4, Configurations(1), lambda *_: [[-1.2], [np.pi - 1.2]], check=elbows)


@pytest.mark.parametrize(
    ("raw", "points"),
    [
        (np.array([-1.2, np.pi - 1.2]), 4),
        (np.array([[np.pi - 1.2], [-1.2]]), 4),
        (np.array([-1.2, -np.pi - 1.2]), 4),
        (["-1.2", "pi - 1.2"], 4),
        (np.array([-1.2]), 2),
        (np.array([-1.2, 0.3]), 0),
        (np.array([-1.2, -1.2]), 2),
        (np.linspace(-3, 3, 32), 0),
    ],
)
def test_a_list_of_configurations_earns_what_it_hits_less_what_it_misses(raw, points):
    found = verdict(LISTED, raw)
    assert found.points == points
    assert ("half a turn away" in said(found)) == (points < 4)


@pytest.mark.parametrize("raw", [np.zeros((2, 2)), np.linspace(0, 1, 33), np.array([np.nan]), "x"])
def test_a_list_that_is_none_is_refused(raw):
    assert verdict(LISTED, raw).status == "failed"


def double(x):
    return 2 * np.asarray(x)


CALLS = {"small": [([1.0, 2.0],), ([0.5, 0.1],)], "large": [([100.0, 3.0],)]}
FUNCTION = Part(
    "t_x",
    "x?",
    4,
    Function("(x)", lambda _: CALLS, published=lambda _: {"yours": [([5.0, 6.0],)]}),
    lambda *_: double,
)


def results(*values, listed=False):
    raws = [x if isinstance(x, Raw) else Raw("num", np.asarray(x, dtype=float)) for x in values]
    return Raw("calls", raws, listed=listed)


@pytest.mark.parametrize(
    ("raw", "points", "words"),
    [
        (results([2, 4], [1, 0.2], [200, 6]), 4, ""),
        (
            results([2, 4], [1, 0.2], [200, 7]),
            2,
            "large: 0 of 1 right; the first that is not differs in 1 of 2 entries",
        ),
        (results([2, 4], [1, 0.3], [200, 6]), 2, "small: 1 of 2 right"),
        (
            results([2, 4], [1, 0.2], Raw("error", "stopped with IndexError: 3")),
            2,
            "gave: stopped with IndexError: 3",
        ),
        (results([[2, 4]], [1, 0.2], [200, 6]), 2, "has shape (1, 2), (2,) is asked"),
        (results([2, 4], [1, 0.2]), 2, "no result"),
        (results([2, 4], [1, np.nan], [200, 6]), 2, "NaN"),
        (results([10, 12], listed=True), 4, ""),
        (results([10, 13], listed=True), 0, "yours: 0 of 1 right"),
        (Raw("num", np.array([[10.0, 12.0]])), 4, ""),
    ],
)
def test_a_function_is_judged_group_by_group_on_its_results(raw, points, words):
    found = verdict(FUNCTION, raw)
    assert found.points == points
    assert words in said(found)


def test_text_in_place_of_a_function_is_refused():
    assert "Takes a function, def NAME(x), got text." in said(verdict(FUNCTION, "2*x"))


def test_what_is_marked_by_hand_waits():
    by_hand = Part("t_x", "x?", 2, Manual(((2, "all"),)), lambda *_: "key")
    on_paper = Part("t_x", "x?", 2, Manual(((2, "all"),), on_paper=True), lambda *_: "key")
    assert (verdict(by_hand, "because").status, verdict(by_hand, "because").answer) == (
        "not_graded",
        "because",
    )
    assert verdict(by_hand, Raw("missing")).status == "missing"
    assert verdict(on_paper, Raw("missing")).status == "not_graded"
    assert verdict(by_hand, np.zeros(3)).status == "failed"


@pytest.mark.parametrize(
    ("part", "words"),
    [
        (Part("t_x", "x?", 3, Manual(((2, "all"),)), lambda *_: ""), "has 3 points, its rubric 2"),
        (Part("t_x", "x?", 3, Configurations(2), lambda *_: [[0, 0]]), "take a check"),
    ],
)
def test_a_declaration_that_cannot_be_marked_is_refused(part, words):
    with pytest.raises(ExerciseError, match=words):
        exercise_of(part)


@pytest.mark.parametrize(
    ("answer", "value", "words"),
    [
        (Choice(("a", "b")), "c", "one of the letters a, b"),
        (Formulas((2,), ("q1",)), ["sin(q2)", "0"], "q2"),
        (Formulas((2,), ("q1",)), ["sin(q1)"], r"formulas of shape \(2,\)"),
        (Function("(x)", lambda _: CALLS), 3, "takes a function"),
        (Manual(((1, "x"),)), 3, "takes text"),
    ],
)
def test_a_reference_of_another_kind_is_refused(answer, value, words):
    with pytest.raises(ExerciseError, match=words):
        references(exercise_of(Part("t_x", "x?", 1, answer, lambda *_: value)), {})


def test_nothing_can_need_a_function():
    with pytest.raises(ExerciseError, match="nothing can be computed from it"):
        exercise_of(FUNCTION, Part("t_y", "y?", 1, Numbers(()), lambda *_: 1, needs=("t_x",)))


def test_numbers_follow_from_the_own_formulas():
    first = formulas()
    second = Part(
        "t_J", "J?", 4, Numbers((3, 2), decimals=3),
        lambda v, given: given["t_x"].at({"l1": v["l1"], "l2": v["l2"], "q1": v["q"][0], "q2": v["q"][1]}),
        needs=("t_x",),
    )  # fmt: skip
    exercise = exercise_of(
        first, second, draw=lambda rng: {**V, "l1": float(rng.uniform(0.4, 1.2))}
    )
    rows = [list(row) for row in J]
    rows[0][0] = "l1*sin(q1) + l2*sin(q1 + q2)"
    own = references(exercise, V)["t_J"] * [[-1, 1], [1, 1], [1, 1]]
    first_verdict, second_verdict = mark(
        exercise, V, {"t_x": Raw("text", rows), "t_J": Raw("num", own)}
    )
    assert (first_verdict.points, second_verdict.points) == (3, 4)
    assert "follows from your own t_x" in said(second_verdict)


def test_how_a_typed_number_was_read_is_said():
    assert verdict(LENGTH, "400 mm").reading == "Read as 0.4 m."
    assert verdict(LENGTH, np.array(0.4)).reading == ""


def test_a_rounded_angle_in_a_formula_is_named():
    part = formulas((2,), ["sin(q1 - pi/2)", "q1 + q2 + pi"])
    found = verdict(part, ["sin(q1 - 1.5708)", "q1 + q2 + pi"])
    assert found.points == 2
    assert found.reading == (
        "Read with 1.5708 as it stands; formulas take pi/2, not its rounded value."
    )
    assert verdict(part, ["sin(q1 - 90°)", "q1 + q2 + 3.141592653589793"]).points == 4
    assert verdict(part, ["-cos(q1)", "0.785*l1"]).reading == ""


@pytest.mark.parametrize("part", [CHOICE, LENGTH, formulas()])
def test_blank_text_is_no_answer(part):
    assert verdict(part, " \n").status == "missing"


@pytest.mark.parametrize("angle", [1e5, 1e17, 1e308])
def test_an_angle_too_large_for_whole_turns_is_no_solution(angle):
    assert verdict(LISTED, np.array([angle])).points == 0


def test_a_number_too_large_for_a_formula_is_the_students_own_fault():
    found = verdict(formulas((3,), ["l1", "q1", "q2"]), np.array([1e13, 0, 0]))
    assert (found.status, found.points) == ("failed", 0)


def test_a_long_argument_is_refused():
    by_hand = Part("t_x", "x?", 2, Manual(((2, "all"),)), lambda *_: "key")
    assert verdict(by_hand, [["a" * 400] * 60]).status == "failed"


def test_what_has_hardly_a_number_of_ones_own_is_not_followed():
    """Numbers without a name that come from nowhere are no ground for what follows from them."""
    first = Part(
        "t_x",
        "x?",
        2,
        Numbers((4,), decimals=3),
        lambda v, _: v["l1"] * np.array([1.1, 2.3, 3.7, 4.9]),
    )
    second = Part(
        "t_y", "y?", 2, Numbers((4,), decimals=3), lambda _, given: given["t_x"] * 3, needs=("t_x",)
    )
    exercise = exercise_of(
        first, second, draw=lambda rng: {**V, "l1": float(rng.uniform(0.4, 1.2))}
    )
    right = references(exercise, V)["t_x"]
    for off, points in (([0.31, 0.17, 0.23, 0.19], 0), ([0, 0.31, 0.17, 0.23], 2)):
        wrong = right + off
        found = mark(exercise, V, {"t_x": Raw("num", wrong), "t_y": Raw("num", 3 * wrong)})
        assert found[1].points == points, found
        assert ("Nothing follows from your own t_x" in said(found[1])) is (points == 0)
