"""Answers that are functions: what they are called with, how groups earn, and where a call cannot be made."""

import json
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from answers import answer_code
from courses import exercise_of, hand_in, handed_out, make_course, marked, notebook
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.proof.validate import validate_file
from kinegrade.course.settings.config import read_course
from kinegrade.course.sheet.submissions import Submission
from kinegrade.course.student.check import check_file
from kinegrade.exercises.exercise import (
    Function,
    Mistake,
    Numbers,
    Outcome,
    Part,
    Results,
    references,
)
from kinegrade.exercises.files.finding import load
from kinegrade.exercises.kinds.arguments import arrived
from kinegrade.grader.collecting.ask import Ask, AskError, Limits
from kinegrade.grader.collecting.collect import collect
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.calls import Group, accepted, counting, share_of_groups
from kinegrade.grader.kinds.markers import handed_in
from kinegrade.grader.marking.mark import mark

ARM = {
    "kinds": ["R", "P"],
    "a": [0.1, 0.2],
    "dh": [[1, 2], [3, 4]],
    "name": "RP",
    "n": 2,
    "tool": {"p": [0.5]},
}
SHAPES = """
def f(x):
    if isinstance(x, dict):
        return str({name: f(value) for name, value in x.items()})
    if isinstance(x, list):
        return str([f(value) for value in x])
    return f"{type(x).__name__} {getattr(x, 'shape', '')} {getattr(x, 'dtype', '')}"
"""
SINGULAR = '''
"""Is a posture of a planar arm singular? Asked as a function, for arms that come as dicts."""
import numpy as np
from kinegrade.exercises.exercise import Exercise, Function, Mistake, Part


def draw(rng):
    def arm(q2):
        return [{"kinds": ["R", "R"], "a": [round(float(x), 3) for x in rng.uniform(0.2, 0.9, 2)]},
                [round(float(rng.uniform(-3, 3)), 3), q2]]
    bent = lambda: round(float(rng.choice([-1, 1]) * rng.uniform(0.3, 2.8)), 3)
    return {"stretched": [arm(0.0) for _ in range(3)], "bent": [arm(bent()) for _ in range(3)],
            "both": [arm(0.0), arm(bent()), arm(bent())]}


def inputs(v):
    return {group: [tuple(pair) for pair in v[group]] for group in ("stretched", "bent", "both")}


def singular(arm, q):
    """1.0 where the arm has lost a direction, else 0.0."""
    first, second = arm["a"]
    return float(abs(first * second * np.sin(q[1])) < 1e-6)


EXERCISE = Exercise(
    slug="singular", title="Singular or not", source="made for tests", draw=draw, units={}, scale=lambda _: 1.0,
    hidden=("stretched", "bent", "both"), statement=lambda v: "A planar arm `arm = {'kinds': ..., 'a': ...}`.",
    parts=(Part("singular_is", "A function that returns 1 where the posture is singular, else 0", 6,
                Function("(arm, q)", inputs), lambda v, given: singular,
                mistakes=(Mistake("It is the other way round.", lambda v, given: lambda *x: 1 - singular(*x)),)),),
)
'''


@pytest.mark.parametrize(
    ("argument", "kept"),
    [
        (0.5, 0.5),
        ("RRP", "RRP"),
        ([1, 2], np.array([1.0, 2.0])),
        ([[1, 2], [3, 4]], np.array([[1.0, 2.0], [3.0, 4.0]])),
        ([], np.array([])),
        ([[1, 2], [3]], [np.array([1.0, 2.0]), np.array([3.0])]),
        (["R", "P"], ["R", "P"]),
        (["1", "2"], ["1", "2"]),
        (["R", 0.5, [1, 2]], ["R", 0.5, np.array([1.0, 2.0])]),
        ((1, 2), np.array([1.0, 2.0])),
        (np.eye(2), np.eye(2)),
        (np.int64(3), 3),
        ({"kinds": ["R"], "a": [0.1]}, {"kinds": ["R"], "a": np.array([0.1])}),
        ([{"a": [[1], [2]]}, {"a": []}], [{"a": np.array([[1.0], [2.0]])}, {"a": np.array([])}]),
    ],
)
def test_numbers_in_equal_rows_arrive_as_arrays_and_all_else_as_it_is(argument, kept):
    assert repr(arrived(argument)) == repr(kept)


