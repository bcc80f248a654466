"""A part is a function of the names on the sheet: what its parameters stand for, and what is refused when it loads."""

import numpy as np
import pytest
from kinegrade.exercises.answers import Conditions, Formulas, Numbers
from kinegrade.exercises.exercise import ExerciseError, Outcome, references
from kinegrade.exercises.part import exercise, part
from kinegrade.solutions.robots import ROBOTS

PLANAR = ROBOTS["planar_2r"]
V = {"l1": 1.0, "l2": 0.5, "q": [0.3, 0.8], "qdot": [1.0, -2.0]}


def draw(_):
    return dict(V)


@part(2, Numbers((2, 2), "m/rad"))
def J(arm):
    r"""The Jacobian $\mathbf J$

    - A hint
      of two lines.
    - Another.

    It is <how>:
    $$\mathbf J = <J>$$
    """
    return arm.J[:2]


J = part(2, Numbers((2, 2), "m/rad"), shows={"how": lambda arm: arm.kinds})(J.solve)


@part(1, Numbers((2,), "m/s"))
def speed(J, qdot):
    """The velocity."""
    return J @ qdot


def said(question, solve=lambda arm: arm.J[:2]):
    """A function with this docstring."""
    solve.__doc__ = question
    return solve


def made(*parts, **more):
    plain = {
        "title": "T",
        "source": "S",
        "robot": PLANAR,
        "draw": draw,
        "units": {"qdot": ["rad/s"] * 2},
    }
    return exercise("made", parts=parts, **(plain | more))


def explained(exercise):
    explain = exercise.parts[0].explain
    assert explain is not None
    return [*explain(V, references(exercise, V))]


def test_a_docstring_is_question_hints_and_solution():
    first = made(J).parts[0]
    assert first.prompt == r"The Jacobian $\mathbf J$"
    assert first.hints == ("A hint of two lines.", "Another.")
    (step,) = explained(made(J))
    assert (step.text, step.symbol) == ("It is RR:", r"\mathbf J")
    np.testing.assert_allclose(step.numbers, references(made(J), V)["made_J"])


def test_names_are_variables_and_parameters_are_needs():
    first, second = made(J, speed).parts
    assert (first.variable, second.variable) == ("made_J", "made_speed")
    assert (first.needs, second.needs) == ((), ("made_J",))
    own = second.solve(V, {"made_J": np.eye(2)})
    np.testing.assert_allclose(own, V["qdot"])


def test_units_and_size_of_a_robot_are_known():
    made_here = made(J)
    assert made_here.units == {
        "l1": "m",
        "l2": "m",
        "q": ["rad", "rad"],
        "qdot": ["rad/s", "rad/s"],
    }
    assert made_here.scale(V) == pytest.approx(1.5)
    assert "standard" in made_here.statement(V)
    assert len(made_here.drawings(V)) == 1


def test_a_mistake_may_take_the_part_itself_and_a_check_the_value():
    seen = []

    def check(v, qdot, value):
        seen.append((v, qdot, value))

    @part(1, Numbers((2,), "m/s"), mistakes=[("Signs.", lambda rate: -rate)], check=check)
    def rate(J, qdot):
        """The speed"""
        return J @ qdot

    last = made(J, rate).parts[-1]
    given = {"made_J": np.eye(2)}
    np.testing.assert_allclose(last.mistakes[0].solve(V, given), [-1.0, 2.0])
    assert last.check is not None
    assert last.check(V, given, np.zeros(2)) == Outcome()
    assert seen[0][0] is V
    np.testing.assert_allclose(seen[0][1], V["qdot"])


def test_a_parameter_that_only_some_variants_have_takes_a_default():
    @part(1, Numbers((), "m"))
    def reach(l1, a9=0.25):
        """The reach"""
        return l1 + a9

    both = made(reach, units={"a9": "m", "qdot": ["rad/s"] * 2})
    assert both.parts[0].solve(V, {}) == pytest.approx(1.25)
    assert both.parts[0].solve({**V, "a9": 1.0}, {}) == pytest.approx(2.0)


def test_a_number_that_a_variant_lacks_is_named():
    @part(1, Numbers((), "m"))
    def reach(a9):
        """The reach"""
        return a9

    with pytest.raises(
        ExerciseError, match=r"a9 is not among the numbers of this variant.*a9=0\.0"
    ):
        references(made(reach, units={"a9": "m", "qdot": ["rad/s"] * 2}), V)


def test_drawn_lists_of_numbers_are_arrays_and_anything_else_is_as_drawn():
    @part(1, Numbers((), "1"))
    def count(rows, words, ragged):
        """The count"""
        assert isinstance(rows, np.ndarray)
        assert words == ["a", "b"]
        assert ragged == [[1], [2, 3]]
        return rows.sum()

    drawn = {**V, "rows": [[1, 2], [3, 4]], "words": ["a", "b"], "ragged": [[1], [2, 3]]}
    made_here = made(count, hidden=("rows", "words", "ragged"), draw=lambda _: drawn)
    assert references(made_here, drawn)["made_count"] == 10


def refused(*parts, match, **more):
    with pytest.raises(ExerciseError, match=match):
        made(*parts, **more)


def test_a_parameter_that_stands_for_nothing_is_refused_with_the_nearest_name():
    @part(1, Numbers((2,), "m/s"))
    def rate(J, qdt):
        """The speed"""
        return J @ qdt

    refused(
        J,
        rate,
        match=r"made: rate takes 'qdt', which is no name on the sheet; did you mean 'qdot'\?",
    )


