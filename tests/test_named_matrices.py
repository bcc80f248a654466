"""JSON and CSV files of named matrices give the same raw values as a notebook."""

import json

import numpy as np
import pytest
from kinegrade.exercises.exercise import Numbers
from kinegrade.grader.collecting.ask import Ask
from kinegrade.grader.collecting.named_matrices import from_csv, from_json
from kinegrade.grader.kinds.markers import read

ASKS = [Ask("J"), Ask("dh"), Ask("v")]
CALLS = [Ask("f", ((1.0,), (2.0,)))]


def test_a_json_object_of_matrices_is_read():
    found = from_json(
        json.dumps({"J": [[1, 2], [3, 4.5]], "dh": [["q1", 0]], "other": 1}).encode(), ASKS
    )
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
@pytest.mark.parametrize(
    "data", [b"", b"\xff\xfe\x00\x01", b"[" * 100_000, b"nonsense", b" " * (3 << 20)]
)
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


TWICE = "J stands twice in the file; only one of them can be meant"


@pytest.mark.parametrize(
    ("reader", "text"),
    [
        (from_json, '{"J": [1], "v": [2], "J": [1]}'),
        (from_json, '{"J": [1], "v": [2], "J": [3], "J": [4]}'),
        (from_csv, "J\n1\nv\n2\nJ\n3\n"),
        (from_csv, "v\n2\nJ\n1,2\nJ:\n"),
    ],
)
def test_a_name_that_stands_twice_costs_its_answer_and_no_other(reader, text):
    found = reader(text.encode(), ASKS)
    assert (found["J"].kind, found["J"].value) == ("error", TWICE)
    assert found["v"].value.tolist() in ([2], [[2]])


def test_the_result_of_a_call_that_stands_twice_is_refused():
    found = from_csv(b"f 1\n1\nf 2\n2\nf 1\n3\n", CALLS)
    assert found["f"].value == TWICE.replace("J", "f")


@pytest.mark.parametrize("text", ['J\n"1,2\nv\n3\n', 'v\n3\nJ\n1;"2\n', 'J\n1\nv\n"'])
def test_a_quotation_mark_that_is_left_open_is_told_to_all(text):
    told = {raw.value for raw in from_csv(text.encode(), ASKS).values()}
    assert told == {"the file is not CSV: a quotation mark is left open"}


def test_a_quotation_mark_within_a_cell_opens_nothing():
    assert from_csv(b'J\n1\nv\na 5" pipe\n', ASKS)["v"].value == 'a 5" pipe'


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
        (["x" * 20_001], "error", "too long: a text of 20001 characters; 20000 can be read here"),
        (["x"] * 65, "error", "too long: a list of 65 entries; an answer may have 64"),
        ([[["x"]]], "text", [[["x"]]]),
        ([[[["x"]]]], "error", "not a matrix: its text is nested too deeply"),
        ([0] * 4097, "error", "too large: it has more than 4096 entries"),
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
    assert (
        raw.value
        == "not a matrix: its rows have different lengths; a text with commas takes quotes"
    )


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
    "text",
    ["J\n1,2,3;4,5,6\n", "J\n0.5;1,5\n", "J\n1.5,2;3,4\n", "J\n1,2,3\nv\n1;2\n", "J\n1.000,5;2\n"],
)
def test_commas_and_semicolons_that_could_both_separate_are_refused(text):
    raw = from_csv(text.encode(), ASKS)["J"]
    assert raw.kind == "error"
    assert "can be read in two ways" in raw.value


@pytest.mark.parametrize(
    "cell", ["(" * 60_000 + ")" * 60_000, "1" * 120_000 + "x", '"' * 99_999, "1,1" * 40_000]
)
def test_no_cell_takes_long(cell):
    assert from_csv(f"J\n1;{cell};2\n".encode(), ASKS)["J"].kind == "error"


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (r"a\ud800", "a\ufffd"),
        (r"\udfffb", "\ufffdb"),
        (r"\udc00\ud800", "\ufffd\ufffd"),
        (r"\ud83d\ude00", "\U0001f600"),
        (r"\\ud800", r"\ud800"),
    ],
)
@pytest.mark.parametrize("around", ['"%s"', '["%s"]', '[["%s"]]'])
def test_half_a_surrogate_pair_becomes_a_character_that_can_be_written(value, expected, around):
    content = '{"\\ud800": 1, "J": %s}' % (around % value)
    raw = from_json(content.encode(), ASKS)["J"]
    assert raw.kind == "text"
    assert raw.value == json.loads(around % expected.replace("\\", "\\\\"))
    assert json.dumps(raw.value, ensure_ascii=False).encode()


