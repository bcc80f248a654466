"""Conditions of several equations at once: asked, typed in any way, and judged by where they hold."""

import numpy as np
import pytest
from answers import answer_code
from courses import exercise_of
from kinegrade.course.proof.validate import validate_file
from kinegrade.exercises.answers import Conditions
from kinegrade.exercises.exercise import ExerciseError, Part, references
from kinegrade.exercises.files.finding import load
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.common_roots import common_roots
from kinegrade.grader.kinds.conditions import read_conditions
from kinegrade.grader.kinds.sums import equations_within
from kinegrade.grader.kinds.zero_sets import judge_conditions
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.reading.unreadable import Unreadable
from kinegrade.solutions.condition import AllOf, condition_sympy, condition_text
from kinegrade.solutions.expression import ExpressionError, parse

PLANAR_4R = '''
"""The postures in which a planar arm with four joints loses a direction."""
import numpy as np
from kinegrade.exercises.exercise import Conditions, Exercise, Mistake, Part, Step
from kinegrade.solutions.condition import condition_sympy

NAMES = ("l1", "l2", "l3", "l4", "q1", "q2", "q3", "q4")
DOMAIN = {f"q{i}": (-np.pi, np.pi) for i in range(1, 5)}


def draw(rng):
    lengths = {f"l{i}": float(rng.integers(20, 60)) / 100 for i in range(1, 5)}
    return lengths | {"q": [float(rng.integers(200, 1300)) / 1000 for _ in range(4)]}


def singular(v, _):
    return ["sin(q2) = 0 and sin(q3) = 0 and sin(q4) = 0"]


def explain(v, given):
    (condition,) = given_singular(v)
    return [Step("All links lie along one line:", formula=condition_sympy(condition))]


def given_singular(v):
    return PART.answer.declared(singular(v, {}), v)


PART = Part(
    "planar_4r_singular",
    "All postures in which the block of the linear velocity has rank 1",
    4,
    Conditions(NAMES, lambda _: DOMAIN),
    singular,
    mistakes=(Mistake("The last joint moves the tip, too.", lambda v, _: [("sin(q2)", "sin(q3)")]),),
    explain=explain,
)
EXERCISE = Exercise(
    slug="planar_4r",
    title="A planar arm with four joints",
    source="made for tests",
    draw=draw,
    parts=(PART,),
    statement=lambda v: "Four links in a plane.",
    units={**{f"l{i}": "m" for i in range(1, 5)}, "q": ["rad"] * 4},
    scale=lambda v: v["l1"],
)
'''
V = {"l1": 0.5, "l2": 0.3, "x": 0.2, "q": [0.1, 0.2, 0.3, 0.4]}
NAMES = ("l1", "l2", "q1", "q2", "q3", "q4")
TURNS = {f"q{i}": (-np.pi, np.pi) for i in range(1, 5)}
SLIDE = TURNS | {"q3": (0.0, 1.5), "q4": (-1.0, 2.0)}
ALL = ("sin(q2) = 0 and sin(q3) = 0 and sin(q4) = 0",)
TWO = ("sin(q2) = 0 and sin(q3) = 0", "q4")
NOT_ASKED = "holds at postures that are not asked for"
BRANCH = "look for another branch"


def planar_4r(folder):
    path = folder / "planar_4r.py"
    path.write_text(PLANAR_4R, encoding="utf-8")
    return path


def conditions(domain=TURNS):
    return Conditions(NAMES, lambda _: domain)


def judged(reference, *texts, domain=TURNS):
    answer = conditions(domain)
    own = read_conditions(answer, Raw("text", list(texts)), V)
    return judge_conditions(answer.declared(reference, V), own, domain, V)


def test_the_exercise_of_a_planar_arm_with_four_joints_is_sound(tmp_path):
    found = validate_file(planar_4r(tmp_path), 10)
    assert found.failures == ()
    assert (found.parts, found.points) == (1, 4)


