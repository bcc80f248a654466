"""MATLAB files give the same raw values as a notebook, and no bytes make reading them fail."""

import io
import itertools
import random
import struct
import sys
import zlib

import numpy as np
import pytest
from kinegrade.grader.collecting import mat_elements, mat_file, mat_limits
from kinegrade.grader.collecting.ask import Ask
from kinegrade.grader.collecting.mat_file import from_mat
from scipy.io import savemat
from scipy.sparse import csc_matrix

HEADER = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"


def cell(*rows):
    array = np.empty((len(rows), len(rows[0])), dtype=object)
    for i, row in enumerate(rows):
        for j, entry in enumerate(row):
            array[i, j] = entry
    return array


def saved(values, *, compressed=False):
    file = io.BytesIO()
    savemat(file, values, do_compression=compressed)
    return file.getvalue()


def one(value, *, compressed=False, calls=()):
    return from_mat(saved({"x": value, "other": 1}, compressed=compressed), [Ask("x", calls)])["x"]


def part(kind, content, order="<"):
    return struct.pack(f"{order}II", kind, len(content)) + content + bytes(-len(content) % 8)


def matrix(name, kind, *parts, shape=(1, 1), flags=0, order="<"):
    """The element of an array, as the format describes it."""
    head = part(6, struct.pack(f"{order}II", kind | flags << 8, 0), order)
    sizes = part(5, struct.pack(f"{order}{len(shape)}i", *shape), order)
    return part(14, head + sizes + part(1, name.encode(), order) + b"".join(parts), order)


def packed(element, order="<"):
    content = zlib.compress(element)
    return struct.pack(f"{order}II", 15, len(content)) + content


def opaque(name, of):
    head = part(6, struct.pack("<II", 17, 0))
    texts = b"".join(part(1, text.encode()) for text in (name, "MCOS", of))
    return part(14, head + texts + matrix("", 13, part(6, bytes(24)), shape=(6, 1)))


@pytest.mark.parametrize("compressed", [False, True])
@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ([[1.5, 2], [3, 4]], [[1.5, 2], [3, 4]]),
        (7.0, [[7]]),
        (np.array([[1], [2]]), [[1], [2]]),
        (np.arange(24.0).reshape(2, 3, 4), np.arange(24.0).reshape(2, 3, 4)),
        (np.array([[True, False]]), [[1, 0]]),
        (np.array([[-3, 4]], dtype=np.int8), [[-3, 4]]),
        (np.array([[2**40]], dtype=np.int64), [[2**40]]),
        (np.array([[0.5]], dtype=np.float32), [[0.5]]),
        (np.array([[1 + 2j, 3]]), [[1 + 2j, 3]]),
        (np.array([[np.nan, np.inf]]), [[np.nan, np.inf]]),
        (csc_matrix([[0, 2.0], [3, 0]]), [[0, 2], [3, 0]]),
        (np.zeros((3, 0)), np.zeros((3, 0))),
        (cell([0.5, 2], [3, 4]), [[0.5, 2], [3, 4]]),
        (cell([np.eye(2), np.ones((2, 2))]), [np.eye(2), np.ones((2, 2))]),
    ],
)
def test_numbers_come_in_the_shape_that_matlab_gave_them(value, expected, compressed):
    raw = one(value, compressed=compressed)
    assert raw.kind == "num", raw
    np.testing.assert_array_equal(raw.value, expected)


@pytest.mark.parametrize("compressed", [False, True])
@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("matrix([[q1, 0], [cos(q2), 1]])", "matrix([[q1, 0], [cos(q2), 1]])"),
        (" b  ", " b"),
        ("θ1 ü", "θ1 ü"),
        ("first\nsecond", "first\nsecond"),
        ("x" * 20_000, "x" * 20_000),
        (np.array(["abc", "d  "]), ["abc", "d"]),
        (cell(["sin(q2) = 0"]), [["sin(q2) = 0"]]),
        (cell(["a", "b"]), [["a", "b"]]),
        (cell(["a"], ["b"]), [["a"], ["b"]]),
        (
            cell(["q1", 0.25, "d1", "pi/2"], ["q2", 0, "", 1]),
            [["q1", "0.25", "d1", "pi/2"], ["q2", "0.0", "", "1.0"]],
        ),
        (cell([cell(["q1", "d1"]), cell(["q2", 0])]), [["q1", "d1"], ["q2", "0.0"]]),
    ],
)
def test_text_and_cells_are_text_as_in_a_notebook(value, expected, compressed):
    raw = one(value, compressed=compressed)
    assert (raw.kind, raw.value) == ("text", expected)


