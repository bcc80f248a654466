"""JSON and CSV files of named matrices give the same raw values as a notebook."""

import json

import numpy as np
import pytest
from kinegrade.exercises.exercise import Numbers
from kinegrade.grader.collect import Ask
from kinegrade.grader.named_matrices import from_csv, from_json
from kinegrade.grader.read import read

ASKS = [Ask("J"), Ask("dh"), Ask("v")]


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
