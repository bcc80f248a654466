"""JSON and CSV files of named matrices give the same raw values as a notebook."""

import json

import numpy as np
import pytest
from kinegrade.exercises.exercise import Numbers
from kinegrade.grader.ask import Ask
from kinegrade.grader.named_matrices import from_csv, from_json
from kinegrade.grader.read import read

ASKS = [Ask("J"), Ask("dh"), Ask("v")]
CALLS = [Ask("f", ((1.0,), (2.0,)))]


def test_a_json_object_of_matrices_is_read():
    found = from_json(json.dumps({"J": [[1, 2], [3, 4.5]], "dh": [["q1", 0]], "other": 1}).encode(), ASKS)
    assert read(Numbers((2, 2)), found["J"], {}).tolist() == [[1, 2], [3, 4.5]]
    assert found["dh"].kind == "text"
    assert found["v"].kind == "missing"


def test_a_csv_file_is_read_by_names_on_lines_of_their_own():
    text = "\ufeffJ,,\r\n1,2,\r\n3,4.5,\r\n\r\ndh:\r\nq1,d1\r\nv\r\n1\r\n-2e-3\r\n"
    found = from_csv(text.encode(), ASKS)
    np.testing.assert_array_equal(read(Numbers((2, 2)), found["J"], {}), [[1, 2], [3, 4.5]])
    assert found["dh"].value == [["q1", "d1"]]
    np.testing.assert_array_equal(read(Numbers((2,)), found["v"], {}), [1, -0.002])


@pytest.mark.parametrize("reader", [from_json, from_csv])
@pytest.mark.parametrize("data", [b"", b"\xff\xfe\x00\x01", b"[" * 100_000, b"nonsense", b" " * (3 << 20)])
def test_a_broken_file_is_never_an_exception(reader, data):
    assert {raw.kind for raw in reader(data, ASKS).values()} <= {"error", "missing"}


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ([[1, 2], [3]], "different lengths"),
        ({"a": 1}, "not a matrix"),
        ([True], "not a matrix"),
        ([[None]], "not a matrix"),
    ],
)
def test_a_json_value_that_is_no_matrix_says_so(value, words):
    raw = from_json(json.dumps({"J": value}).encode(), ASKS)["J"]
    assert raw.kind == "error"
    assert words in raw.value


def test_a_json_array_instead_of_an_object_says_so():
    assert "object" in from_json(b"[1]", ASKS)["J"].value


def test_nan_in_json_stays_a_number_and_is_refused_later():
    assert from_json(b'{"J": [NaN, 1e999]}', ASKS)["J"].kind == "num"


def from_one(value):
    return from_json(json.dumps({"J": value}).encode(), ASKS)["J"]


@pytest.mark.parametrize(
    ("value", "kind", "expected"),
    [
        ("b", "text", "b"),
        ("first\nsecond", "text", "first\nsecond"),
        ("x" * 20_000, "text", "x" * 20_000),
        (["sin(q2) = 0", "q3 = 0"], "text", ["sin(q2) = 0", "q3 = 0"]),
        ([["q1", 0], [0.25, "d1"]], "text", [["q1", "0.0"], ["0.25", "d1"]]),
        (2, "num", 2),
        ([1, True], "num", [1, 1]),
        ([], "num", []),
        (None, "missing", None),
        ("x" * 20_001, "error", "too long: a text of 20001 characters; 20000 can be read here"),
        (["x" * 401], "error", "too long: a text of 401 characters; 400 can be read here"),
        (["x"] * 65, "error", "too long: a list of 65 entries; an answer may have 64"),
        ([[["x"]]], "error", "not a matrix: its text is nested too deeply"),
        ([0] * 4097, "error", "too large: an array of shape (4097,)"),
        (True, "error", "not a matrix of numbers: it holds true or false"),
    ],
)
def test_json_values_are_read_as_a_notebook_would_give_them(value, kind, expected):
    raw = from_one(value)
    assert raw.kind == kind
    assert (raw.value.tolist() if kind == "num" else raw.value) == expected


@pytest.mark.parametrize(
    ("value", "kinds"),
    [
        ([[1, 2], [[1, 2], [3, 4]]], ["num", "num"]),
        ([[[1]], None], ["num", "missing"]),
        ([1, None], ["num", "missing"]),
        (["a", [1, 2]], ["text", "num"]),
        ([[1, 2], {"a": 1}], ["num", "error"]),
    ],
)
def test_results_of_different_shapes_are_a_list_of_results(value, kinds):
    raw = from_json(json.dumps({"f": value}).encode(), CALLS)["f"]
    assert raw.listed
    assert [result.kind for result in raw.value] == kinds