@pytest.mark.parametrize(
    "argument", [0.5, 3, True, "RP", [1, 2], [[1, 2], [3]], ["R", 1], [], ARM, [ARM, ARM], [[ARM]]]
)
def test_the_function_of_a_student_gets_what_the_reference_gets(argument):
    scope = {}
    exec(SHAPES, scope)  # noqa: S102 - the text of this test
    found = collect(notebook("import numpy as np", SHAPES), [Ask("f", ((argument,),))])["f"]
    assert [result.value for result in found.value] == [scope["f"](arrived(argument))]


def test_what_a_function_does_to_its_arguments_is_forgotten():
    code = "def f(arm):\n    arm['a'] += 1\n    arm['kinds'].append('R')\n    return [len(arm['kinds']), arm['a'][0]]"
    calls = (({"kinds": ["R"], "a": [0.5]},),) * 2
    found = collect(notebook(code), [Ask("f", calls)])["f"]
    assert [result.value.tolist() for result in found.value] == [[2, 1.5]] * 2


LOOP = []
LOOP.append(LOOP)


@pytest.mark.parametrize(
    ("argument", "words"),
    [
        (None, "f, call 1: an argument takes numbers, text, and lists and dicts of them, got None"),
        (object(), "got <object object"),
        ({"a": None}, "f, call 1, a: an argument takes numbers"),
        ({1: 2}, "a dict takes text as names, such as '1', got 1"),
        (1j, r"got 1j \(complex\)"),
        (np.array([1j]), "takes real numbers"),
        (np.array(["R"]), "takes real numbers"),
        (10**400, "takes real numbers"),
        ([[{1, 2}]], r"got \{1, 2\} \(set\)"),
        (LOOP, "up to 8 lists and dicts inside one another"),
    ],
)
def test_an_argument_that_cannot_be_sent_is_named(argument, words):
    with pytest.raises(AskError, match=words):
        Ask("f", ((argument,),))


def test_a_call_without_its_tuple_is_named():
    with pytest.raises(
        AskError, match=r"call 1: a call takes a tuple of its arguments, such as \(q,\), got 0.5"
    ):
        Ask("f", (0.5,))


# --- groups


def group(wanted, results=None, name="g"):
    arrays = tuple(np.asarray(x, dtype=float) for x in wanted)
    return Group(name, arrays, arrays if results is None else tuple(results))


@pytest.mark.parametrize(
    ("wanted", "right", "counts"),
    [
        ([[1, 1], [0, 0]], [[1, 1], [1, 1]], [True, True]),
        ([[1, 1], [0, 0]], [[1, 1], [0, 0]], [False, False]),  # always 1
        ([[1, 1], [0, 0]], [[1, 1], [0, 1]], [True, False]),  # it told one from the others
        ([[1, 1], [0, 1]], [[1, 1], [0, 1]], [False, False]),
        ([[1, 1], [0, 1]], [[0, 1], [1, 1]], [False, True]),
        ([[1], [0.37]], [[1], [0]], [False, False]),
        ([[0.37], [0.52]], [[1], [0]], [True, False]),  # a result that nobody would guess
        ([[0, 0]], [[1, 1]], [True]),  # nothing can be told apart
        ([[[0, 0], [0, 0, 0]], [[1, 2]]], [[1, 1], [0]], [False, False]),  # zeros of any shape
        ([[np.eye(2), np.eye(3)], [[1, 2]]], [[1, 1], [0]], [False, False]),
        ([[[], []], [[1, 2]]], [[1, 1], [0]], [False, False]),
        ([[[1, 2]], [[3, 4]], [[5, 6]]], [[1], [0], [1]], [True, False, True]),
    ],
)
def test_a_group_counts_when_all_of_it_is_right_and_no_constant_would_be(wanted, right, counts):
    groups = [group(results) for results in wanted]
    assert counting(groups, right) == counts
    assert share_of_groups(groups, right) == np.mean(counts)


def test_a_check_may_judge_groups_or_calls():
    groups = [group([1, 2]), group([3])]
    for right in (
        [True, False],
        np.array([True, False]),
        [[True, True], False],
        ([1, np.True_], [0]),
    ):
        assert accepted(groups, right) == [[True, True], [False]]
    assert accepted(groups, np.True_) == [[True, True], [True]]
    with pytest.raises(ValueError, match="a flag for each of 2 groups, got 3"):
        accepted(groups, [True] * 3)
    with pytest.raises(ValueError, match="takes 2 flags for the calls of g, got 1"):
        accepted(groups, [[True], True])


