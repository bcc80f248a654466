"""Conditions are judged by where they hold, however they are written: every branch hit, nothing that is not asked."""

import numpy as np
import pytest
from answers import EXERCISES, right_raws, variant_of
from kinegrade.exercises.answers import Conditions
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.conditions import MARKER, MOST_WORK, read_conditions
from kinegrade.grader.kinds.marker import Wanted
from kinegrade.grader.kinds.work import budget
from kinegrade.grader.kinds.zero_sets import judge_conditions
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.reading.unreadable import Unreadable
from kinegrade.solutions.expression import Expression, parse

V = {"a1": 0.3, "l3": 0.4, "q": [0.1, 0.2, 0.3]}
NAMES = ("a1", "l3", "q1", "q2", "q3")
DOMAIN = {"q1": (-np.pi, np.pi), "q2": (-np.pi, np.pi), "q3": (0.0, 1.5)}
SPHERICAL = ("sin(q2)", "q3")
OFFSET = ("a1 + q3*sin(q2)", "q3")
ELBOW = ("tan(q2) + 2",)


def judged(reference, *texts, domain=DOMAIN):
    own = read_conditions(Conditions(NAMES, lambda _: domain), Raw("text", list(texts)), V)
    return judge_conditions([parse(text, NAMES) for text in reference], own, domain, V)


@pytest.mark.parametrize(
    ("reference", "texts"),
    [
        (SPHERICAL, ["sin(q2) = 0", "q3 = 0"]),
        (SPHERICAL, ["s2 = 0 or q3 = 0"]),
        (SPHERICAL, ["q2 = 0", "q2 = pi", "q3 = 0"]),
        (SPHERICAL, ["q2 = 0", "q2 = -pi", "q3 = 0"]),
        (SPHERICAL, ["q2 = k*pi", "q3 = 0"]),
        (SPHERICAL, ["q3*sin(q2) = 0"]),
        (SPHERICAL, ["q3^2*s2 = 0"]),
        (SPHERICAL, ["cos(q2)^2 = 1", "q3 = 0"]),
        (SPHERICAL, ["θ2 = 0", "θ2 = ±π", "q3 = 0"]),
        (OFFSET, ["q3 = 0", "sin(q2) = -a1/q3"]),
        (OFFSET, ["q3 = 0", "a1 + q3*s2 = 0"]),
        (OFFSET, ["q3 = 0", "2*a1 = -2*q3*s2"]),
        (ELBOW, ["q2 = -atan(2)", "q2 = pi - atan(2)"]),
        (ELBOW, ["2*cos(q2) + sin(q2) = 0"]),
        (SPHERICAL, ["q2 = 3.1416 or q2 = 0", "q3 = 0"]),
        (SPHERICAL, ["q2 = 3.14159", "q2 = -3.1416", "q2 = 0", "q3 = 0"]),
        (SPHERICAL, ["q2 = k*3.1416", "q3 = 0"]),
        (SPHERICAL, ["q2 = 3.142, 0", "q3 = 0"]),
        (SPHERICAL, ["cos(q2 - 1.571) = 0", "q3 = 0"]),
        (SPHERICAL, ["q2 = 0°", "q2 = 180 deg", "q3 = 0"]),
        (("cos(q2)", "q3"), ["q2 = ±90°", "q3 = 0"]),
        (("cos(q2)", "q3"), ["q2 = 3.1416/2", "q2 = -1.5708", "q3 = 0"]),
        (("cos(2*q2 - pi/6)",), ["2*q2 = 0.5236 + 1.5708 + k*3.14159"]),
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
        (SPHERICAL, ["sin(q2) = 0"], 1 / 2, "Not all conditions are there"),
        (SPHERICAL, ["q2 = 0", "q3 = 0"], 1 / 2, "look for another branch"),
        (ELBOW, ["q2 = -atan(2)"], 0, "look for another branch"),
        (
            SPHERICAL,
            ["sin(q2) = 0", "q3 = 0", "q1 = 0"],
            1 / 2,
            "holds at postures that are not asked for",
        ),
        (
            SPHERICAL,
            ["sin(q2) = 0", "q3 = 0", "cos(q2) = 0"],
            1 / 2,
            "holds at postures that are not asked for",
        ),
        (SPHERICAL, ["sin(q2) = 0", "q3 = 7"], 0, "met nowhere within the limits"),
        (SPHERICAL, ["cos(q2) = 0", "q1 = 0"], 0, "Not all conditions are there"),
        (OFFSET, ["q3 = 0", "a1 - q3*sin(q2) = 0"], 0, "not asked for"),
    ],
)
def test_what_is_missing_or_too_much_is_said_and_costs_its_share(reference, texts, share, words):
    found = judged(reference, *texts)
    assert found.share == pytest.approx(share)
    assert any(words in sentence for sentence in found.findings)


@pytest.mark.parametrize("texts", [["q2 = 3.14", "q2 = 0"], ["q2 = 3.1421", "q2 = 0"]])
def test_a_number_that_is_no_rounding_of_an_angle_stays_as_it_is(texts):
    assert judged(SPHERICAL, *texts, "q3 = 0").share == 0