@pytest.mark.parametrize(
    ("answer", "points", "words"),
    [
        (["sin(q2) = 0 and sin(q3) = 0 and sin(q4) = 0"], 4, ""),
        ("q2 = 0, pi and q3 = 0, pi and q4 = 0, pi", 4, ""),
        (["sin(q2)^2 + sin(q3)^2 + sin(q4)^2 = 0"], 4, ""),
        (["|s2| + l2*|s3| + |s4| = 0"], 4, ""),
        (["s2 & s23 & s34"], 4, ""),
        (["sin(q2) = 0"], 0, NOT_ASKED),
        (["sin(q2) = 0", "sin(q3) = 0", "sin(q4) = 0"], 0, NOT_ASKED),
        (["q2 = 0 and q3 = 0 and q4 = 0"], 0, BRANCH),
        (["sin(q2) = 0 and sin(q3) = 0"], 0, "The last joint moves the tip, too."),
    ],
)
def test_the_planar_arm_is_marked_however_it_is_written(tmp_path, answer, points, words):
    exercise = load(planar_4r(tmp_path))
    v = exercise.draw(np.random.default_rng(0))
    (found,) = mark(exercise, v, {"planar_4r_singular": Raw("text", answer)})
    assert found.points == points
    assert words in " ".join(finding.text for finding in found.findings)


@pytest.mark.parametrize(
    ("reference", "texts"),
    [
        (ALL, ["q2 = k*pi and q3 = n*pi and q4 = m*pi"]),
        (ALL, ["q2 = 0, -pi and q3 = 0, -pi and (q4 = 0 or q4 = pi)"]),
        (ALL, ["q2 = 0, pi and q3 = 0, pi and q4 = 0", "q2 = 0, pi and q3 = 0, pi and q4 = pi"]),
        (ALL, ["tan(q2) = 0 and sin(q2 + q3) = 0 and l1*sin(q2 + q3 + q4) = 0"]),
        (ALL, ["sin(q2)^2 + 100*sin(q3)^2 = 0 and sin(q4)^2 = 0"]),
        (ALL, ["sin(q2)^2 + sin(q3)^4 = -l1*abs(sin(q4))"]),
        (ALL, ["-l1^2*s2^2 - s3^2*(l1 + l2)/2 - 2*s4^2 = 0"]),
        (ALL, ["sqrt(sin(q2)^2 + 20*sin(q3)^2) + sin(q4)^2 = 0"]),
        (ALL, ["cos(q2)^2 + cos(q3)^2 + cos(q4)^2 = 3"]),
        (ALL, ["cos(2*q2) + 10*cos(2*q3) + cos(2*q4)/10 = 11.1"]),
        (ALL, ["cos(q2)^2 + cos(q3)^2 = 2 and sin(q4) = 0"]),
        (TWO, ["q4 = 0 or sin(q3) = 0 and sin(q2) = 0"]),
        (TWO, ["q4*(sin(q2)^2 + sin(q3)^2) = 0"]),
        (TWO, ["s2 = 0 and s3 = 0", "q4 = 0", "q4 = 0 and q1 = 1"]),
        ([("sin(q2)", "sin(q3) = 0"), parse("q4", NAMES)], list(TWO)),
        (["sin(q2)^2 + sin(q3)^2", "q4"], ["s2 and s3", "q4"]),
    ],
)
def test_the_same_postures_in_other_words_are_right(reference, texts):
    found = judged(reference, *texts)
    assert found.share == 1
    assert all(found.holds)
    assert found.findings == ()


@pytest.mark.parametrize(
    ("reference", "texts", "share", "words"),
    [
        (TWO, ["q4 = 0"], 1 / 2, "Not all conditions are there"),
        (TWO, ["s2 = 0 and s3 = 0"], 1 / 2, "Not all conditions are there"),
        (TWO, ["q4 = 0", "s2 = 0 and q3 = 0"], 1 / 2, BRANCH),
        (TWO, ["q4 = 0", "s2 = 0 and s3 = 0", "s1 = 0 and s2 = 0"], 1 / 2, NOT_ASKED),
        (TWO, ["q4 = 0", "sin(q2) = 0"], 0, NOT_ASKED),
        (TWO, ["q4 = 0", "s2 = 0 and s2 = 1"], 0, "met nowhere within the limits"),
        (ALL, ["s2^2 + s3^2 + s4^2 = -1"], 0, "met nowhere within the limits"),
        (ALL, ["s2^2*s3^2 + s4^2 = 0"], 0, NOT_ASKED),
        (ALL, ["s1 and s2 and s3 and s4"], 0, "Not all conditions are there"),
        (["sin(q2)"], ["sin(q2) = 0 and sin(q3) = 0"], 0, "Not all conditions are there"),
    ],
)
def test_what_is_missing_or_too_much_is_said_and_costs_its_share(reference, texts, share, words):
    found = judged(reference, *texts)
    assert found.share == pytest.approx(share)
    assert any(words in sentence for sentence in found.findings)