# --- a function of zeros and ones


@pytest.fixture
def singular(tmp_path):
    """The file of an exercise whose function gets dicts and returns 0 or 1."""
    path = tmp_path / "singular.py"
    path.write_text(SINGULAR, encoding="utf-8")
    return path


def test_a_function_of_zeros_and_ones_is_valid(singular):
    found = validate_file(singular, 25)
    assert found.failures == ()


@pytest.mark.parametrize(
    ("function", "points", "words"),
    [
        ("abs(np.sin(q[1])) < 1e-9", 6, ""),
        ("0", 0, "bent: 3 of 3 right; they count once another result is right"),
        ("1", 0, "stretched: 3 of 3 right; they count once another result is right"),
        ("1 - (abs(np.sin(q[1])) < 1e-9)", 0, "It is the other way round."),
        ("abs(q[1]) < 1e-9 and arm['a'][0] > 10", 0, "stretched: 0 of 3 right"),
        ("abs(q[1]) < 1e-9 or q[1] > 0", 2, "bent: 2 of 3 right"),
        ("arm['lengths']", 0, "gave: KeyError: 'lengths'"),
    ],
)
def test_a_constant_earns_nothing_of_a_function_of_zeros_and_ones(
    singular, function, points, words
):
    exercise = load(singular)
    v = json.loads(json.dumps(exercise.draw(np.random.default_rng(3))))
    (part,) = exercise.asked
    calls = tuple(call for calls in part.answer.inputs(v).values() for call in calls)
    code = f"def singular_is(arm, q):\n    return float({function})"
    raws = collect(notebook("import numpy as np", code), [Ask("singular_is", calls)])
    (verdict,) = mark(exercise, v, raws)
    assert verdict.points == points
    assert words in " ".join(finding.text for finding in verdict.findings)


# --- a part's own check


CALLS = {"near": [([1.0],), ([4.0],)], "far": [([9.0],)]}


def roots(_, __, value):
    """Either root is right: the results of a group are those of its calls, in their order."""
    assert isinstance(value, Results)
    right = []
    for calls, results in zip(CALLS.values(), value.by_group(CALLS).values(), strict=True):
        pairs = zip(calls, results, strict=True)
        right.append(all(not isinstance(y, str) and np.allclose(y**2, x) for (x,), y in pairs))
    return Outcome(right=right, finding="" if all(right) else "Square your results.")


def rooted(**more):
    more = {"check": roots} | more
    return exercise_of(
        Part("t_f", "f?", 4, Function("(x)", lambda _: CALLS), lambda *_: np.sqrt, **more)
    )


def results(*values):
    return Raw(
        "calls",
        [x if isinstance(x, Raw) else Raw("num", np.asarray(x, dtype=float)) for x in values],
    )


@pytest.mark.parametrize(
    ("raw", "points", "words"),
    [
        (results([1], [2], [3]), 4, []),
        (results([-1], [2], [-3]), 4, []),
        (results([1], [2], [4]), 2, ["Square your results."]),
        (
            results(
                [1], Raw("error", "call 2 stopped with ZeroDivisionError: division by zero"), [3]
            ),
            2,
            ["Square your results.", "near: call 2 gave: ZeroDivisionError: division by zero."],
        ),
        (
            results([1], [2], Raw("error", "call 3 ran longer than 5 s and was stopped")),
            2,
            ["far: call 1 ran longer than 5 s and was stopped."],
        ),
        (
            results(
                Raw("error", "call 1: not a matrix of numbers: a dict (TypeError)"), [np.nan], [3]
            ),
            2,
            [
                "near: call 1 gave: not a matrix of numbers: a dict (TypeError) (2 of 2 calls gave no numbers)."
            ],
        ),
        (results([1]), 0, ["near: call 2 gave: no result.", "far: call 1 gave: no result."]),
    ],
)
def test_a_check_judges_group_by_group_and_reasons_reach_the_student(raw, points, words):
    (verdict,) = mark(rooted(), {}, {"t_f": raw})
    assert verdict.points == points
    texts = [finding.text for finding in verdict.findings]
    assert [word for word in words if word not in texts] == []