def test_a_length_or_a_number_of_the_sheet_is_no_rounded_angle():
    v = V | {"l3": 0.785, "beta": 0.524, "q": [0.1, 0.262, 0.3], "told": [["R", "P"], [1]]}
    texts = ["q3 = 1.571", "q3 + 0.785 = 0", "l3*sin(q2) = 0.262", "q1 = 0.524", "q2 = -0.262"]
    answer = Conditions(NAMES, lambda _: DOMAIN)
    found = read_conditions(answer, Raw("text", [*texts, "q1 = 1.047"]), v)
    assert [str(each) for each in found] == [
        "q3 - 1.571",
        "q3 + 0.785",
        "l3*sin(q2) - 0.262",
        "q1 - 0.524",
        "q2 - (-0.262)",
        "q1 - pi/3",
    ]


@pytest.mark.parametrize("texts", [["q2 - q2 = 0"], ["sin(q2)^2 + cos(q2)^2 = 1"], ["q3^2 = -1"]])
def test_a_condition_that_always_or_never_holds_earns_nothing(texts):
    assert judged(SPHERICAL, *texts).share == 0
    assert judged(SPHERICAL, *texts, "sin(q2) = 0").share < 1


@pytest.mark.parametrize("l3", [0.2, 0.25, 0.3, 0.4, 0.5])
def test_a_pole_on_the_grid_is_no_zero(l3):
    domain = DOMAIN | {"q3": (-1.5, 1.5)}
    texts = ["q3 + l3 = 0", "sin(q2) = -a1/(q3 + l3)"]
    answer = Conditions(NAMES, lambda _: domain)
    v = V | {"l3": l3}
    own = read_conditions(answer, Raw("text", texts), v)
    reference = [parse(text, NAMES) for text in ("q3 + l3", "a1 + (q3 + l3)*sin(q2)")]
    assert judge_conditions(reference, own, domain, v).share == 1


def test_a_pole_is_no_zero():
    assert judged(("sin(q2)",), "1/tan(q2) = 0").share == 0
    assert judged(("cos(q2)",), "1/tan(q2) = 0").share == 1


@pytest.mark.parametrize(
    "value",
    ["q2 = 0; q3 = 0", ["q2 = 0", "q3 = 0"], [["q2 = 0", "q3 = 0"]], [["q2 = 0"], ["q3 = 0"]]],
)
def test_conditions_are_read_from_a_list_a_row_or_a_column(value):
    read = read_conditions(Conditions(NAMES, lambda _: DOMAIN), Raw("text", value), V)
    assert [str(condition) for condition in read] == ["q2", "q3"]


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        (Raw("num", np.zeros(3)), "takes a list of conditions in a1, l3, q1, q2, q3"),
        (Raw("text", []), "takes 1 to 32 conditions, got 0"),
        (Raw("text", ["q2 = 0"] * 60), "takes 1 to 32 conditions, got more than 32"),
        (Raw("text", ["q7 = 0"]), "q7"),
        (Raw("text", ["1 = 0"]), "takes a joint or another name"),
        (Raw("text", ["__import__('os') = 0"]), "__import__"),
    ],
)
def test_what_is_no_condition_is_refused(raw, words):
    with pytest.raises(Unreadable) as caught:
        read_conditions(Conditions(NAMES, lambda _: DOMAIN), raw, V)
    assert words in str(caught.value)


PRODUCT = "sin(q1*17 + q2*13)" + "".join(f"*sin(q1 + q2 + {i})" for i in range(20))
LABORIOUS = {
    "products": [f"{PRODUCT}*cos(q3 + {i})" for i in range(32)],
    "sums that are never zero": [
        f"{i + 1} + " + " + ".join(f"(q1 + q2 + q3 + {k})^2" for k in range(18)) for i in range(32)
    ],
    "one formula of many waves": [" + ".join(f"sin({i}*q1)*cos({i}*q2)*q3" for i in range(1, 300))],
}


@pytest.mark.parametrize("name", LABORIOUS)
def test_conditions_that_take_too_much_work_are_refused_before_it_is_done(name, monkeypatch):
    done = []
    at = Expression.at

    def counted(expression, values):
        result = at(expression, values)
        done.append(len(expression.nodes) * np.size(result))
        return result

    answer = Conditions(NAMES, lambda _: DOMAIN)
    own = read_conditions(answer, Raw("text", LABORIOUS[name]), V)
    wanted = Wanted((parse("sin(q2)", NAMES),), {})
    monkeypatch.setattr(Expression, "at", counted)
    with pytest.raises(Unreadable, match="cannot be read in reasonable time"):
        MARKER.compared(answer, V, wanted, own)
    assert sum(done) <= MOST_WORK


def test_conditions_that_students_write_take_a_small_part_of_the_budget():
    own = [
        "sin(q2) = 0",
        "q3 + l3 = 0",
        "cos(q1)^2 + sin(q2)^2 = 0",
        "a1*cos(q2) + l3 = 2*q3",
        "q3 = 7",
        "q2 = 3*pi",
    ]
    with budget(MOST_WORK / 3):
        judged(("sin(q2)", "q3 + l3"), *own)


def test_a_budget_that_is_spent_is_said_on_the_part_and_costs_no_other():
    exercise, v = EXERCISES["rrt"], variant_of("rrt")
    raws = right_raws(exercise, v) | {"rrt_singular": Raw("text", LABORIOUS["products"])}
    verdicts = {verdict.part: verdict for verdict in mark(exercise, v, raws)}
    spent = verdicts.pop("rrt_singular")
    assert (spent.status, spent.points) == ("failed", 0)
    assert spent.findings[0].text.startswith("Cannot be read in reasonable time")
    assert {verdict.status for verdict in verdicts.values()} == {"correct"}
