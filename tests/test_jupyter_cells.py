"""Cells run as Jupyter runs them, and what is no code cell says so."""

import json

import nbformat
import pytest
from kinegrade.grader.collecting.ask import Ask, Limits
from kinegrade.grader.collecting.collect import collect
from kinegrade.grader.jail.jail import FOR_ONE, Jail
from kinegrade.grader.jail.level import ANY

LIMITS = Limits(cell_seconds=20, notebook_seconds=60)


def notebook(*sources, **metadata):
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    made = nbformat.v4.new_notebook(cells=cells, metadata=metadata)
    return nbformat.writes(made).encode()


@pytest.fixture
def run(jail):
    def run(*sources, beside=None, **metadata):
        data = notebook(*sources, **metadata)
        return collect(data, [Ask("x")], LIMITS, jail=jail, beside=beside)["x"]

    return run


RUNS = [
    ("    y = 1\n    x = y + 1", 2),
    (">>> y = 2\n>>> x = y", 2),
    ("In [3]: x = 2", 2),
    ("np.cross?\nx = 2", 2),
    ("?np.cross\nx = 2", 2),
    ("np.cross??\nx = 2", 2),
    ("%env A=3\nimport os\nx = int(os.environ['A'])", 3),
    ("%whos\nx = 2", 2),
    ("y = %pwd\nx = len(y) > 0 and 2", 2),
    ("files = !ls\nx = len(files)", 0),
    ("%%capture said\nprint(1)\nx = 2", 2),
    ("%clear\n%hist\n%mkdir figures\nx = 2", 2),
    ("y = 1\nnames = %who_ls\nx = names.count('y') * 2", 2),
    ("get_ipython().run_cell_magic('HTML', '', '<b>')\nx = 2", 2),
    ("%%writefile two.py\nx = 2\n%run two.py", None),
    ("%time x = 2", 2),
    ("%timeit -n 10 -r 3 sum([1])\nx = 2", 2),
    ("%%timeit\nx = 2", 2),
    ("import asyncio\nawait asyncio.sleep(0)\nx = 2", 2),
    ("import asyncio\nasync def f(): return 2\nx = await f()", 2),
    ("async def f(): return 2\nfor _ in range(2):\n    x = await f()", 2),
    ("display(np.eye(2))\nfrom IPython.display import display, Math\ndisplay(Math('x'))\nx = 2", 2),
    (
        "from IPython import get_ipython\nget_ipython().run_line_magic('matplotlib', 'inline')\nx = 2",
        2,
    ),
    ("import sympy as sp\nsp.init_printing()\nx = sp.sqrt(4)", 2),
    ("from __future__ import annotations\ndef f(a: nothing): return 2\nx = f(1)", 2),
    ("'''\n%time\n!ls\n'''\nx = 2", 2),
    ("x = 2;", 2),
    ("#!ls\nx = 2  # what?", 2),
    ("x = '50 %d' % 1 and 2", 2),
    ("import threading\nt = threading.Thread(target=print)\nt.start()\nt.join()\nx = 2", 2),
]


@pytest.mark.parametrize(("source", "expected"), RUNS)
def test_a_cell_runs_as_in_jupyter(run, source, expected):
    found = run(source)
    if expected is None:
        assert found.kind == "missing"
    else:
        assert found.value == expected, found


@pytest.mark.parametrize("source", [source for source, expected in RUNS if expected == 2][:12])
def test_a_zygote_that_has_not_loaded_ipython_runs_the_same(source):
    with Jail(ANY, preload=FOR_ONE) as jail:
        assert collect(notebook(source), [Ask("x")], LIMITS, jail=jail)["x"].value == 2


@pytest.mark.parametrize(
    ("cells", "expected"),
    [
        (("2 + 3", "x = _"), 5),
        (("%%writefile two.py\ny = 7", "%run two.py", "x = y"), 7),
        (("%%writefile two.py\ny = 7", "import two\nx = two.y"), 7),
        (("pip install scipy", "x = 2"), 2),
        (("whos = 3", "x = whos"), 3),
        (("%%capture --no-stderr said\ny = 1", "said()\nx = 2"), 2),
        (("%%capture said --no-stderr\ny = 1", "said()\nx = 2"), 2),
        (("f = 1", "x = 2\nf?"), 2),
        (
            (
                "%matplotlib inline\nimport matplotlib.pyplot as plt\nplt.plot([1, 2])\nplt.show()",
                "x = len(plt.get_fignums())",
            ),
            0,
        ),
        (
            (
                "import matplotlib.pyplot as plt\nplt.savefig('a.png')",
                "import os\nx = os.path.exists('a.png') * 2",
            ),
            2,
        ),
    ],
)
def test_what_a_cell_leaves_is_there_in_the_next(run, cells, expected):
    assert run(*cells).value == expected