def test_a_check_that_leaves_it_to_the_comparison_keeps_what_that_says():
    (verdict,) = mark(
        rooted(check=lambda *_: Outcome(finding="Look again.")), {}, {"t_f": results([1], [2], [4])}
    )
    assert (verdict.status, verdict.points) == ("partly", 2)
    said = [finding.text for finding in verdict.findings]
    assert said == [
        "Look again.",
        "near: 2 of 2 right.",
        "far: 0 of 1 right; the first that is not differs in 1 of 1 entries.",
    ]


def test_results_of_published_calls_are_given_group_by_group():
    published = {"yours": [([25.0],)]}
    value = Results((np.array([5.0]),), published=True)
    assert [*value.by_group(published)] == ["yours"]
    assert value.by_group({"a": [(1,)], "b": [(1,), (2,)]}) == {
        "a": (value.values[0],),
        "b": ("no result",) * 2,
    }


def test_a_reference_may_use_arrays_like_its_students():
    def squared(x):
        return x.T @ x  # a list has no transpose

    exercise = exercise_of(
        Part("t_f", "f?", 4, Function("(x)", lambda _: CALLS), lambda *_: squared)
    )
    (part,) = exercise.asked
    (verdict,) = mark(
        exercise, {}, {"t_f": handed_in(part.answer, references(exercise, {})["t_f"], {})}
    )
    assert verdict.points == 4


def test_two_calls_that_differ_deep_inside_a_large_array_are_two_calls():
    first, second = np.zeros(2000), np.zeros(2000)
    second[1000] = 1.0
    calls = {"first": [(first,)], "second": [(second,)]}
    exercise = exercise_of(
        Part("t_f", "f?", 4, Function("(x)", lambda _: calls), lambda *_: lambda x: x.sum() + 2)
    )
    (verdict,) = mark(exercise, {}, {"t_f": results(2, 3)})
    assert verdict.points == 4


# --- calls that cannot be made


UNSENT = '''
"""One part that can be asked for, and one whose calls cannot be made."""
import numpy as np
from kinegrade.exercises.exercise import Exercise, Function, Numbers, Part


def double(x):
    return 2 * x


EXERCISE = Exercise(
    slug="unsent", title="t", source="made for tests", statement=lambda v: "t", scale=lambda _: 1.0, units={"x": "1"},
    draw=lambda rng: {"x": round(float(rng.uniform(0.2, 0.9)), 3)},
    parts=(Part("unsent_x", "3 x", 1, Numbers(()), lambda v, given: 3 * v["x"]),
           Part("unsent_f", "f", 2, Function("(x)", lambda v: {"g": [(v["x"],), (ARGUMENT,)]}), lambda *_: double),
           Part("unsent_h", "h", 3, Function("(x)", lambda v: {"g": [(v["x"],), (0.5,)]}), lambda *_: double)),
)
'''
BOTH = "import numpy as np\ndef unsent_f(x):\n    return 2 * x\ndef unsent_h(x):\n    return 2 * x\nunsent_x = {}"


def unsent(folder, argument, **more):
    course = make_course(folder, exercises=("lever", "unsent"), **more)
    (course / "exercises" / "unsent.py").write_text(
        UNSENT.replace("ARGUMENT", argument), encoding="utf-8"
    )
    return handed_out(course)