@pytest.mark.parametrize(
    ("texts", "share"),
    [
        (["q2 = 0, pi and q3 = 0 and q4 = 2"], 1),
        (["q2 = 0, -pi and q3^2 = 0 and (q4 - 2)^2 = 0"], 1),
        (["q2 = 0, pi and q3*(q3 - 1.8) = 0 and q4 = 2"], 1),
        (["q2 = 0, pi and q3 = -0.1 and q4 = 2"], 0),
        (["q2 = 0, pi and q3 = 0 and q4 = 2.1"], 0),
    ],
)
def test_the_ends_of_a_range_are_inside_and_what_lies_beyond_is_not(texts, share):
    assert judged(["sin(q2) = 0 and q3 = 0 and q4 = 2"], *texts, domain=SLIDE).share == share


def test_single_postures_are_found_too():
    """The two elbows of a planar arm that reaches for a point."""
    x, y = "l1*cos(q1) + l2*cos(q1 + q2)", "l1*sin(q1) + l2*sin(q1 + q2)"
    bend = np.arccos((0.4**2 - 0.5**2 - 0.3**2) / (2 * 0.5 * 0.3))
    turn = np.pi / 2 - np.arctan2(0.3 * np.sin(bend), 0.5 + 0.3 * np.cos(bend))
    elbows = [f"q2 = {bend!r} and q1 = {turn!r}", f"q2 = {-bend!r} and q1 = {np.pi - turn!r}"]
    elbows = [text.replace("np.float64(", "").replace(")", "") for text in elbows]
    assert judged([f"{x} = 0 and {y} = 0.4"], *elbows).share == 1
    assert judged([f"{x} = 0 and {y} = 0.4"], elbows[0]).share == 0


def test_all_corners_of_six_sines_are_found():
    names = tuple(f"q{i}" for i in range(1, 8))
    domain = dict.fromkeys(names, (-np.pi, np.pi))
    answer = Conditions(names, lambda _: domain)
    reference = answer.declared([" and ".join(f"sin({name})" for name in names[1:])], {})
    for corner in (0, 21, 63):
        places = [f"cos({name}) = {1 - 2 * (corner >> i & 1)}" for i, name in enumerate(names[1:])]
        rest = [f"sin({name}) = 0" for name in names[1:]]
        own = answer.declared([" and ".join(places)], {})
        found = judge_conditions(reference, own, domain, {})
        assert found.holds == (True,)
        assert BRANCH in found.findings[0]
        assert (
            judge_conditions(reference, answer.declared([" and ".join(rest)], {}), domain, {}).share
            == 1
        )


def test_nothing_warns_where_a_condition_has_poles_or_no_value():
    for text in (
        "1/s2 and 1/s3",
        "tan(q2)^20 = 0 and 1/tan(q3)^20 = 0",
        "sqrt(q2 - 1) and asin(q3)",
        "1/s2^2 + 1/s3^2",
    ):
        assert judged(ALL, text).share == 0


def test_starts_at_which_a_function_is_infinite_are_left_out():
    def beside_a_wall(x):
        return np.where(x > 0.5, np.inf, x)

    found = common_roots(beside_a_wall, np.array([[-1.0, 0.3, 0.5, 0.9]]))
    np.testing.assert_allclose(found, np.zeros((1, 2)), atol=1e-9)


