"""One reader of numbers: what a cell of a file is, typed text is too, and what is refused is refused everywhere."""

import json
import math

import numpy as np
import pytest
from kinegrade.exercises.exercise import Numbers
from kinegrade.exercises.kinds.table import TableOf
from kinegrade.grader.collecting.ask import Ask
from kinegrade.grader.collecting.named_matrices import from_csv, from_json
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.markers import read
from kinegrade.grader.reading.unreadable import Unreadable
from kinegrade.solutions.plain_number import plain_number

GOOD = {"1": 1.0, "+1.5": 1.5, "-2.": -2.0, ".5": 0.5, "1e3": 1000.0, "1E-3": 0.001, "007": 7.0}
REFUSED = {
    "1_000": "a number takes no '_' between its digits",
    "1_0.5": "a number takes no '_' between its digits",
    "1.0_0": "a number takes no '_' between its digits",
    "١٢": "numbers take the digits 0 to 9, got '١'",
    "１": "numbers take the digits 0 to 9, got '１'",
    "٣.٥": "numbers take the digits 0 to 9, got '٣'",
    "1e٣": "e",
    "0x1f": "x1f",
    "1_": "a number takes no '_' between its digits",
}
NUMBER = Numbers((), "m")
ASK = [Ask("x")]


def ways(text):
    """The text in a cell, in a JSON string, and as a notebook would hold it."""
    return {
        "csv": from_csv(f"x\n{text}\n".encode(), ASK)["x"],
        "json": from_json(json.dumps({"x": text}).encode(), ASK)["x"],
        "typed": Raw("text", text),
    }


@pytest.mark.parametrize("text", GOOD)
def test_a_number_is_the_same_wherever_it_is_written(text):
    assert plain_number(text) == GOOD[text]
    assert {
        name: float(read(NUMBER, raw, {})) for name, raw in ways(text).items()
    } == dict.fromkeys(ways(text), GOOD[text])


@pytest.mark.parametrize("text", REFUSED)
@pytest.mark.parametrize("way", ["csv", "json", "typed"])
def test_what_is_no_number_is_refused_everywhere_with_a_sentence(text, way):
    assert plain_number(text) is None
    with pytest.raises(Unreadable) as error:
        read(NUMBER, ways(text)[way], {})
    assert REFUSED[text] in str(error.value)


@pytest.mark.parametrize("text", ["1_000", "١", "１"])
def test_the_cells_of_a_table_are_read_by_the_same_reader(text):
    table = TableOf(("l1",), "RR")
    with pytest.raises(Unreadable, match=r"takes no '_'|the digits 0 to 9"):
        read(table, Raw("text", [["q1", text, "0", "0"], ["q2", "0", "l1", "0"]]), {"l1": 0.5})


@pytest.mark.parametrize("text", ["nan", "NaN", "inf", "-Infinity"])
def test_what_is_not_finite_is_a_number_that_is_refused_later(text):
    assert not math.isfinite(plain_number(text))
    with pytest.raises(Unreadable, match="takes finite numbers"):
        read(NUMBER, from_csv(f"x\n{text}\n".encode(), ASK)["x"], {})


@pytest.mark.parametrize("text", ["", " ", "e5", ".", "1e", "--1", "1 2", "9" * 500])
def test_what_has_no_digits_in_their_places_is_no_number(text):
    assert plain_number(text) is None


def test_blanks_around_a_number_are_none_of_it():
    assert plain_number(" 1.5 ") == 1.5
    assert np.isnan(plain_number(" nan"))