def graded(folder):
    course = read_course(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        return {result.student.id: result for result in marked(course, gradebook)}


@pytest.mark.parametrize(
    ("argument", "words"),
    [
        ("np.zeros(2) * 1j", "unsent_f, call 2: an argument takes real numbers"),
        (
            "{1: 2}['x']",
            "The reference answer of this part is no longer the one",
        ),  # nor can it be compared
    ],
)
def test_a_call_that_cannot_be_made_costs_nobody_anything(tmp_path, argument, words):
    """It ended the marking of the whole course."""
    course = unsent(tmp_path, "np.zeros(2)")  # as it was handed out
    text = (tmp_path / "exercises" / "unsent.py").read_text(encoding="utf-8")
    (tmp_path / "exercises" / "unsent.py").write_text(
        text.replace("np.zeros(2)", argument), encoding="utf-8"
    )
    with Gradebook(tmp_path / "gradebook.sqlite") as gradebook:
        drawn = {r.student: r.numbers for r in gradebook.records("one") if r.exercise == "unsent"}
    for student, numbers in drawn.items():
        hand_in(course, student, notebook(BOTH.format(3 * numbers["x"])), "one.ipynb")
    for result in graded(tmp_path).values():
        found = {verdict.part: verdict for verdict in result.verdicts}
        assert (found["unsent_x"].points, found["lever_p"].status) == (1, "missing")
        assert found["unsent_h"].points == 3
        assert (found["unsent_f"].status, found["unsent_f"].points) == ("not_graded", None)
        assert words in found["unsent_f"].findings[0].text


def test_a_check_goes_on_where_a_call_cannot_be_made(tmp_path, monkeypatch):
    path = tmp_path / "unsent.py"
    path.write_text(UNSENT.replace("ARGUMENT", "None"), encoding="utf-8")
    monkeypatch.setattr(
        "kinegrade.course.student.own_exercises.exercise_files", lambda: {"unsent": path}
    )
    for mode, said in (
        ("practice", "not graded yet: Your answer is kept"),
        ("exam", "not checked: unsent_f, call 2"),
    ):
        about = {
            "sheet": "one",
            "mode": mode,
            "exercises": ["unsent"],
            "numbers": {"unsent": {"x": 0.5}},
        }
        (tmp_path / "one.ipynb").write_bytes(notebook(BOTH.format(1.5), about=about))
        _, found = check_file(tmp_path / "one.ipynb")
        texts = {remark.part: remark for remark in found}
        assert texts["unsent_f"].ok
        assert texts["unsent_f"].text.startswith(said)
        assert all(texts[name].ok for name in ("unsent_x", "unsent_h"))


@pytest.mark.parametrize(
    ("argument", "words"),
    [
        (
            "None",
            "an argument takes numbers, text, and lists and dicts of them, got None (NoneType)",
        ),
        ("{1: 2}", "a dict takes text as names"),
    ],
)
def test_validate_finds_a_call_that_cannot_be_made(tmp_path, argument, words):
    path = tmp_path / "unsent.py"
    path.write_text(
        UNSENT.replace("ARGUMENT", argument).replace(
            "return 2 * x", "return 2 * x if isinstance(x, float) else 1.0"
        ),
        encoding="utf-8",
    )
    found = {
        failure.part: failure.sentence
        for failure in validate_file(path, 1).failures
        if failure.kind == "solution"
    }
    assert [*found] == ["unsent_f"]
    assert words in found["unsent_f"]


def test_validate_makes_the_calls_of_every_draw(tmp_path):
    path = tmp_path / "unsent.py"
    text = UNSENT.replace("ARGUMENT", 'None if v["x"] > 0.7 else 0.25')
    text = text.replace("return 2 * x", "return 2 * x if isinstance(x, float) else 1.0")
    path.write_text(text, encoding="utf-8")
    found = [failure for failure in validate_file(path, 20).failures if failure.kind == "solution"]
    assert {failure.part for failure in found} == {"unsent_f"}
    assert 0 < len(found) < 20
    assert found[0].seed > 0
    assert "an argument takes numbers" in found[0].sentence


def test_a_check_with_a_flag_too_few_is_not_the_students_fault():
    exercise = rooted(check=lambda *_: Outcome(right=[True]))
    (verdict,) = mark(exercise, {}, {"t_f": results([1], [2], [3])})
    assert (verdict.status, verdict.points) == ("not_graded", None)


# --- worked solutions that run


HALF = 0.5


def halved(x):
    return HALF * x


def nested(factor):
    def inner(x):
        return [factor * y for y in x]

    return inner


def sound(x, count=3):
    """Everything it takes is here."""

    def helper(y):
        return y + count

    return np.array([helper(y) for y in x] + [sum(len(z) for z in ["a"])])


def annotated(x: Numbers) -> Numbers:
    return x


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (sound, ""),
        (
            halved,
            "the reference function halved uses HALF, which its worked solution does not have",
        ),
        (nested(2), "the reference function inner uses factor, which"),
        (annotated, "uses Numbers, which"),
        (lambda x: x, "takes a def of its own, no lambda"),
        (np.sqrt, "takes a def of its own, no lambda"),
    ],
)
def test_a_name_that_a_worked_solution_lacks_is_named(function, words):
    part = Part("t_f", "f?", 4, Function("(x)", lambda _: CALLS), lambda *_: function)
    reference = references(exercise_of(part), {})["t_f"]
    said = part.answer.unprintable(part.variable, reference)
    assert words in said
    assert bool(said) == bool(words)
    code = answer_code(part, reference)
    assert code.startswith("def t_f(x" if "def of its own" not in words else "# t_f: ")
    compile(code, "<code>", "exec")