@pytest.mark.parametrize(
    "value", [np.zeros((0, 0)), "", cell([""]), cell([np.zeros((0, 0))] * 5), cell([" "])]
)
def test_what_is_empty_is_unanswered(value):
    assert one(value).kind == "missing"


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ({"a": 1}, "a struct cannot be marked"),
        (np.zeros((99, 99)), "too large: an array of 99 x 99"),
        ("x" * 20_001, "too large"),
        (cell(["x" * 20_001]), "too large: an array of 1 x 20001; 20000 can be read here"),
        (cell(["x"] * 65), "too long: a list of 65 entries"),
        (csc_matrix((9999, 9999)), "too large"),
        (cell([{"a": 1}]), "a struct cannot be marked"),
        (cell([np.eye(2), np.eye(3)]), "different lengths"),
        (cell([cell([cell([cell(["a"])])])]), "nested too deeply"),
    ],
)
def test_what_cannot_be_marked_says_what_it_is(value, words):
    raw = one(value)
    assert raw.kind == "error"
    assert words in raw.value


@pytest.mark.parametrize(
    ("element", "words"),
    [
        (opaque("x", "string"), "use single quotes or char(...)"),
        (opaque("x", "sym"), "use char(...)"),
        (opaque("x", "table"), "an object cannot be marked"),
        (matrix("x", 1, opaque("", "string")), "use single quotes or char(...)"),
        (
            matrix("x", 16, matrix("", 2)),
            "a function handle cannot be called here; hand in its results",
        ),
        (matrix("x", 3), "an object cannot be marked"),
        (matrix("x", 6, part(9, bytes(8)), shape=(2**30, 2**30)), "too large"),
        (matrix("x", 6, part(9, bytes(8)), shape=(-1, 1)), "damaged"),
        (matrix("x", 6, part(9, bytes(8)), shape=(2, 1)), "damaged"),
        (matrix("x", 6, part(77, bytes(8))), "damaged"),
        (matrix("x", 6, part(9, bytes(8)), flags=8), "damaged"),
        (matrix("x", 99, part(9, bytes(8))), "damaged"),
        (matrix("x", 1, shape=(20, 20)), "damaged"),
        (matrix("x", 4, part(4, b"a\0"), shape=(100, 100)), "damaged"),
        (
            matrix(
                "x", 5, part(5, b"\xff" * 4), part(5, struct.pack("<2i", 0, 1)), part(9, bytes(8))
            ),
            "damaged",
        ),
        (
            matrix("x", 5, part(5, bytes(4)), part(5, struct.pack("<2i", 0, 9)), part(9, bytes(8))),
            "damaged",
        ),
        (
            matrix("x", 5, part(5, bytes(4)), part(5, struct.pack("<2i", 5, 1)), part(9, bytes(8))),
            "damaged",
        ),
    ],
)
def test_hand_made_variables_cost_only_themselves(element, words):
    data = (
        HEADER
        + matrix("a", 6, part(9, struct.pack("<d", 1)))
        + element
        + matrix("b", 6, part(2, b"\x02"))
    )
    found = from_mat(data, [Ask("a"), Ask("x"), Ask("b")])
    assert (found["a"].value, found["b"].value) == ([[1]], [[2]])
    assert found["x"].kind == "error"
    assert words in found["x"].value


def test_a_sparse_matrix_made_by_hand_is_read():
    element = matrix(
        "x",
        5,
        part(5, struct.pack("<i", 1)),
        part(5, struct.pack("<3i", 0, 0, 1)),
        part(2, b"\7"),
        shape=(2, 2),
    )
    assert from_mat(HEADER + element, [Ask("x")])["x"].value.tolist() == [[0, 0], [0, 7]]


def test_a_file_of_a_machine_with_the_other_byte_order_is_read():
    number = matrix("x", 6, part(9, struct.pack(">d", 2.5), ">"), order=">")
    text = packed(matrix("y", 4, part(4, b"\0q", ">"), order=">"), ">")
    found = from_mat(HEADER[:124] + b"\x01\x00MI" + number + text, [Ask("x"), Ask("y")])
    assert found["x"].value.tolist() == [[2.5]]
    assert found["y"].value == "q"


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "no MATLAB file of version 5 to 7"),
        (b"PK\x03\x04" * 99, "no MATLAB file of version 5 to 7"),
        (b"# Created by Octave 8.4.0\n# name: x\n" * 9, "no MATLAB file of version 5 to 7"),
        (
            b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(512) + b"\x89HDF\r\n\x1a\n",
            "of version 7.3, which is not read",
        ),
        (b"\x89HDF\r\n\x1a\n" + bytes(300), "of version 7.3, which is not read"),
        (HEADER + b"\x0e", "cut off"),
        (HEADER + struct.pack("<II", 14, 2**31), "cut off"),
        (HEADER + part(15, b"nonsense"), "damaged"),
        (HEADER + part(15, zlib.compress(matrix("x", 6))[:-5]), "cut off"),
        (HEADER + part(9, bytes(8)), "damaged"),
        (bytes((4 << 20) + 1), "the file has more than 4 MB; save only your answers"),
    ],
)
def test_a_file_that_is_not_read_says_why(data, words):
    raw = from_mat(data, [Ask("x")])["x"]
    assert raw.kind == "error"
    assert words in raw.value
    assert "MATLAB" not in words or "-v7'" in raw.value