def test_a_later_part_is_no_name_yet():
    refused(speed, J, match="speed takes 'J', which is no name on the sheet")


def test_a_default_does_not_excuse_a_misspelled_name_and_keyword_only_constants_do():
    @part(1, Numbers((), "m"))
    def reach(l_1=1.0):
        """The reach"""
        return l_1

    refused(reach, match="reach takes 'l_1'.*did you mean 'l1'")

    @part(1, Numbers((), "m"))
    def twice(l1, *, factor=2.0):
        """Twice"""
        return factor * l1

    assert references(made(twice), V)["made_twice"] == pytest.approx(2.0)


def test_mistakes_checks_and_shown_values_are_looked_at_too():
    def with_(**options):
        return part(1, Numbers((2, 2), "m/rad"), **options)(J.solve)

    refused(with_(mistakes=[("x", lambda ar: ar)]), match=r"mistake 1 of J takes 'ar'.*'arm'")
    refused(with_(check=lambda values: values), match="the check of J takes 'values'.*'value'")
    refused(with_(shows={"how": lambda x: x}), match="'how', shown in the solution of J, takes 'x'")
    refused(
        with_(), match=r"the solution of J shows <how>, which is no value here; there are: J, l1"
    )


def test_a_mistake_takes_no_part_that_its_part_does_not_need():
    wrong = part(1, Numbers((2,), "m/s"), mistakes=[("x", lambda J: J[0])])(
        lambda qdot: qdot
    ).called("rates")
    refused(J, wrong, match="mistake 1 of rates takes 'J', which rates itself does not take")


def test_a_drawn_number_that_stands_nowhere_is_refused_on_the_day_of_the_draw():
    bad = made(J, draw=lambda _: V | {"qdott": 1.0})
    with pytest.raises(
        ExerciseError, match=r"draw returns 'qdott'.*neither in units.*is 'qdot' there meant"
    ):
        bad.draw(np.random.default_rng(0))


def test_a_part_is_not_called_as_a_drawn_number():
    refused(J.called("qdot"), match="a part cannot be called qdot")


def test_without_a_robot_there_is_no_arm_no_statement_and_no_size():
    refused(J, match="J takes 'arm', but the exercise has no robot", robot=None)
    lonely = part(1, Numbers((2,), "1"))(lambda qdot: qdot).called("same")
    refused(lonely, match="a statement is missing", robot=None)
    refused(lonely, match="scale, a typical length", robot=None, statement="x")


def test_an_arm_without_a_drawn_q_is_a_sentence():
    lame = made(J, draw=lambda _: {"l1": 1.0, "l2": 0.5})
    with pytest.raises(
        ExerciseError, match=r"exercise made: solve of made_J: arm takes a q among .*, got l1, l2"
    ):
        references(lame, lame.draw(np.random.default_rng(0)))


def test_a_function_of_star_parameters_is_refused():
    refused(
        part(1, Numbers((2,), "1"))(lambda *many: many).called("x"),
        match="takes parameters that are names",
    )
    with pytest.raises(
        ExerciseError, match="mistake 1 of same takes a function of names on the sheet, got 3"
    ):
        made(part(1, Numbers((2,), "1"), mistakes=[("x", 3)])(lambda qdot: qdot).called("same"))


def test_a_renamed_part_takes_other_names():
    tool = part(2, Numbers((2, 2), "m/rad"))(said("The Jacobian")).called("J_tool")
    made_here = made(tool, speed.called("v_tool", J="J_tool"))
    assert made_here.parts[1].needs == ("made_J_tool",)
    assert tool.name == "J_tool"


def test_conditions_and_formulas_are_shown_as_formulas():
    @part(1, Formulas((), PLANAR.names))
    def height():
        r"""The height

        It is
        $$y = <height>$$
        """
        return "l1*sin(q1) + l2*sin(q1 + q2)"

    (step,) = explained(made(height))
    assert str(step.formula) == "l1*sin(q1) + l2*sin(q1 + q2)"


def test_an_array_has_no_place_in_a_text():
    bad = part(2, Numbers((2, 2), "m/rad"), shows={"how": lambda J: J})(J.solve)
    with pytest.raises(
        ExerciseError, match="<how> stands in a text, which takes text or a number, got ndarray"
    ):
        explained(made(bad))


def test_drawn_numbers_are_shown_with_the_digits_of_the_sheet():
    @part(1, Numbers((2,), "rad/s", 1))
    def twice(qdot):
        r"""Twice the rates

        The rates, as printed:
        $$\dot{\mathbf q} = <qdot>$$

        Twice as much:
        $$2\dot{\mathbf q} = <twice>$$
        """
        return 2 * qdot

    exercise = made(twice)
    v = V | {"qdot": [1.25, -2.0]}
    first, second = exercise.parts[0].explain(v, references(exercise, v))
    assert (first.decimals, second.decimals) == (2, None)


def test_a_joint_condition_is_shown_whole():
    @part(1, Conditions(PLANAR.names, lambda _: {"q1": (-3.2, 3.2), "q2": (-3.2, 3.2)}))
    def singular():
        r"""All postures

        They are:
        $$<singular>$$
        """
        return ["sin(q1) = 0 and sin(q2) = 0"]

    text, shown = explained(made(singular))
    assert text.text == "They are:"
    assert {str(equation) for equation in shown.formula.args} == {
        "Eq(sin(q1), 0)",
        "Eq(sin(q2), 0)",
    }