def test_numpy_draws_other_numbers_in_every_notebook():
    data = notebook("x = np.random.rand(4)")
    with Jail(ANY, preload=("numpy", "numpy.random")) as jail:
        first, second = (collect(data, [Ask("x")], LIMITS, jail=jail)["x"] for _ in range(2))
    assert (first.value != second.value).all()


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("x = input('q1? ')", "input() has nobody to ask when a sheet is marked"),
        ("%%R\nx = 2", "the magic %%R is not run when a sheet is marked"),
        (
            "import matplotlib\nmatplotlib.use('TkAgg')\nimport matplotlib.pyplot\nx = 2",
            "ImportError",
        ),
        ("x = [1, 2", "cell 1 is not Python"),
        ("whos = x = [1, 2", "cell 1 is not Python"),
        ("import numpy.no_such_part\nx = 2", "No module named 'numpy.no_such_part'"),
    ],
)
def test_what_cannot_run_says_why(run, source, words):
    found = run(source)
    assert found.kind == "error"
    assert words in found.value


@pytest.mark.parametrize(
    ("cells", "expected"),
    [
        (
            (
                "import numpy as np\nimport no_such as ns\nfrom fractions import Fraction",
                "x = Fraction(2)",
            ),
            2,
        ),
        (("from no_such import a, b\ny = 2", "x = y"), 2),
        (("import no_such.part", "x = 2"), 2),
        (("try:\n    import no_such\nexcept ImportError:\n    x = 2",), 2),
    ],
)
def test_a_package_that_is_absent_does_not_cost_what_does_not_need_it(run, cells, expected):
    assert run(*cells).value == expected


@pytest.mark.parametrize(
    "cells",
    [
        ("import no_such as ns\nx = ns.eye(2)",),
        ("import no_such as ns", "x = ns.eye(2)"),
        ("from no_such.part import f", "x = f(2)"),
        ("from no_such import pi", "x = 2 * pi"),
        ("from no_such import x",),
        ("def f():\n    import no_such", "x = f()"),
        ("import no_such as ns\nns.set()\nn = 3", "x = n + 1"),
    ],
)
def test_a_package_that_is_absent_is_named_where_it_is_used(run, cells):
    found = run(*cells)
    assert (found.kind, found.absent) == ("error", "no_such")
    assert "no_such" in found.value


def test_files_beside_a_notebook_are_there_as_copies(run):
    beside = {"rows.csv": b"1,2\n3,4\n", "mine.py": b"def double(a): return 2 * a\n"}
    source = "import mine\nx = mine.double(np.loadtxt('rows.csv', delimiter=','))"
    assert run(source, beside=beside).value.tolist() == [[2, 4], [6, 8]]
    assert run("import os\nx = len(os.listdir())").value == 0


def with_prose(kind, source, code=("y = 1",)):
    content = json.loads(notebook(*code))
    content["cells"].append({"cell_type": kind, "metadata": {}, "source": source})
    return json.dumps(content).encode()


R = {"kernelspec": {"name": "ir", "display_name": "R", "language": "R"}}


@pytest.mark.parametrize(
    ("data", "hint"),
    [
        (with_prose("markdown", "x = [1, 2]"), "a Markdown cell assigns x; an answer takes a code"),
        (with_prose("raw", "text\n  x = 2"), "a Raw cell assigns x"),
        (with_prose("markdown", "if x == 2 then"), ""),
        (with_prose("markdown", "the value of y = 2"), ""),
        (with_prose("markdown", "x = [1, 2]", code=("x = ...",)), "a Markdown cell assigns x"),
        (with_prose("raw", "x = 2", code=("x = ...", "y = 1")), "a Raw cell assigns x"),
        (with_prose("markdown", "# Title", code=()), "the notebook has no code cells"),
        (notebook("y <- 2", **R), "the notebook has a kernel for r; a sheet takes Python"),
        (notebook("x = ...", **R), "the notebook has a kernel for r; a sheet takes Python"),
        (notebook("x = ..."), ""),
        (notebook("y = 2", language_info={"name": "ipython"}), ""),
    ],
)
def test_what_is_missing_has_a_hint_where_the_file_gives_one(jail, data, hint):
    found = collect(data, [Ask("x")], LIMITS, jail=jail)["x"]
    assert found.kind == "missing"
    assert found.value.startswith(hint)
    assert bool(found.value) == bool(hint)
