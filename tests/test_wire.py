"""Bytes from a student's process are checked before they are a value."""

import json

import numpy as np
import pytest
from kinegrade.grader.collecting.wire import Raw, read_frame


def frame(value, *, done=True):
    return json.dumps({"done": done, "values": {"x": value}}).encode()


def numbers(shape, real, imaginary=()):
    return {"k": "num", "v": {"shape": shape, "re": list(real), "im": list(imaginary)}}


def test_a_sound_frame_gives_its_values():
    raw = read_frame(frame(numbers([2, 1], [1.0, 2.0])), ["x", "y"])
    np.testing.assert_array_equal(raw["x"].value, [[1], [2]])
    assert raw["y"].kind == "missing"


def test_complex_numbers_are_real_only_where_no_imaginary_part_is_left():
    assert read_frame(frame(numbers([1], [1.0], [0.0])), ["x"])["x"].value.dtype == float
    assert read_frame(frame(numbers([1], [1.0], [2.0])), ["x"])["x"].value.dtype == complex


@pytest.mark.parametrize(
    "value",
    [
        3,
        [],
        numbers([2], [1.0]),
        numbers([-1], []),
        numbers([1], ["1"]),
        numbers([1], [True]),
        numbers([99999, 99999], []),
        numbers([], []),
        numbers([1, 1, 1, 1, 1], [1.0]),
        numbers([1], [1.0], [1.0, 2.0]),
        {"k": "num", "v": {"shape": [1], "re": [1.0], "im": [], "right": True}},
        {"k": "verdict", "v": "correct"},
        {"k": "text", "v": {"a": 1}},
        {"k": "text", "v": "x" * 20_001},
        {"k": "text", "v": ["x" * 20_001]},
        {"k": "text", "v": [[[["deep"]]]]},
        {"k": "text", "v": [0] * 200_000},
        {"k": "text", "v": [[[0] * 64] * 64] * 64},
        {"k": "text", "v": [["x"] * 65]},
        {"k": "error", "v": 5},
    ],
)
def test_a_forged_value_blanks_that_variable(value):
    assert read_frame(frame(value), ["x"])["x"].kind == "error"


@pytest.mark.parametrize(
    ("said", "name"),
    [
        ("seaborn", "seaborn"),
        ("ruamel.yaml", "ruamel.yaml"),
        ("\x1b[1A\x1b[2K\x1b[32mAll right\x1b[0m", ""),
        ("seaborn\n", ""),
        ("pip install this", ""),
        ("sеaborn", ""),  # one letter of it is Cyrillic
        ("x" * 81, ""),
    ],
)
def test_only_a_name_of_a_package_is_one_that_is_absent(said, name):
    raw = read_frame(frame({"k": "error", "v": "why", "absent": said}), ["x"])["x"]
    assert (raw.kind, raw.value, raw.absent) == ("error", "why", name)


@pytest.mark.parametrize(
    "data", [b"", b"null", b"[1]", b"[" * 100_000, b"\xff", b'{"done": true}', b'{"values": 3}']
)
def test_a_frame_that_is_none_gives_no_value(data):
    assert read_frame(data, ["x"])["x"].kind in ("error", "missing")


def test_what_is_missing_from_an_unfinished_notebook_says_why():
    assert "ended its own process" in read_frame(frame(None, done=False), ["x"])["x"].value
    assert (
        read_frame(frame(None), ["x"], Raw("error", "stopped after 3 s"))["x"].value
        == "stopped after 3 s"
    )
    assert read_frame(frame(numbers([], [1.0]), done=False), ["x"])["x"].kind == "num"


def calls(*values, **more):
    return {"k": "calls", "v": list(values), **more}


def test_results_of_calls_are_a_raw_value_each():
    data = calls(
        numbers([1], [1.0]), {"k": "error", "v": "call 2 stopped"}, {"k": "text", "v": "q1"}
    )
    raw = read_frame(frame(data), ["x"], None, {"x": 3})["x"]
    assert [result.kind for result in raw.value] == ["num", "error", "text"]
    assert not raw.listed


def test_calls_that_were_not_made_say_why():
    data = calls(numbers([1], [1.0]), {"k": "missing", "v": ""})
    raw = read_frame(frame(data, done=False), ["x"], None, {"x": 2})["x"]
    assert raw.value[0].kind == "num"
    assert "ended its own process" in raw.value[1].value


@pytest.mark.parametrize(
    "value",
    [
        calls(numbers([1], [1.0])),
        calls(*[numbers([1], [1.0])] * 3),
        calls(3, 4),
        calls(calls(), calls()),
        calls(*[numbers([1], [1.0])] * 201, listed=True),
        calls(*[numbers([4096], [1.0] * 4096)] * 20, listed=True),
        calls(numbers([1], [1.0]), numbers([1], [1.0]), right=True),
        {"k": "calls", "v": {"a": 1}},
    ],
)
def test_forged_calls_blank_that_variable(value):
    assert read_frame(frame(value), ["x"], None, {"x": 2})["x"].kind == "error"


def test_calls_that_were_not_asked_blank_that_variable():
    assert read_frame(frame(calls()), ["x"])["x"].kind == "error"


def test_a_whole_answer_may_be_longer_than_an_entry_and_keeps_its_lines():
    text = "first\nsecond " + "x" * 19_000
    assert read_frame(frame({"k": "text", "v": text}), ["x"])["x"].value == text