def test_results_of_one_shape_are_a_stack():
    assert from_json(b'{"f": [[[1, 2]], [[3, 4]]]}', CALLS)["f"].value.shape == (2, 1, 2)
    assert from_json(b'{"f": [null, null]}', CALLS)["f"].kind == "missing"
    assert from_json(b'{"f": [{"a": 1}]}', CALLS)["f"].kind == "error"


def test_text_in_csv_stands_below_its_name():
    text = (
        "choice\nb\nconditions\nsin(q2) = 0,q3 = 0\nmatrix\nq1,0\n0.5,d1\n"
        'formula\n"atan2(y, x)"\nwords\n"It is singular, for\r\n""q2"" is 0."\n'
    )
    asks = [Ask(name) for name in ("choice", "conditions", "formula", "words", "matrix", "empty")]
    found = {name: raw.value for name, raw in from_csv(text.encode(), asks).items()}
    assert found == {
        "choice": "b",
        "conditions": [["sin(q2) = 0", "q3 = 0"]],
        "formula": "atan2(y, x)",
        "words": 'It is singular, for\n"q2" is 0.',
        "matrix": [["q1", "0"], ["0.5", "d1"]],
        "empty": None,
    }


def test_text_with_commas_that_is_not_quoted_is_told_of_quotes():
    raw = from_csv(b"J\none, two\nthree\n", ASKS)["J"]
    assert raw.value == "not a matrix: its rows have different lengths; a text with commas takes quotes"


def test_numbered_lines_in_csv_introduce_results_of_calls():
    assert from_csv(b"f 1\n1,2\nf 2:\n3,4\n", CALLS)["f"].value.tolist() == [[[1, 2]], [[3, 4]]]
    raw = from_csv(b"f 3\n1,2\nf 1\n3,4\n5,6\n", CALLS)["f"]
    assert [result.kind for result in raw.value] == ["num", "missing", "num"]
    assert from_csv(b"f\n1,2\n3,4\n", CALLS)["f"].value.tolist() == [[1, 2], [3, 4]]


@pytest.mark.parametrize("text", ["f 1\n1\nf\n2\n", "f 9999\n1\n", "J 1\n1\n"])
def test_numbered_lines_that_cannot_be_meant_say_what_they_are_for(text):
    found = from_csv(text.encode(), [*CALLS, Ask("J")])
    raw = found["f"] if text.startswith("f") else found["J"]
    assert "take results of the calls on the sheet" in raw.value


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("J\n0,5;1,25\n-2;3e-2\n", [[0.5, 1.25], [-2, 0.03]]),
        ("J;;\n0,5;1,25;\n", [[0.5, 1.25]]),
        ("J\n1;2\n3;4\n", [[1, 2], [3, 4]]),
        ("J\n0.5;2\n", [[0.5, 2]]),
        ("v\n0,5\n1\nJ\n0,5;1\n", [[0.5, 1]]),
        ('J\n"0,5";1\n', [[0.5, 1]]),
        ("J\n0,5*cos(q1);1\natan2(1,2);0,5\n", [["0.5*cos(q1)", "1"], ["atan2(1,2)", "0.5"]]),
        ("J\n0.5,1\nv\nsin(q2) = 0; q3 = 0\n", [[0.5, 1]]),
        ('J\n0.5,1\nv\n"one; two; 3"\n', [[0.5, 1]]),
        ('J\n1,"a;b"\n', [["1", "a;b"]]),
        ("J\n1,2\nv\nsin(q2)=0; q3=0\n", [[1, 2]]),
    ],
)
def test_semicolons_between_cells_are_read_where_there_is_no_doubt(text, expected):
    raw = from_csv(text.encode(), ASKS)["J"]
    assert (raw.value.tolist() if raw.kind == "num" else raw.value) == expected


@pytest.mark.parametrize(
    "text", ["J\n1,2,3;4,5,6\n", "J\n0.5;1,5\n", "J\n1.5,2;3,4\n", "J\n1,2,3\nv\n1;2\n", "J\n1.000,5;2\n"]
)
def test_commas_and_semicolons_that_could_both_separate_are_refused(text):
    raw = from_csv(text.encode(), ASKS)["J"]
    assert raw.kind == "error"
    assert "can be read in two ways" in raw.value


@pytest.mark.parametrize("cell", ["(" * 60_000 + ")" * 60_000, "1" * 120_000 + "x", '"' * 99_999, "1,1" * 40_000])
def test_no_cell_takes_long(cell):
    assert from_csv(f"J\n1;{cell};2\n".encode(), ASKS)["J"].kind == "error"


@pytest.mark.parametrize("line", ["\r", "\r\n", "\n"])
def test_lines_end_as_any_machine_ends_them(line):
    assert from_csv(line.join(["J", "1,2", "3,4", ""]).encode(), ASKS)["J"].value.tolist() == [[1, 2], [3, 4]]
