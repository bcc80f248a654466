"""Notebooks run in a process of their own; a broken cell costs its own answers and nothing else."""

import json
from contextlib import nullcontext
from pathlib import Path

import nbformat
import numpy as np
import pytest
from kinegrade.grader.collecting import ask, wire
from kinegrade.grader.collecting.ask import Ask, AskError, Limits
from kinegrade.grader.collecting.collect import CRASHED, cannot_run, collect
from kinegrade.grader.inside import limits as inside
from kinegrade.grader.inside.marked_run import TOO_LARGE
from kinegrade.grader.jail.jail import best_level
from kinegrade.grader.jail.level import ANY, JailError

LIMITS = Limits(cell_seconds=20, notebook_seconds=60)  # nothing here is a race with the machine
LOOPS = Limits(cell_seconds=1, notebook_seconds=60)


@pytest.fixture(autouse=True, scope="module")
def kept(jail):
    """All notebooks of this file run in one jail."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            "kinegrade.grader.collecting.collect.Jail", lambda *_, **__: nullcontext(jail)
        )
        yield


def notebook(*sources):
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    return nbformat.writes(nbformat.v4.new_notebook(cells=cells)).encode()


def run(*sources, names=("x",), limits=LIMITS):
    return collect(notebook(*sources), [Ask(name) for name in names], limits)


def value(raw):
    assert raw.kind == "num", raw
    return raw.value


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("x = [[1, 2], [3, 4]]", [[1, 2], [3, 4]]),
        ("import numpy as np\nx = np.eye(3, dtype='float32')", np.eye(3)),
        ("import numpy as np\nx = [np.eye(2), np.zeros((2, 2))]", [np.eye(2), np.zeros((2, 2))]),
        ("import numpy as np\nx = np.matrix('1 2; 3 4')", [[1, 2], [3, 4]]),
        (
            "from sympy import Matrix, sqrt, pi, cos\nx = Matrix([[sqrt(3) / 2, cos(pi / 3)]])",
            [[np.sqrt(3) / 2, 0.5]],
        ),
        ("from fractions import Fraction\nx = [Fraction(1, 4), 2]", [0.25, 2]),
        ("x = 7", 7),
        ("x = (1.5, 2)", [1.5, 2]),
        ("import numpy as np\nx = np.eye(4)[::2, ::-1]", np.eye(4)[::2, ::-1]),
        ("x = [1, 2 + 3j]", [1, 2 + 3j]),
        ("x = [float('nan'), 1]", [np.nan, 1]),
        ("%matplotlib inline\nx = 1", 1),
        ("get_ipython().run_line_magic('precision', '3')\nx = 1", 1),
        ("%%time\nx = 3", 3),
        ("print('a' * 10**7)\nx = 2", 2),
        ("import warnings\nwarnings.warn('careful')\nx = 2", 2),
    ],
)
def test_values_come_back_as_a_person_would_mean_them(code, expected):
    np.testing.assert_array_equal(value(run(code)["x"]), expected)


@pytest.mark.parametrize(
    ("code", "kind", "words"),
    [
        ("x = 'cos(q1)'", "text", "cos(q1)"),
        ("x = [['q1', 0, 'a1', 'pi/2']]", "text", "q1"),
        ("from sympy import symbols, cos\nx = cos(symbols('q1'))", "text", "cos(q1)"),
        ("x = {'a': 1}", "error", "a dict"),
        ("x = {'sin(q2) = 0', 'q3 = 0'}", "text", "['q3 = 0', 'sin(q2) = 0']"),
        (
            "from sympy import *\nq = symbols('q')\nx = [Eq(sin(q), 0), Eq(q, 1)]",
            "text",
            "['sin(q) = 0', 'q = 1']",
        ),
        ("x = ('q1', 2, 3.5)", "text", "['q1', '2.0', '3.5']"),
        (
            "import numpy as np\nx = [np.str_('q1'), np.float64(2), 1 + 2j]",
            "text",
            "['q1', '2.0', '(1+2j)']",
        ),
        ("x = {1, 2}", "error", "a set"),
        ("x = 'first\\nsecond'", "text", "first\nsecond"),
        ("x = 'x' * 20_000", "text", "x" * 20_000),
        (
            "x = 'x' * 20_001",
            "error",
            "too long: a text of 20001 characters; 20000 can be read here",
        ),
        ("x = ['x' * 20_001]", "error", "too long: a text of 20001 characters; 20000"),
        ("x = ['x'] * 65", "error", "too long: a list of 65 entries"),
        ("from sympy import *\nq = symbols('q')\nx = Abs(2*sin(q))", "text", "2*Abs(sin(q))"),
        (
            "from sympy import *\np, q = symbols('p q')\nx = [And(Eq(p, 0), Eq(q, 1))]",
            "text",
            "['p = 0 and q = 1']",
        ),
        (
            "from sympy import *\np, q = symbols('p q')\nx = Eq(p, 0) & (Eq(q, 0) | Eq(q, 1))",
            "text",
            "p = 0 and (q = 0 or q = 1)",
        ),
        (
            "from sympy import *\nq = symbols('q')\nx = Matrix([[q + 1, 2]])",
            "text",
            "[['q + 1', '2']]",
        ),
        (
            "from sympy import *\nx = expand((symbols('a') + symbols('b')) ** 999)",
            "error",
            "too long: a text of",
        ),
        (
            "from sympy import *\np, q = symbols('p q')\nx = solve(p*p*(q - 1), [p, q], dict=True)",
            "text",
            "['p = 0', 'q = 1']",
        ),
        (
            "from sympy import *\np, q = symbols('p q')\nx = {p: pi, q: 0.5 - p}",
            "text",
            "p = pi and q = 0.5 - p",
        ),
        (
            "from sympy import *\nq = symbols('q')\nx = [Matrix([[q, 1]]), Matrix([[2, q]])]",
            "text",
            "[[['q', '1']], [['2', 'q']]]",
        ),
        ("x = [[['q', 1.5]]]", "text", "[[['q', '1.5']]]"),
        ("x = {}", "error", "a dict"),
        ("x = lambda q: q", "error", "a function"),
        (
            "x = None",
            "error",
            "None; a function without a return gives it, and simplify() of a Matrix",
        ),
        ("x = [[1, 2], [3]]", "error", "not a matrix"),
        ("x = [True, False]", "error", "not a matrix"),
        ("import numpy as np\nx = np.zeros((100, 100))", "error", "too large"),
        (
            "class A:\n    def __array__(self, *a, **k): raise KeyError\nx = A()",
            "error",
            "not a matrix",
        ),
        ("y = 1", "missing", ""),
        ("x = ...", "missing", ""),
    ],
)
def test_what_is_no_matrix_says_what_it_is(code, kind, words):
    raw = run(code)["x"]
    assert raw.kind == kind
    assert words in str(raw.value)


@pytest.mark.parametrize(
    ("data", "memory_mb"),
    [
        (b'{"cells": [], "x": [' + b"{}," * 8_000_000 + b"{}]}", 512),
        ('{"cells": [], "x": "😀'.encode() + b"y" * (64 << 20) + b'"}', 384),
    ],
)
def test_a_file_that_takes_too_much_memory_to_be_read_says_so(data, memory_mb):
    limits = Limits(cell_seconds=20, notebook_seconds=60, memory_mb=memory_mb)
    found = collect(data, [Ask("x")], limits)["x"]
    assert (found.kind, found.value) == ("error", TOO_LARGE)


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("x = [1, 2", "is not Python"),
        ("x = 1 / 0", "ZeroDivisionError"),
        ("while True:\n    x = None", "ran longer than 1 s"),
        ("try:\n    while True: pass\nexcept Exception:\n    pass\nx = 1", "ran longer"),
        ("x = undefined_name", "undefined_name"),
        ("y = x = 1 / 0", "ZeroDivisionError"),
        ("if True:\n    x, y = (1, 2, 3)", "ValueError"),
        ("y = x = [1, 2", "is not Python"),
        ("import sys\nx = sys.exit(3)", "SystemExit"),
        ("x = 'a' * 10**11", "more memory"),
        (
            "from kinegrade.solutions.jacobian import jacobian\nx = jacobian(1)",
            "kinegrade is not inst",
        ),
        ("%cython\nx = 2", "the magic %cython is not run when a sheet is marked"),
    ],
)
def test_a_failing_cell_costs_its_own_answer_and_says_why(code, words):
    found = run("a = 1", code, "b = 2", names=("a", "x", "b"), limits=LOOPS)
    assert value(found["a"]) == 1
    assert value(found["b"]) == 2
    assert found["x"].kind == "error"
    assert words in found["x"].value
    assert "ell 2" in found["x"].value


@pytest.mark.parametrize(
    "code",
    [
        "import os\nos._exit(0)",
        "from signal import *\nfor bell in (SIGALRM, SIGPROF): signal(bell, SIG_IGN)\nwhile True: pass",
        "import ctypes\nctypes.string_at(0)",
    ],
)
def test_a_cell_that_ends_or_blocks_the_process_leaves_the_earlier_answers(code):
    found = run(
        "a = 1",
        f"b = 3\n{code}",
        names=("a", "b", "c"),
        limits=Limits(cell_seconds=1, notebook_seconds=4),
    )
    assert value(found["a"]) == 1
    assert found["c"].kind in ("error", "interrupted")  # the latter on a machine that is busy
    reasons = (
        "stopped after 4 s",
        "after 4 s the notebook had",
        "ended its own process",
        "crashed",
    )
    assert any(reason in found["c"].value for reason in reasons)


def test_a_value_that_loops_while_it_is_read_costs_only_itself():
    code = "class A:\n    def __array__(self, *a, **k):\n        while True: pass\nx = A()"
    found = run("a = 1", code, "b = 2", names=("a", "x", "b"), limits=LOOPS)
    assert (found["x"].kind, value(found["a"]), value(found["b"])) == ("error", 1, 2)


def test_a_cell_that_only_waits_is_stopped_too():
    found = run("import time\ntime.sleep(600)\nx = 1", "y = 2", names=("x", "y"), limits=LOOPS)
    assert "ran longer" in found["x"].value
    assert value(found["y"]) == 2


def test_thousands_of_nested_folders_are_cleared_away(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    run("import os\nfor _ in range(3000):\n    os.mkdir('d')\n    os.chdir('d')\nx = 1")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "line", ["%pip install scipy", "!pip install scipy", "%reset -f", "%load_ext autoreload"]
)
def test_an_installation_before_an_import_costs_nothing(line):
    assert value(run(f"{line}\nimport numpy as np\ny = 2", "x = np.float64(y)")["x"]) == 2


def test_numpy_is_there_even_when_the_first_cell_fails():
    assert value(run("import no_such_package\nimport numpy as np", "x = np.eye(2)")["x"]).shape == (
        2,
        2,
    )


def test_a_long_error_costs_no_more_than_its_end():
    found = run("raise ValueError('e' * 999)", "y = 1\nx = z", "y = x", names=("x", "y"))
    assert value(found["y"]) == 1
    assert found["x"].kind == "error"
    assert len(found["y"].note) <= 400


def test_an_error_that_follows_from_an_earlier_cell_names_that_cell():
    said = run("from numpy import no_such_name\na = 1", "x = a")["x"].value
    assert "cell 2 stopped with NameError" in said
    assert "before that, cell 1 stopped with ImportError" in said


def test_a_cell_that_stops_half_way_leaves_its_value_and_says_so():
    half = "x = [0.0, 0.0]\nx[0] = 1.0\nx[2] = 1.0"
    found = run(half)["x"]
    assert value(found).tolist() == [1, 0]
    assert "cell 1 stopped with IndexError" in found.note
    assert run(half, "x = [1.0, 2.0]")["x"].note == ""


@pytest.mark.parametrize(
    "data", [b'{"cells": []}', b'{"cells": [{"cell_type": "markdown", "source": ""}]}']
)
def test_a_notebook_without_code_is_unanswered(data):
    assert collect(data, [Ask("x")], LIMITS)["x"].kind == "missing"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "it is empty"),
        (b"<!doctype html>", "it is a web page"),
        (
            b"import numpy as np\nx = np.eye(3)\n",
            "it is Python code; hand it in with the ending .py",
        ),
        (b"# my answers\n\nx = 3\n", "it is Python code"),
        (b"dear teacher", "Expecting value"),
        (b"hello", "Expecting value"),
        (notebook("x = 1")[:25], "it breaks off before its end; save the notebook and"),
        (notebook("x = 1")[:-4], "it breaks off"),
        (notebook("x = 'a long text'")[:70], "it breaks off"),
        (b'{"cells": [}', "Expecting value"),
    ],
)
def test_a_file_that_is_no_notebook_says_what_it_is(data, words):
    assert words in collect(data, [Ask("x")], LIMITS)["x"].value


def test_an_array_of_formulas_is_text():
    found = run("import numpy as np\nx = np.array([['q1', 'd1'], ['q2', 0]], dtype=object)")["x"]
    assert (found.kind, found.value[0]) == ("text", ["q1", "d1"])


def test_the_process_has_a_clean_environment_and_an_empty_folder(monkeypatch):
    monkeypatch.setenv("SECRET_OF_THE_GRADER", "42")
    found = run(
        "import os\nenv = sorted(os.environ)\nfiles = os.listdir()\nleak = [k for k in env if 'SECRET' in k]\n"
        "x = [len(leak), len(files)]"
    )
    np.testing.assert_array_equal(value(found["x"]), [0, 0])


def test_no_answer_stands_in_the_students_process():
    code = "import sys\nx = [sum(name.startswith('kinegrade') and bool(sys.modules[name]) for name in sys.modules)]"
    np.testing.assert_array_equal(value(run(code)["x"]), [0])


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"not json",
        b"\xff\xfe\x00",
        b"[]",
        b"{}",
        b'{"cells": 3}',
        b'{"cells": [{"cell_type": "code"',
        b"[" * 100_000,
        b'{"cells": [1, null, {"cell_type": "code", "source": 5}, {"cell_type": "raw"}]}',
    ],
)
def test_what_is_no_notebook_is_an_error_with_a_sentence_or_simply_unanswered(data):
    raw = collect(data, [Ask("x")], LIMITS)["x"]
    assert raw.kind in ("error", "missing")
    assert raw.kind == "missing" or "notebook" in raw.value


def test_a_byte_order_mark_before_a_notebook_is_skipped():
    assert value(collect(b"\xef\xbb\xbf" + notebook("x = 1"), [Ask("x")], LIMITS)["x"]) == 1


def test_an_old_notebook_with_worksheets_is_read():
    old = {
        "worksheets": [{"cells": [{"cell_type": "code", "input": ["x = ", "5"]}]}],
        "nbformat": 3,
    }
    assert value(collect(json.dumps(old).encode(), [Ask("x")], LIMITS)["x"]) == 5


def test_outputs_are_dropped_before_the_size_is_judged():
    content = json.loads(notebook("x = 1"))
    content["cells"][0]["outputs"] = [{"output_type": "stream", "text": "x" * (26 << 20)}]
    assert value(collect(json.dumps(content).encode(), [Ask("x")])["x"]) == 1
    said = collect(notebook("#" * (5 << 20)), [Ask("x")])["x"].value
    assert said == "its code cells hold 5 million characters; a notebook may have 4 million"


def test_a_notebook_that_writes_to_every_descriptor_spoils_only_itself():
    code = "import os\nfor fd in range(3, 64):\n    try: os.write(fd, b'\\xff' * 64)\n    except OSError: pass\nx = 1"
    assert run(code)["x"].kind in ("error", "missing")
    assert value(run("x = 1")["x"]) == 1


def test_monkeypatched_numpy_changes_nothing_that_is_decided_outside():
    code = "import numpy as np\nnp.allclose = np.array_equal = lambda *a, **k: True\nx = np.zeros((6, 3))"
    np.testing.assert_array_equal(value(run(code)["x"]), np.zeros((6, 3)))


def test_no_file_descriptor_leaks():
    run("x = 1")
    before = len(list(Path("/proc/self/fd").iterdir()))
    for _ in range(3):
        run("x = 1")
    assert len(list(Path("/proc/self/fd").iterdir())) <= before


def call(*sources, calls=((1.0,), ([1, 2],), ("ab",)), limits=LIMITS):
    return collect(notebook(*sources), [Ask("f", calls)], limits)["f"]


def results(raw):
    assert raw.kind == "calls", raw
    return [x.value.tolist() if x.kind == "num" else x.value for x in raw.value]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("def f(x): return x", [1, [1, 2], "ab"]),
        ("def f(x):\n    x *= 2\n    return x", [2, [2, 4], "abab"]),
        ("f = lambda x: [x, x]", [[1, 1], [[1, 2], [1, 2]], ["ab", "ab"]]),
        ("class F:\n    def __call__(self, x): return 1j\nf = F()", [1j, 1j, 1j]),
        ("def f(x):\n    print(x)\n    return np.matrix([1, 2])", [[[1, 2]]] * 3),
        (
            "from sympy import Matrix, pi, sqrt\ndef f(x): return Matrix([sqrt(4), 1])",
            [[[2], [1]]] * 3,
        ),
        ("from sympy import symbols\ndef f(x): return symbols('q1') + 1", ["q1 + 1"] * 3),
        ("import json\njson.dumps = None\ndef f(x): return 1", [1, 1, 1]),
    ],
)
def test_a_function_is_called_on_everything_that_is_asked(code, expected):
    assert results(call(code)) == expected


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (
            "if isinstance(x, str): raise ValueError('no text')",
            "call 3 stopped with ValueError: no text",
        ),
        ("return None if isinstance(x, str) else x", "call 3: not a matrix of numbers: None"),
        ("return {'a': 1} if isinstance(x, str) else x", "call 3: not a matrix of numbers: a dict"),
        ("return ... if isinstance(x, str) else x", "call 3 returned ..."),
        ("import sys\n    if isinstance(x, str): sys.exit()", "call 3 stopped with SystemExit"),
        ("while isinstance(x, str): pass", "call 3 ran longer than 1 s and was stopped"),
        ("return np.zeros((99, 99)) if isinstance(x, str) else x", "call 3: too large"),
        ("import os\n    if isinstance(x, str): os._exit(0)", "the notebook ended its own process"),
    ],
)
def test_a_call_that_fails_costs_only_itself(body, words):
    first, second, third = results(call(f"def f(x):\n    {body}\n    return x", limits=LOOPS))
    assert (first, second) == (1, [1, 2])
    assert words in third


def test_an_error_that_loops_while_it_is_told_costs_only_its_words():
    code = (
        "class E(Exception):\n    def __str__(self):\n        while True: pass\ndef f(x): raise E"
    )
    assert results(call(code))[2] == "call 3 stopped with E"


@pytest.mark.parametrize("name", ["\\x1b[2J", "\\u202e", "", "a b"])
def test_an_error_whose_class_has_no_name_is_told_without_it(name):
    raised = f"class E(Exception): pass\nE.__name__ = '{name}'\nx = 1\nraise E"
    assert collect(notebook(raised), [Ask("x")], LOOPS)["x"].note == "cell 1 stopped with an error"


def test_an_answer_that_never_becomes_an_array_took_too_long():
    code = "class E:\n    def __array__(self, *a, **k):\n        while True: pass\nx = E()"
    found = collect(notebook(code), [Ask("x")], LOOPS)["x"]
    assert found.value == f"could not be read (it took longer than {LOOPS.cell_seconds:g} s)"


def test_python_that_crashed_is_not_called_a_notebook_that_ended_itself():
    crash = notebook("x = 1", "import ctypes\nctypes.string_at(0)", "y = 2")
    assert collect(crash, [Ask("y")])["y"].value == CRASHED


def test_every_call_gets_lists_of_its_own():
    code = "seen = []\ndef f(x):\n    x[:] = 7\n    seen.append(x)\n    return [x is y for y in seen].count(True)"
    assert results(call(code, calls=(([1, 2],), ([1, 2],)))) == [1, 1]


def test_arguments_arrive_as_they_were_asked():
    code = (
        "def f(*x):\n"
        '    return [f\'{type(y).__name__} {getattr(y, "dtype", "")} {getattr(y, "shape", "")}\' for y in x]'
    )
    calls = ((1, 1.0, "R", [], [[1, 2]], np.eye(2)),)
    said = [
        "int  ",
        "float  ",
        "str  ",
        "ndarray float64 (0,)",
        "ndarray float64 (1, 2)",
        "ndarray float64 (2, 2)",
    ]
    assert results(call(code, calls=calls)) == [said]


@pytest.mark.parametrize("wait", ["while True: pass", "time.sleep(600)"])
def test_forty_calls_without_end_do_not_take_forty_times_as_long(wait):
    code = f"import time\ndef f(x):\n    if x != 30:\n        {wait}\n    return x"
    limits = Limits(
        cell_seconds=1, notebook_seconds=30
    )  # forty times a second, twice, would not end in this
    found = results(call(code, "a = 1", calls=tuple((float(i),) for i in range(40)), limits=limits))
    assert found[30] == 30
    assert sum("ran longer" in str(said) for said in found) == 39


def test_helpers_that_are_defined_later_count():
    assert results(call("def f(x): return g()", "def g(): return 5")) == [5, 5, 5]


def test_results_stay_when_a_later_cell_ends_the_process_or_breaks_the_function():
    for later in ("import os\nos._exit(0)", "del g", "while True: pass"):
        assert results(call("def g(): return 5\ndef f(x): return g()", later, limits=LOOPS)) == [
            5,
            5,
            5,
        ]


def test_a_function_that_is_defined_again_starts_again():
    assert (
        "stopped with ZeroDivisionError"
        in results(call("def f(x): return 5", "def f(x): return 1 / 0"))[0]
    )


def test_a_cell_that_stops_behind_its_function_says_so_beside_the_results():
    raw = call("def f(x): return 5\n1 / 0")
    assert results(raw) == [5, 5, 5]
    assert "cell 1 stopped with ZeroDivisionError" in raw.note


def test_a_list_of_results_may_stand_in_the_place_of_a_function():
    assert call("f = [[1, 2], [3, 4]]").value.tolist() == [[1, 2], [3, 4]]
    raw = call("f = [[1, 2], [[1, 2], [3, 4]], None]")
    assert raw.listed
    assert [result.kind for result in raw.value] == ["num", "num", "error"]
    assert call("f = 'text'").kind == "text"
    assert call("f = [None, None]").kind == "error"
    assert call("g = 1").kind == "missing"
    assert (
        call("f = lambda x: x", calls=()).value == "not a matrix of numbers: a function (TypeError)"
    )


def test_too_many_calls_are_refused():
    with pytest.raises(AskError, match="at most 200 calls"):
        Ask("f", ((1.0,),) * 201)


def test_answers_that_are_too_much_together_cost_the_largest():
    code = "x = [['\\u0394' * 400] * 64] * 20\ny = 1"
    found = run(code, names=("x", "y"))
    assert "too large to be marked together" in found["x"].value
    assert value(found["y"]) == 1


def test_a_text_that_is_slow_to_print_is_tried_once():
    code = "class A:\n    free_symbols = {1}\n    def __str__(self):\n        while True: pass\nx = A()"
    limits = Limits(
        cell_seconds=0.5, notebook_seconds=15
    )  # forty times half a second would not end in this
    found = run(code, *["a = 1"] * 40, "y = 1", names=("x", "y"), limits=limits)
    assert "could not be read (it took longer than 0.5 s)" in found["x"].value
    assert value(found["y"]) == 1


@pytest.mark.parametrize("name", ["MAX_ELEMENTS", "MAX_ROWS", "MAX_SAID", "MAX_TEXT", "MAX_CALLS"])
def test_the_students_process_has_the_limits_of_the_wire(name):
    assert getattr(inside, name) == (getattr(wire, name, None) or getattr(ask, name))


def test_where_notebooks_cannot_run_a_sentence_says_so(monkeypatch):
    monkeypatch.setattr("sys.platform", "darwin")
    assert "notebooks are marked on Linux" in cannot_run()
    with pytest.raises(JailError, match="notebooks are marked on Linux"):
        best_level(ANY)


def test_sympy_with_the_dust_of_floats_is_read_as_meant():
    code = "import sympy as sp\nq1 = sp.Symbol('q1')\nx = sp.Matrix([[sp.sin(q1) * np.cos(np.pi / 2), sp.cos(q1)]])"
    assert collect(notebook("import numpy as np", code), [Ask("x")])["x"].value == [
        ["0", "cos(q1)"]
    ]