def test_an_indented_reference_is_printed_at_the_margin():
    part = Part("t_f", "f?", 4, Function("(x)", lambda _: CALLS), lambda *_: nested(2))
    assert answer_code(part, nested(2)) == "def t_f(x):\n    return [factor * y for y in x]"


def test_validate_runs_the_worked_solution(tmp_path, monkeypatch):
    path = tmp_path / "unsent.py"
    text = UNSENT.replace("ARGUMENT", "0.25")
    path.write_text(text, encoding="utf-8")
    assert validate_file(path, 2).failures == ()
    hidden = text.replace(
        "    return 2 * x", "    from kinegrade.exercises.units import UNITS\n    return 2 * x"
    )
    path.write_text(hidden, encoding="utf-8")
    found = validate_file(path, 2).failures
    assert {(failure.kind, failure.seed, failure.part) for failure in found} == {
        ("solution", 0, "unsent_f"),
        ("solution", 0, "unsent_h"),
    }
    assert "the notebook with the worked solution earns 0.0 of 2" in found[0].sentence
    assert "ModuleNotFoundError" in found[0].sentence


def test_a_mistake_of_a_function_is_still_named():
    mistakes = (Mistake("You forgot the root.", lambda *_: lambda x: x),)
    (verdict,) = mark(rooted(check=None, mistakes=mistakes), {}, {"t_f": results([1], [4], [9])})
    assert "You forgot the root." in [finding.text for finding in verdict.findings]


# --- yes and no


@pytest.mark.parametrize(
    "value", ["x > 1.5", "bool(x > 1.5)", "[x > 1.5]", "np.array([[x > 1.5]])"]
)
def test_yes_and_no_are_one_and_zero(value):
    found = collect(
        notebook("import numpy as np", f"def f(x): return {value}"), [Ask("f", ((1.0,), (2.0,)))]
    )["f"]
    assert [result.value.ravel().tolist() for result in found.value] == [[0.0], [1.0]]


YES = {"yours": [(0.5,), (-0.5,)], "more": [(0.25,)]}


@pytest.mark.parametrize(
    ("name", "data", "points"),
    [
        ("one.json", b'{"t_f": [1, 0, 1]}', 4),
        ("one.json", b'{"t_f": [true, false, true]}', 4),
        ("one.json", b'{"t_f": [[1], [[0]], 1]}', 4),
        ("one.json", b'{"t_f": [1, 1, 1]}', 0),
        ("one.csv", b"t_f 1\n1\nt_f 2\n0\nt_f 3\n1\n", 4),
        ("one.csv", b"t_f 1\n0\nt_f 2\n0\nt_f 3\n0\n", 0),
        ("one.mat", {"t_f": [[1.0], [0.0], [True]]}, 4),
    ],
)
def test_results_that_are_one_number_each_are_read_from_a_file(name, data, points):
    if isinstance(data, dict):
        data = matlab_cells("t_f", [np.array([cell]) for cell in data["t_f"]])
    answer = Function("(x)", lambda _: YES, published=lambda _: YES)
    exercise = exercise_of(Part("t_f", "f?", 4, answer, lambda *_: lambda x: float(x > 0)))
    submission = Submission(Path(name), data)
    (verdict,) = mark(exercise, {}, submission.raws(submission.asks(exercise, {}), Limits()))
    assert verdict.points == points, verdict


def matlab_cells(name, values):
    """The bytes of a .mat file with a cell array."""
    from scipy.io import savemat

    cells = np.empty((1, len(values)), dtype=object)
    cells[0, :] = values
    file = BytesIO()
    savemat(file, {name: cells})
    return file.getvalue()


def test_a_vector_in_a_file_is_the_vector_of_a_function():
    calls = {"yours": [([1.0, 2.0],), ([3.0, 4.0],)]}
    answer = Function("(x)", lambda _: calls, published=lambda _: calls)
    exercise = exercise_of(Part("t_f", "f?", 4, answer, lambda *_: lambda x: 2 * x))
    for name, data in (
        ("one.csv", b"t_f 1\n2, 4\nt_f 2\n6, 8\n"),
        ("one.json", b'{"t_f": [[2, 4], [6, 8]]}'),
    ):
        submission = Submission(Path(name), data)
        (verdict,) = mark(exercise, {}, submission.raws(submission.asks(exercise, {}), Limits()))
        assert verdict.points == 4, verdict