@pytest.mark.parametrize(
    "bombs", [(bytes(5 << 20),), (matrix("y", 6, part(9, bytes(3 << 20))),) * 2]
)
def test_a_bomb_is_not_unpacked(bombs, monkeypatch):
    monkeypatch.setattr(mat_file, "_variable", lambda *_: pytest.fail("it was read"))
    data = HEADER + b"".join(map(packed, bombs))
    assert len(data) < 1 << 16
    assert "unpacks to more than 4 MB" in from_mat(data, [Ask("x")])["x"].value


def test_what_is_not_compressed_counts_too():
    large = matrix("y", 6, part(9, bytes(5 << 19)))
    assert (
        "unpacks to more than 4 MB"
        in from_mat(HEADER + packed(large) + large, [Ask("x")])["x"].value
    )


def ones(*shape):
    """An array of doubles that takes one byte for each, as MATLAB stores small integers."""
    return matrix("", 6, part(1, b"\1" * int(np.prod(shape))), shape=shape)


def cells_of(*entries, name=""):
    return matrix(name, 1, *entries, shape=(len(entries), 1))


def text_of(*shape):
    return matrix("", 4, part(16, b"a" * int(np.prod(shape))), shape=shape)


NOTHING = part(14, b"")


@pytest.mark.parametrize(
    ("element", "words"),
    [
        (
            cells_of(*[ones(64, 64)] * 2, name="x"),
            "more than 4096 numbers, cells within cells included",
        ),
        (cells_of(*[cells_of(*[ones(41, 1)] * 20)] * 5, name="x"), "more than 4096 numbers"),
        (cells_of(*[cells_of(*[NOTHING] * 400)] * 2, name="x"), "more than 512 cells"),
        (cells_of(*[NOTHING] * 513, name="x"), "an array of 513 x 1; 512 can be read"),
        (cells_of(*[text_of(1, 20_000)] * 11, name="x"), "more than 204800 characters"),
        (cells_of(*[text_of(300, 1)] * 2, name="x"), "more than 512 cells and lines of text"),
        (matrix("x", 6, part(1, b""), shape=(2**30, 0)), "an array of 1073741824 x 0"),
        (matrix("x", 4, part(16, b""), shape=(2**30, 0)), "an array of 1073741824 x 0"),
        (
            cells_of(matrix("", 6, part(1, b""), shape=(0, 2**30)), name="x"),
            "an array of 0 x 1073741824",
        ),
    ],
)
def test_what_is_too_large_in_all_is_refused_before_scipy_reads_it(element, words, monkeypatch):
    monkeypatch.setattr("scipy.io.loadmat", lambda *_, **__: pytest.fail("it was read"))
    raw = from_mat(HEADER + packed(element), [Ask("x")])["x"]
    assert raw.kind == "error"
    assert "too large" in raw.value
    assert words in raw.value


def test_as_much_as_an_answer_may_have_is_read():
    numbers = cells_of(*[cells_of(*[ones(8, 1)] * 16)] * 30, name="x")
    texts = cells_of(*[text_of(1, 400)] * 64, name="y")
    found = from_mat(HEADER + packed(numbers) + packed(texts), [Ask("x"), Ask("y")])
    assert found["x"].value.size == 30 * 16 * 8
    assert len(found["y"].value) == 64


def test_a_file_of_a_thousand_variables_is_read_and_one_of_more_is_not():
    answer, other = matrix("x", 6, part(2, b"\2")), matrix("y", 6, part(2, b"\1"))
    assert from_mat(HEADER + other * 999 + answer, [Ask("x")])["x"].value.tolist() == [[2]]
    assert (
        "more than 1000 variables"
        in from_mat(HEADER + other * 1000 + answer, [Ask("x")])["x"].value
    )


