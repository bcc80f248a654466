"""Notebooks of other markers: whatever stands in them, data or a sentence comes out."""

import json
import re
from pathlib import Path

import pytest
from jails import skip_without
from kinegrade.grader.collecting.ask import Ask, Limits
from kinegrade.grader.collecting.collect import collect
from kinegrade.grader.jail.jail import FOR_MANY, Jail
from kinegrade.grader.jail.level import Level

FOLDER = Path(__file__).parent / "foreign"
NOTEBOOKS = sorted(FOLDER.rglob("*.ipynb"))
ASSIGNED = re.compile(r"^(\w+) *= *[^=]", re.MULTILINE)
DEFINED = re.compile(r"^def (\w+)\(", re.MULTILINE)
DATA = {"num", "text", "expression", "calls"}
SAID = {"missing", "error", "interrupted"}
NOBODYS = "a_name_that_no_notebook_sets"
LIMITS = Limits(cell_seconds=0.5, notebook_seconds=30)
CALLS = ((3.0,), ([1.0, 2.0],))


@pytest.fixture(scope="module")
def jail():
    """One jail for all of them."""
    skip_without(Level.MEDIUM)
    with Jail(level=Level.MEDIUM, preload=FOR_MANY) as jail:
        yield jail


def code_of(path):
    """The code of all cells, as text."""
    cells = json.loads(path.read_bytes()).get("cells", [])
    return "\n".join("".join(cell["source"]) for cell in cells if cell.get("cell_type") == "code")


def asks_of(code):
    """A few of the names that the code sets, and one that it does not."""
    functions = dict.fromkeys(DEFINED.findall(code))
    variables = dict.fromkeys(name for name in ASSIGNED.findall(code) if name not in functions)
    asks = [Ask(name, CALLS) for name in [*functions][:4]]
    return [*asks, *map(Ask, [*variables][:6]), Ask(NOBODYS)]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_a_foreign_notebook_gives_data_or_a_sentence_for_every_name(jail, path):
    asks = asks_of(code_of(path))
    raws = collect(path.read_bytes(), asks, LIMITS, jail=jail)
    assert list(raws) == [ask.name for ask in asks]
    assert raws.pop(NOBODYS).kind in SAID
    for name, raw in raws.items():
        assert raw.kind in DATA | SAID
        is_unanswered = raw.kind == "missing" and f"{name} = ..." in code_of(path)
        assert raw.kind in DATA or raw.value.strip() or is_unanswered, name


def values(jail, name, *asks):
    """What came out of one file."""
    (path,) = FOLDER.rglob(f"{name}.ipynb")
    return collect(path.read_bytes(), asks, LIMITS, jail=jail)


def test_a_function_of_a_foreign_notebook_is_called(jail):
    name = "docs__user_guide__submitted__hacker__ps1__problem1"
    raws = values(jail, name, Ask("squares", ((3,),)), Ask("sum_of_squares", ((4,),)))
    assert raws["squares"].value[0].value.tolist() == [1, 4, 9]
    assert raws["sum_of_squares"].value[0].value == 30


def test_an_endless_cell_of_a_foreign_notebook_costs_only_itself(jail):
    raws = values(jail, "test_grade__timeout__1min", Ask("square", ((2.0,),)), Ask("x"))
    assert raws["square"].kind == "error"
    assert "ran longer than 0.5 s" in raws["square"].value
    assert raws["x"].kind == "num"


def test_a_package_of_another_marker_is_named_and_its_cells_alone_are_lost(jail):
    raws = values(jail, "test_grade__passesAll", Ask("grader"), Ask("square", ((3.0,),)))
    assert "the package otter is not installed" in raws["grader"].value
    assert raws["grader"].absent == "otter"
    assert raws["square"].value[0].value == 9


def test_a_notebook_of_another_language_says_so(jail):
    raws = values(jail, "test_assign__r-correct__student__r-example", Ask("x"))
    assert "kernel for r" in raws["x"].value