def test_results_of_calls_have_no_half_surrogate_pairs():
    raw = from_json(rb'{"f": ["\ud800", [1, 2]]}', CALLS)["f"]
    assert raw.value[0].value == "\ufffd"


FULL = "the file has more than 50000 values, lines or brackets; hand in only your answers"


@pytest.mark.parametrize(
    "text",
    [
        "1\n" * 60_000,
        "a," * 60_000,
        ";" * 60_000,
        "1;\r" * 30_000,
        '"' + "\n" * 60_000 + '"',
        "(1" * 60_000,
        "\n" * 60_000,
    ],
)
def test_a_csv_file_with_far_more_than_answers_is_not_taken_apart(text, monkeypatch):
    monkeypatch.setattr(
        "kinegrade.grader.collecting.named_matrices.rows_of",
        lambda *_: pytest.fail("it was taken apart"),
    )
    assert {raw.value for raw in from_csv(f"J\n{text}".encode(), ASKS).values()} == {FULL}


@pytest.mark.parametrize(
    "value",
    ["[" * 60_000, "[" + "[]," * 30_000 + "1]", "[" + "1," * 60_000 + "1]", '{"a":' * 30_000],
)
def test_a_json_file_with_far_more_than_answers_is_not_parsed(value, monkeypatch):
    monkeypatch.setattr(json, "loads", lambda *_, **__: pytest.fail("it was parsed"))
    assert {raw.value for raw in from_json(f'{{"J": {value}}}'.encode(), ASKS).values()} == {FULL}


@pytest.mark.parametrize("reader", [from_json, from_csv])
def test_a_file_of_more_than_two_megabytes_says_so(reader):
    assert (
        reader(b" " * (2 << 20) + b" ", ASKS)["J"].value
        == "the file has more than 2 MB; hand in only your answers"
    )


@pytest.mark.parametrize(
    ("text", "cells"),
    [
        ("1\n" * 4097, 4097),
        ("a,b\n" * 2049, 4098),
        ("1;2,5\n" * 2049, 4098),
        (",".join("1" * 4097), 4097),
    ],
)
def test_too_many_cells_of_one_name_in_csv_cost_only_that_name(text, cells):
    found = from_csv(f"dh\n{text}\nJ\n1\n".encode(), ASKS)
    assert found["dh"].value == f"too large: it has {cells} cells; an answer may have 4096"
    assert found["J"].value.tolist() == [[1]]


def test_results_of_calls_in_csv_are_counted_together():
    text = "".join(f"f {i}\n" + "1\n" * 2100 for i in (1, 2))
    assert (
        from_csv(text.encode(), CALLS)["f"].value
        == "too large: it has 4200 cells; an answer may have 4096"
    )


@pytest.mark.parametrize(
    "value",
    [
        [0] * 4097,
        [[0] * 64] * 65,
        [["x"] * 64] * 65,
        [[[1]] * 4000, [[2]] * 100],
        [[]] * 5000,
        [None] * 4097,
    ],
)
def test_too_many_entries_of_one_name_in_json_cost_only_that_name(value):
    found = from_json(json.dumps({"f": value, "J": 1}).encode(), [*CALLS, Ask("J")])
    assert found["f"].value == "too large: it has more than 4096 entries"
    assert found["J"].value == 1


def test_as_much_as_an_answer_may_have_is_read():
    numbers, texts = [[0.5] * 64] * 64, [["x"] * 64] * 64
    found = from_json(json.dumps({"J": numbers, "dh": texts}).encode(), ASKS)
    assert found["J"].value.shape == (64, 64)
    assert found["dh"].value == texts
    rows = ["J", *(",".join(map(str, row)) for row in numbers), "dh", *map(",".join, texts)]
    found = from_csv("\n".join(rows).encode(), ASKS)
    assert found["J"].value.shape == (64, 64)
    assert found["dh"].value == texts


@pytest.mark.parametrize("line", ["\r", "\r\n", "\n"])
def test_lines_end_as_any_machine_ends_them(line):
    assert from_csv(line.join(["J", "1,2", "3,4", ""]).encode(), ASKS)["J"].value.tolist() == [
        [1, 2],
        [3, 4],
    ]