def test_a_reference_may_be_texts_expressions_or_tuples_of_them():
    sine, slide = parse("sin(q2)", NAMES), parse("q3", NAMES)
    joint = AllOf((sine, slide))
    for value in (
        ["sin(q2) = 0 and q3 = 0"],
        "sin(q2) and q3",
        [("sin(q2)", "q3 = 0")],
        [[sine, slide]],
        [joint],
    ):
        assert conditions().declared(value, V) == (joint,)
    assert conditions().declared(["sin(q2)", slide, ("q3",)], V) == (sine, slide, slide)
    assert conditions().declared(["q3 = 0 or sin(q2) = 0"], V) == (slide, sine)


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (
            [("q2 = 0 or q2 = pi", "q3")],
            "takes one equation in each place of a tuple that holds at once, got 'q2 = 0 or",
        ),
        ([()], "two or more that hold at once, got 0"),
        ([("q2", "q9")], "unknown name 'q9'"),
        ([3.0], "a condition takes text, got float"),
    ],
)
def test_a_reference_that_is_no_condition_is_an_error_of_the_exercise(value, words):
    part = Part("t_x", "x?", 1, conditions(), lambda *_: value)
    with pytest.raises(ExerciseError, match="solve of t_x") as caught:
        references(exercise_of(part), V)
    assert words in str(caught.value)


def test_a_condition_is_printed_as_it_is_read():
    (joint, single) = conditions().declared(TWO, V)
    assert condition_text(joint) == "sin(q2) = 0 and sin(q3) = 0"
    assert condition_text(single) == "q4 = 0"
    part = Part("t_x", "x?", 1, conditions(), lambda *_: TWO)
    code = answer_code(part, (joint, single))
    assert code == "t_x = [\n    'sin(q2) = 0 and sin(q3) = 0',\n    'q4 = 0',\n]"
    (verdict,) = mark(
        exercise_of(part, draw=lambda _: V), V, {"t_x": Raw("text", ["q4 = 0 or s2 and s3"])}
    )
    assert verdict.status == "failed"  # where one equation has two sides, all take two
    (verdict,) = mark(
        exercise_of(part, draw=lambda _: V),
        V,
        {"t_x": Raw("text", ["q4 = 0 or s2 = 0 and s3 = 0"])},
    )
    assert (verdict.status, verdict.answer) == (
        "correct",
        ["q4 = 0", "sin(q2) = 0 and sin(q3) = 0"],
    )
    assert verdict.right == [True, True]


def test_sympy_prints_a_condition_as_equations_with_a_wedge():
    import sympy

    joint, single = conditions().declared(TWO, V)
    assert sympy.latex(condition_sympy(joint)).count("= 0") == 2
    assert r"\wedge" in sympy.latex(condition_sympy(joint))
    assert sympy.latex(condition_sympy(single)) == "q_{4} = 0"


def test_the_record_tells_a_joint_condition_from_two():
    together, apart = (conditions().declared(value, V) for value in (["q2 and q3"], ["q2", "q3"]))
    one, two = (np.array(conditions().pictured(value, V)) for value in (together, apart))
    assert (one.shape, two.shape) == ((3, 3), (2, 3))
    np.testing.assert_array_equal(one[1:], two)


def test_one_equation_is_no_joint_condition():
    with pytest.raises(ExpressionError, match="two or more that hold at once, got 1"):
        AllOf((parse("q1", NAMES),))


def test_no_answer_keeps_the_grader_busy():
    eight = " and ".join(f"sin({i}*q1) = 0" for i in range(1, 9))
    with pytest.raises(Unreadable, match="takes up to 64 equations in all conditions, got 72"):
        read_conditions(conditions(), Raw("text", [eight] * 9), V)
    long = "q1" + " + q2" * 1900 + " = 0"
    with pytest.raises(Unreadable, match="takes up to 6000 numbers, names and signs in all"):
        read_conditions(conditions(), Raw("text", [long] * 2), V)


def test_a_sum_of_a_thousand_squares_is_taken_apart():
    squares = parse("+".join(["q1^2"] * 1000), NAMES)
    assert equations_within(squares, {}) == [parse("q1", NAMES)] * 1000