@pytest.mark.parametrize("content", [part(17, b"a\0\0\xd8"), part(18, b"a\0\0\0\0\xd8\0\0")])
def test_text_with_half_a_surrogate_pair_can_be_written(content):
    raw = from_mat(HEADER + matrix("x", 4, content, shape=(1, 2)), [Ask("x")])["x"]
    assert raw.value == "a\N{REPLACEMENT CHARACTER}"


def test_what_stands_before_a_break_is_read():
    data = saved({"x": [[1.0, 2]], "y": np.arange(50.0)})
    found = from_mat(data[:-8], [Ask("x"), Ask("y"), Ask("z")])
    assert found["x"].value.tolist() == [[1, 2]]
    assert "cut off" in found["y"].value
    assert "cut off" in found["z"].value


def test_what_is_not_in_the_file_is_missing():
    assert from_mat(saved({"x": 1}), [Ask("y")])["y"].kind == "missing"


def test_cells_are_the_results_of_calls():
    calls = ((1.0,), (2.0,))
    assert one(cell([np.eye(2), np.ones((2, 2))]), calls=calls).value.shape == (2, 2, 2)
    assert one(cell([1.0], [2.0]), calls=calls).value.tolist() == [[[1]], [[2]]]
    raw = one(cell([np.eye(2), np.eye(3)]), calls=calls)
    assert raw.listed
    assert [result.value.shape for result in raw.value] == [(2, 2), (3, 3)]
    assert [
        result.kind for result in one(cell([np.eye(2), np.zeros((0, 0))]), calls=calls).value
    ] == ["num", "missing"]
    assert one(cell([np.zeros((0, 0))] * 2), calls=calls).kind == "missing"
    pages = np.stack([np.eye(2), 2 * np.eye(2), 3 * np.eye(2)], axis=-1)
    np.testing.assert_array_equal(one(pages, calls=calls).value[2], 3 * np.eye(2))


def test_without_scipy_a_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy", None)
    assert "pip install scipy" in from_mat(saved({"x": 1}), [Ask("x")])["x"].value


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("compressed", [False, True])
def test_no_bytes_make_reading_fail(seed, compressed):
    dice = random.Random(seed)  # noqa: S311 - the same bytes every time
    text = cell(["q1", 0.25, "d1"], ["", np.eye(2), cell(["a"])])
    whole = {
        "x": np.arange(6.0).reshape(2, 3),
        "c": text,
        "t": "text",
        "s": csc_matrix(np.eye(3)),
        "d": {"a": 1},
    }
    asks = [
        Ask(name, calls) for name, calls in zip("xctsd", [(), ((1.0,),), (), (), ()], strict=True)
    ]
    data = saved(whole)
    starts = [128]
    while starts[-1] < len(data):
        starts.append(starts[-1] + 8 + struct.unpack_from("<I", data, starts[-1] + 4)[0])
    for _ in range(1500):
        changed = bytearray(data)
        for _ in range(dice.choice((1, 1, 2, 8))):
            changed[dice.randrange(120, len(changed))] = dice.choice(
                (dice.randrange(256), 0, 1, 5, 14, 15, 128, 255)
            )
        cut = len(changed) if dice.random() < 0.8 else dice.randrange(len(changed))
        pieces = [
            bytes(changed[a:b])
            for a, b in itertools.pairwise(sorted({*(x for x in starts if x < cut), cut}))
        ]
        content = b"".join(map(packed, pieces) if compressed else pieces)
        for raw in from_mat(bytes(changed[:128]) + content, asks).values():
            assert raw.kind in ("num", "text", "calls", "missing", "error")
            assert raw.kind != "error" or len(raw.value) > 10


@pytest.mark.parametrize(
    "element",
    [
        matrix(
            "x",
            5,
            part(5, struct.pack("<i", 10**6)),
            part(5, struct.pack("<2i", 0, 1)),
            part(9, bytes(8)),
        ),
        matrix(
            "x",
            5,
            part(5, bytes(4)),
            part(5, struct.pack("<5i", 0, 2**31 - 1, -(2**31), -1, 0)),  # differences wrap around
            part(9, bytes(8)),
            shape=(2, 4),
        ),
        matrix("x", 6, part(9, bytes(8)), shape=(2, 1)),
        matrix("x", 4, part(4, b"a\0"), shape=(100, 100)),
        matrix("x", 1, shape=(20, 20)),
    ],
)
def test_what_is_damaged_never_reaches_scipy(element):
    """It would believe the indices of a sparse matrix."""
    array = mat_elements.array_of(memoryview(element)[8:], "little")
    with pytest.raises(mat_elements.MatError, match="damaged"):
        mat_limits.check(array, "little")
