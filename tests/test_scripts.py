"""A .py file is run as a notebook is: by its blocks or its statements, and one error costs little."""

import pytest
from kinegrade.grader.collecting.ask import Ask, Limits
from kinegrade.grader.collecting.collect import collect

LIMITS = Limits(cell_seconds=1, notebook_seconds=60)
PERCENT = """\
# A heading

# %% [markdown]
# y = 7

# %%
a = 2
1 / 0
x = 1

#%% with a title
text = '''
# %% no block
'''
y = a
"""


@pytest.fixture
def run(jail):
    def run(source, *names, beside=None, calls=()):
        asks = [Ask(name) for name in names or ("x",)]
        if calls:
            asks.append(Ask("f", calls))
        data = source if isinstance(source, bytes) else source.encode()
        raws = collect(data, asks, LIMITS, jail=jail, beside=beside, script="one.py")
        return [*raws.values()]

    return run


@pytest.mark.parametrize(
    "source",
    [
        "x = 2",
        "\ufeffx = 2",
        "x = 1\r\nx = 2\r\n",
        "import numpy as np\n\n\ndef f():\n    return 2\n\n\nx = f()",
        "def main():\n    global x\n    x = 2\n\nif __name__ == '__main__':\n    main()",
        "import sys\nx = 2 if sys.argv == ['one.py'] else 0",
        "import os\nx = 2 if os.path.basename(__file__) == 'one.py' else 0",
        "%matplotlib inline\nx = 2",
        "get_ipython().run_line_magic('matplotlib', 'inline')\n# In[2]:\nx = 2",
        "1 / 0\nx = 2",
        "while True: pass\nx = 2",
        "raise SystemExit\nx = 2",
        "x = 1; x = 2",
        "x = [1,\n     2,\n][1]",
        "x = 2\ny = [1, 2\n",
        "y = 'open\nx = 2",
        "for i in range(3)\n    y = i\nx = 2",
        "if True:\n    y = 1\nelse\n    y = 2\nx = 2",
        "y = f(\n\nx = 2",
        "y = 1 +\n@staticmethod\ndef g():\n    return 2\nx = g()",
        "return 3\nx = 2",
        "from __future__ import annotations\ndef f(a: nothing): return 2\nx = f(1)",
    ],
)
def test_a_script_runs_and_one_error_costs_only_what_it_sets(run, source):
    (raw,) = run(source)
    assert raw.kind == "num", raw
    assert raw.value == 2


def test_blocks_are_cells_and_an_error_costs_the_rest_of_its_block(run):
    x, y = run(PERCENT, "x", "y")
    assert x.value == "line 8 stopped with ZeroDivisionError: division by zero"
    assert y.value == 2


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("a = 1\n\nx = [1, 2\n", "line 3 is not Python: '[' was never closed"),
        ("# %%\n\nx = (1, 2]\n", "line 3 is not Python: closing parenthesis"),
        ("a = 1\nx = (\n    a\n    / 0)", "line 3 stopped with ZeroDivisionError"),
        ("def f():\n    return 1 / 0\n\nx = f()", "line 4 stopped with ZeroDivisionError"),
        ("x = input('q1? ')", "line 1 stopped with RuntimeError: input() has nobody to ask"),
        ("x = b'\xff'".encode("latin-1"), "the file is not Python: it is not UTF-8 text"),
        ("x = 1\0", "the file is not Python: it holds null characters"),
        ("x = 1\nwhile True: x", None),
        ("while True: x = 1", "line 1 ran longer than 1 s and was stopped"),
        ("x = no", "line 1 stopped with NameError: name 'no' is not defined"),
        ("a = 1 / 0\nx = a", "before that, line 1 stopped with ZeroDivisionError"),
    ],
)
def test_what_cannot_run_is_named_with_its_line(run, source, words):
    (raw,) = run(source)
    if words is None:
        assert raw.value == 1
    else:
        assert words in str(raw.value) + raw.note


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("def main():\n    x = 2\n\nmain()", "x is set inside of the function main"),
        ("# x = 2", "a comment assigns x; comments are not run"),
        ("", "the file has no code"),
        ("y = 2", ""),
    ],
)
def test_why_an_answer_is_missing_is_said_where_the_file_tells(run, source, words):
    (raw,) = run(source)
    assert raw.kind == "missing"
    assert words in raw.value
    assert bool(words) == bool(raw.value)


def test_functions_of_a_script_are_called_as_those_of_a_notebook(run):
    _, raw = run("def f(q):\n    return 2 * q", calls=(([1.0, 2.0],), ([0.5],)))
    assert [result.value.tolist() for result in raw.value] == [[2, 4], [1]]


def test_modules_beside_a_script_are_imported(run):
    (raw,) = run("from arm import TWO\nx = TWO", beside={"arm.py": b"TWO = 2"})
    assert raw.value == 2


def test_hundreds_of_statements_and_of_mistakes_end(run):
    (raw,) = run("\n".join([*(f"a{i} = {i}" for i in range(300)), "x = 2"]))
    assert raw.value == 2
    (raw,) = run("\n".join([*(f"a{i} = (" for i in range(60)), "x = 2"]))
    assert raw.value == 2
    (raw,) = run("\n".join([*(f"a{i} = )" for i in range(60)), "x = 2"]))
    assert raw.value == "line 21 is not Python: unmatched ')'"
