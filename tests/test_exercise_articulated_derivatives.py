"""The articulated arm of S1 by differentiation: formulas against the engine, mistakes, and the point Q."""

import json

import numpy as np
import pytest
from answers import EXERCISES, right_raws, variant_of
from kinegrade.exercises.arm import arm_of
from kinegrade.exercises.arms.articulated import (
    LENGTHS,
    NAMES,
    S1,
    STRUCTURES,
    derivatives,
    drawn,
    in_letters,
    robot,
)
from kinegrade.exercises.exercise import references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.expression import parse
from kinegrade.solutions.expression_array import same_formulas
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.robots import Robot

ARM = EXERCISES["articulated_derivatives"]
BASES = {
    "floor": (),
    "ceiling": (("Rx", "pi"),),
    "wall x": (("Ry", "pi/2"), ("Rz", "pi/2")),
    "wall y": (("Rz", "-pi/2"), ("Ry", "-pi/2")),
}


def chain_of(v):
    """The arm as a table on its mounting."""
    mounting, first, second, sense = STRUCTURES[v["structure"]]
    rows = (
        (f"q1 + ({first})", "d1", "a1", "pi/2" if sense > 0 else "-pi/2"),
        (f"q2 + ({second})", "0", "a2", "0"),
        ("q3", "0", "a3", "0"),
        ("q4", "0", "a4", "-pi/2"),
        ("q5", "0", "0", "pi/2"),
        ("q6", "0", "0", "0"),
    )
    lengths = {name: v[name] for name in LENGTHS}
    return Robot("arm", "arm", lengths, rows, ((-3, 3),) * 6, "S1", base=BASES[mounting]).chain(
        lengths
    )


def position_of(structure):
    return robot(structure).symbolic().T[:3, 3].tolist()


def values(v):
    return {**{name: v[name] for name in LENGTHS}, **{f"q{i}": x for i, x in enumerate(v["q"], 1)}}


def marked(v, **answers):
    raws = {
        **right_raws(ARM, v),
        **{f"articulated_derivatives_{k}": Raw("text", x) for k, x in answers.items()},
    }
    return {
        verdict.part.removeprefix("articulated_derivatives_"): verdict
        for verdict in mark(ARM, v, raws)
    }


@pytest.mark.parametrize("structure", range(len(STRUCTURES)))
def test_position_and_derivatives_are_those_of_an_arm_that_can_be_built(structure):
    v = {**variant_of("articulated_derivatives"), "structure": structure}
    chain, at = chain_of(v), values(v)
    p = [parse(str(*entry), NAMES).at(at) for entry in position_of(structure)]
    np.testing.assert_allclose(p, forward(chain, v["q"])[:3, 3], atol=1e-12)
    rows = [derivatives(robot(structure), i).at(at) for i in range(3)]
    np.testing.assert_allclose(rows, jacobian(chain, v["q"])[:3], atol=1e-12)


def test_the_printed_position_says_what_the_formulas_say():
    v = variant_of("articulated_derivatives", 1)
    for formula in position_of(v["structure"]):
        latex = in_letters(*formula)
        text = (
            latex.replace(r"\,", "*")
            .replace("{", "")
            .replace("}", "")
            .replace("_", "")
            .replace("1(", "1*(")
        )
        for letter, name in (("S", "sin"), ("C", "cos")):
            for digits, angle in (("234", "q2+q3+q4"), ("23", "q2+q3"), ("2", "q2"), ("1", "q1")):
                text = text.replace(letter + digits, f"{name}({angle})")
        assert parse(text, NAMES).at(values(v)) == pytest.approx(
            parse(str(*formula), NAMES).at(values(v))
        )
        assert latex in ARM.statement(v)


@pytest.mark.parametrize("structure", range(len(STRUCTURES)))
def test_no_column_of_joints_1_to_4_is_the_one_in_s1(structure):
    for i in range(3):
        own = derivatives(robot(structure), i)
        same = same_formulas(own, derivatives(S1, i), NAMES)
        zero = [not entry.names for entry in own.entries]
        assert [
            bool(agrees) and not nothing for agrees, nothing in zip(same, zero, strict=True)
        ] == [False] * 6


def test_the_row_that_s1_prints_earns_nothing_and_is_named():
    s1 = [
        "-S1*(C234*a4 + C23*a3 + C2*a2)", "C1*(-S234*a4 - S23*a3 - S2*a2)", "C1*(-S234*a4 - S23*a3)", "C1*(-S234*a4)",
        "0", "0",
    ]  # fmt: skip
    for seed in range(5):
        found = marked(variant_of("articulated_derivatives", seed), x=s1)["x"]
        assert found.points == 0
        assert any("on the slides" in finding.text for finding in found.findings)


def test_shorthands_are_read_and_a_wrong_zero_costs_one_derivative():
    v = variant_of("articulated_derivatives", 0)
    row_z = references(ARM, v)["articulated_derivatives_z"]
    texts = row_z.text()
    earning = sum(bool(entry.names) for entry in row_z.entries)
    short = [
        t.replace("cos(q2 + q3 + q4)", "C234").replace("sin(q2 + q3 + q4)", "s_234") for t in texts
    ]
    assert short != texts
    assert marked(v, z=short)["z"].status == "correct"
    assert marked(v, z=[*texts[:5], "a4*C234"])["z"].points == round(2 * (earning - 1) / earning, 2)
    assert marked(v, z=["0"] * 6)["z"].points == 0


def test_numbers_follow_from_own_wrong_rows():
    v = variant_of("articulated_derivatives", 2)
    answers = references(ARM, v)
    wrong = ARM.parts[0].mistakes[1].solve(v, answers)
    part = ARM.parts[3]
    J = part.solve(v, {**answers, "articulated_derivatives_x": wrong})
    assert np.abs(J - answers[part.variable]).max() > 0.01
    raws = right_raws(ARM, v) | {
        "articulated_derivatives_x": Raw("text", wrong.text()),
        part.variable: Raw("num", J),
    }
    verdict = mark(ARM, v, raws)[3]
    assert verdict.points == part.points
    assert "your own articulated_derivatives_x" in verdict.findings[-1].text


def test_columns_5_and_6_of_the_point_q_are_as_the_right_letter_says():
    seen = set()
    for seed in range(12):
        v = json.loads(json.dumps(ARM.draw(np.random.default_rng(seed))))
        chain = chain_of(v)
        T = forward(chain, v["q"])
        beside = T[:3, 0]
        zero = {
            "c": (False, True),
            "e": (False, False),
        }
        letter = references(ARM, v)["articulated_derivatives_point"]
        seen.add(letter)
        if letter == "b":  # a point of link 4: joints 5 and 6 are behind it
            assert "between joints 4 and 5" in ARM.statement(v)
            continue
        far, near = (x / 100 for x in v["away"])
        assert f"{far:.2f} m along axis 6" in ARM.statement(v)
        assert (f"{near:.2f} m beside" in ARM.statement(v)) == (letter == "e")
        q_point = T[:3, 3] + far * T[:3, 2] + (near * beside if letter == "e" else 0)
        J = jacobian(chain, v["q"], point=q_point)[:3, 4:]
        assert tuple(bool(np.linalg.norm(column) < 1e-9) for column in J.T) == zero[letter]
        assert ("beside that axis" in ARM.statement(v)) == (letter == "e")
    assert seen == {"b", "c", "e"}


@pytest.mark.parametrize("seed", range(4))
def test_the_figure_shows_the_arm_as_it_is_mounted(seed):
    v = variant_of("articulated_derivatives", seed)
    (drawing,) = ARM.drawings(v)
    T = forward(drawing.chain, drawing.q)
    np.testing.assert_allclose(T, forward(chain_of(v), v["q"]), atol=1e-12)
    np.testing.assert_allclose(drawing.triads[-1].pose, T, atol=1e-12)
    np.testing.assert_allclose(drawing.stands, chain_of(v).fixed[0][:3, 2], atol=1e-12)
    arm = arm_of(robot(v["structure"]), v)
    for line in drawn(arm).dimensions:
        assert np.linalg.norm(np.subtract(line.end, line.start)) == pytest.approx(v[line.name])
