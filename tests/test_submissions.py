"""Whatever is handed in is read as bytes or refused with a sentence; nothing of it stops a batch."""

import bz2
import gzip
import io
import json
import lzma
import os
import subprocess
import sys
from pathlib import Path

import pytest
from answers import EXERCISES, SLUGS, variant_of
from courses import exercise_of, hand_in, notebook, right_answers
from kinegrade.course.settings.config import CourseError, read_course
from kinegrade.course.sheet.handed_in import find_submission, misnamed, strangers
from kinegrade.course.sheet.submissions import READERS, Submission, read_submission
from kinegrade.exercises.exercise import Function, Numbers, Part
from kinegrade.grader.collecting.ask import Ask, Limits
from kinegrade.grader.collecting.other_formats import other_format
from scipy.io import savemat

ASKS = [Ask("lever_p"), Ask("lever_J")]


def mat(values):
    file = io.BytesIO()
    savemat(file, values)
    return file.getvalue()


HOSTILE = {
    "nothing": b"",
    "half a notebook": notebook("lever_p = [1, 2]")[:100],
    "binary garbage": bytes(range(256)) * 8,
    "UTF-16": notebook("lever_p = [1, 2]").decode().encode("utf-16"),
    "deep nesting": b'{"lever_p": ' + b"[" * 100_000 + b"]" * 100_000 + b', "cells": []}',
    "nesting": b'{"lever_p": ' + b"[" * 900 + b"]" * 900 + b', "cells": []}',
    "a list": b"[1, 2]",
    "a number": b"7",
    "no cells": b'{"cells": 5, "lever_p": null}',
    "cells of anything": b'{"cells": [1, null, "x", {"cell_type": "code"}, {"cell_type": "code", "source": [1]}]}',
    "huge integers": b'{"cells": [], "lever_p": [1' + b"0" * 400 + b", 2]}",
    "longer integers": b'{"cells": [], "lever_p": [1' + b"0" * 5000 + b", 2]}",
    "an object": b'{"cells": [], "lever_p": {"a": 1}, "lever_J": [{"b": 2}]}',
    "half a character": b'{"cells": [], "lever_p": "\\ud800", "lever_J": ["\\udfff", 1]}',
}


WINDOWS = """
import sys
from pathlib import Path
for name in ("resource", "fcntl", "pwd", "grp", "termios", "tty", "pty"):
    sys.modules[name] = None  # importing it raises ImportError
import kinegrade.course.student.check
from kinegrade.course.settings.config import read_course
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.marking.how import this_machine
from kinegrade.course.marking.marker import SheetMarker
sys.platform = "win32"  # not before: the standard library looks at it, too
course = read_course(Path(sys.argv[1]))
with this_machine(course) as machine, Gradebook(course.folder / "gradebook.sqlite") as gradebook:
    for result in SheetMarker(course, gradebook, course.settings.sheet[0], machine).results():
        print(result.student.id, result.points, result.reason)
"""


@pytest.fixture
def course(class_of_three):
    return class_of_three


def found(course):
    submission = find_submission(course.folder, "ada", "one")
    assert submission is not None
    return submission


@pytest.mark.parametrize("suffix", READERS)
@pytest.mark.parametrize("kind", HOSTILE)
def test_no_content_makes_reading_fail(course, kind, suffix):
    path = hand_in(course, "ada", HOSTILE[kind], f"one{suffix}")
    raws = read_submission(path).raws(ASKS, Limits())
    assert set(raws) == {"lever_p", "lever_J"}
    for raw in raws.values():
        assert raw.kind in ("missing", "error", "text", "num")
        assert raw.kind != "error" or len(raw.value) > 10


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("one.ipynb", notebook("lever_p = [0.5, 1]")),
        ("one.json", json.dumps({"lever_p": [0.5, 1]}).encode()),
        ("one.csv", b"lever_p\n0.5,1\n"),
        ("one.mat", mat({"lever_p": [0.5, 1]})),
        ("one.py", b"lever_p = [0.5, 1]"),
        ("one.m", b"lever_p = [0.5 1];"),
    ],
)
def test_every_kind_of_file_gives_the_same_values(course, name, data):
    hand_in(course, "ada", data, name)
    raws = found(course).raws(ASKS, Limits())
    assert raws["lever_p"].kind == "num"
    assert raws["lever_p"].value.ravel().tolist() == [0.5, 1]
    assert raws["lever_J"].kind == "missing"


def test_of_files_of_one_age_a_notebook_counts_before_a_script_and_that_before_values(course):
    for name in ("one.m", "one.mat", "one.csv", "one.json", "one.py", "one.ipynb"):
        os.utime(hand_in(course, "ada", b"{}", name), (1e9, 1e9))
        assert found(course).path.name == name


def test_nothing_handed_in_is_nothing(course):
    hand_in(course, "ada", b"{}", "two.ipynb")
    hand_in(course, "ada", b"{}", "one.txt")
    assert find_submission(course.folder, "ada", "one") is None
    assert find_submission(course.folder, "ben", "one") is None


def test_a_folder_in_the_place_of_a_file_is_named(course):
    (course.folder / "submitted" / "ada" / "one.ipynb").mkdir(parents=True)
    with pytest.raises(
        CourseError, match=r"submitted/ada/one.ipynb cannot be read: it is not a file"
    ):
        find_submission(course.folder, "ada", "one")


def test_a_dangling_link_is_named(course):
    (course.folder / "submitted" / "ada").mkdir(parents=True)
    (course.folder / "submitted" / "ada" / "one.ipynb").symlink_to("nowhere.ipynb")
    with pytest.raises(CourseError, match=r"submitted/ada/one.ipynb is a link"):
        find_submission(course.folder, "ada", "one")


def test_what_is_refused_is_named_below_the_course_folder(course):
    (course.folder / "submitted" / "ada").mkdir(parents=True)
    (course.folder / "submitted" / "ada" / "one.ipynb").symlink_to("nowhere.ipynb")
    with pytest.raises(CourseError) as error:
        find_submission(course.folder, "ada", "one")
    assert (
        str(error.value)
        == "submitted/ada/one.ipynb is a link; a submission takes a file of its own"
    )


def test_a_folder_that_is_a_link_to_a_classmates_is_named(course):
    hand_in(course, "ben", b"{}")
    (course.folder / "submitted" / "ada").symlink_to("ben", target_is_directory=True)
    with pytest.raises(CourseError, match=r"^submitted/ada is a link; a submission takes a file"):
        find_submission(course.folder, "ada", "one")


def test_a_second_name_of_a_classmates_file_is_a_link_too(course):
    theirs = hand_in(course, "ben", b"{}")
    (course.folder / "submitted" / "ada").mkdir()
    os.link(theirs, course.folder / "submitted" / "ada" / "one.json")
    with pytest.raises(CourseError, match="the same file stands under another name, too"):
        find_submission(course.folder, "ada", "one")


def test_the_folder_of_all_submissions_may_stand_elsewhere(course, tmp_path):
    hand_in(course, "ada", b"{}")
    (course.folder / "submitted").rename(tmp_path / "elsewhere")
    (course.folder / "submitted").symlink_to(tmp_path / "elsewhere", target_is_directory=True)
    submission = find_submission(course.folder, "ada", "one")
    assert submission is not None
    assert submission.data == b"{}"


OTHERS = {
    "a zip archive": b"PK\x03\x04\x14\0\0\0",
    "an empty zip archive": b"PK\x05\x06" + bytes(18),
    "compressed with gzip": gzip.compress(b"{}"),
    "compressed with bzip2": bz2.compress(b"{}"),
    "compressed with xz": lzma.compress(b"{}"),
    "a PDF": b"%PDF-1.7\n",
    "a picture": b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
    "a picture, ": b"\xff\xd8\xff\xe0\0\x10JFIF",
    "nothing but zero bytes": bytes(1 << 16),
    "UTF-16 text": '{"lever_p": [1, 2]}'.encode("utf-16"),
    "UTF-16 text, ": '{"lever_p": [1, 2]}'.encode("utf-16-le"),
    "UTF-16 text, w": '{"lever_p": [1, 2]}'.encode("utf-16-be"),
}


@pytest.mark.parametrize("suffix", READERS)
@pytest.mark.parametrize("name", OTHERS)
def test_a_file_that_is_something_else_than_its_ending_says_is_named(suffix, name):
    asks = [Ask("lever_p"), Ask("lever_J")]
    raws = Submission(Path(f"one{suffix}"), OTHERS[name]).raws(asks, Limits())
    assert {raw.kind for raw in raws.values()} == {"error"}
    assert all(f"the file is {name}" in raw.value for raw in raws.values())


@pytest.mark.parametrize(
    "data", [b"", b"{}", b"{\n}", b"[1]", '{"é": 1}'.encode(), b"\0\0\0\0\2\0\0\0", b"PK"]
)
def test_a_file_that_may_be_what_its_ending_says_is_not_named_otherwise(data):
    assert other_format(data) is None


def test_a_link_to_itself_is_named(course):
    (course.folder / "submitted" / "ada").mkdir(parents=True)
    (course.folder / "submitted" / "ada" / "one.ipynb").symlink_to("one.ipynb")
    with pytest.raises(CourseError, match=r"submitted/ada/one.ipynb is a link"):
        find_submission(course.folder, "ada", "one")


def test_a_pipe_is_not_waited_for(course):
    (course.folder / "submitted" / "ada").mkdir(parents=True)
    os.mkfifo(course.folder / "submitted" / "ada" / "one.ipynb")
    with pytest.raises(CourseError, match="it is not a file"):
        find_submission(course.folder, "ada", "one")


def test_a_file_too_large_is_not_read(course, monkeypatch):
    monkeypatch.setattr("kinegrade.course.sheet.upload.MAX_BYTES", 3 << 20)
    path = hand_in(course, "ada", b" " * (4 << 20))
    with pytest.raises(CourseError, match=r"one.json has 4 MB; a submission may have 3 MB"):
        read_submission(path)


@pytest.mark.parametrize("name", ["one.pdf", "one", "one.txt"])
def test_an_ending_that_cannot_be_marked_is_named_with_those_that_can(course, name):
    path = hand_in(course, "ada", b"{}", name)
    with pytest.raises(
        CourseError, match=r"takes one of the endings .ipynb, .py, .json, .csv, .mat, .m, got"
    ):
        read_submission(path)


def test_a_file_under_another_name_is_found_for_a_hint(course):
    sheets = [sheet.name for sheet in course.settings.sheet]
    assert misnamed(course.folder, "ada", sheets) == ""
    hand_in(course, "ada", b"{}", ".ipynb_checkpoints")
    hand_in(course, "ada", b"{}", "one.csv")
    assert misnamed(course.folder, "ada", sheets) == ""
    hand_in(course, "ada", b"{}", "one (1).ipynb")
    assert misnamed(course.folder, "ada", sheets) == ""
    hand_in(course, "ada", b"{}", "my solution.ipynb")
    assert misnamed(course.folder, "ada", sheets) == "my solution.ipynb"


def test_who_handed_in_without_being_on_the_roster_is_listed(course):
    students = [student.id for student in read_course(course.folder).students]
    assert strangers(course.folder, students) == []
    for student in ("ada", "Ben", "zoe", ".git"):
        hand_in(course, student, b"{}")
    assert strangers(course.folder, students) == ["Ben", "zoe"]


def test_without_the_modules_of_posix_everything_but_notebooks_is_marked(course):
    hand_in(course, "ada", right_answers(course, "ada"))
    hand_in(course, "ben", notebook("lever_p = [1, 2]"), "one.ipynb")
    hand_in(course, "cyd", mat(right_answers(course, "cyd")), "one.mat")
    command = [sys.executable, "-c", WINDOWS, str(course.folder)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    ada, ben, cyd = ran.stdout.splitlines()
    assert (ada, cyd) == ("ada 5.0 ", "cyd 5.0 ")
    assert ben.startswith("ben None ")
    assert "one.ipynb: notebooks are marked on Linux" in ben


def test_without_scipy_a_mat_file_is_refused_and_not_marked(course, monkeypatch):
    path = hand_in(course, "ada", mat({"lever_p": [1, 2]}), "one.mat")
    monkeypatch.setitem(sys.modules, "scipy", None)
    with pytest.raises(
        CourseError, match=r"one.mat: .mat files are read with scipy, .* pip install scipy"
    ):
        read_submission(path)


HIDDEN = {"planar": [([0.1, 0.2], "RR"), ([0.3], "R")], "other": [([0.4, 0.5], "PR")]}
PUBLISHED = {"yours": [([1.0, 2.0], "RP")]}


def function(published):
    inputs = (lambda _: PUBLISHED) if published else None
    parts = (
        Part("t_J", "J", 1, Numbers((2,)), lambda *_: [1, 2]),
        Part("t_unasked", "", 0, Numbers((2,)), lambda *_: [1, 2], asked=False),
        Part(
            "t_f",
            "f",
            1,
            Function("(q, kinds)", lambda _: HIDDEN, published=inputs),
            lambda *_: sum,
        ),
    )
    return exercise_of(*parts)


def asks(suffix, *, published):
    return Submission(Path(f"one{suffix}"), b"").asks(function(published), {"x": 0.5})


@pytest.mark.parametrize("published", [True, False])
@pytest.mark.parametrize("suffix", [".ipynb", ".py"])
def test_what_is_run_is_asked_for_the_hidden_calls_group_after_group(suffix, published):
    hidden = (([0.1, 0.2], "RR"), ([0.3], "R"), ([0.4, 0.5], "PR"))
    assert asks(suffix, published=published) == [Ask("t_J"), Ask("t_f", hidden)]


@pytest.mark.parametrize("suffix", [".json", ".csv", ".mat", ".m"])
def test_a_file_is_asked_for_results_of_the_published_calls(suffix):
    assert asks(suffix, published=True) == [Ask("t_J"), Ask("t_f", (([1.0, 2.0], "RP"),))]
    assert (
        len(asks(suffix, published=False)[1].calls) == 3
    )  # nothing is published: a file can hold no right answer


def test_the_inputs_of_a_function_are_those_of_the_variant(course):
    answer = Function("(x)", lambda v: {"own": [(v["x"],)]})
    exercise = exercise_of(Part("t_f", "f", 1, answer, lambda *_: sum))
    for x in (0.25, 0.75):
        assert Submission(Path("one.ipynb"), b"").asks(exercise, {"x": x}) == [Ask("t_f", ((x,),))]


@pytest.mark.parametrize("slug", SLUGS)
def test_every_asked_part_is_asked_for_in_every_kind_of_file(slug):
    exercise, v = EXERCISES[slug], variant_of(slug)
    for suffix in READERS:
        found = Submission(Path(f"one{suffix}"), b"").asks(exercise, v)
        assert [ask.name for ask in found] == [part.variable for part in exercise.asked]
        assert [bool(ask.calls) for ask in found] == [
            isinstance(part.answer, Function) for part in exercise.asked
        ]


def test_a_link_to_a_file_of_somebody_else_is_no_submission(tmp_path):
    (tmp_path / "solution.ipynb").write_bytes(b"{}")
    (tmp_path / "one.ipynb").symlink_to(tmp_path / "solution.ipynb")
    with pytest.raises(CourseError, match="is a link; a submission takes a file of its own"):
        read_submission(tmp_path / "one.ipynb")


def test_results_listed_in_a_notebook_are_no_function(tmp_path):
    part = Part(
        "t_x",
        "x?",
        1,
        Function("(x)", lambda _: {"one": [(1.0,)]}, published=lambda _: {"one": [(2.0,)]}),
        float,
    )
    (tmp_path / "one.ipynb").write_bytes(notebook("t_x = [[2.0]]"))
    (tmp_path / "one.json").write_text('{"t_x": [[2.0]]}', encoding="utf-8")
    in_notebook, in_file = (
        read_submission(tmp_path / f"one.{ending}") for ending in ("ipynb", "json")
    )
    asks = [submission.asks(exercise_of(part), {}) for submission in (in_notebook, in_file)]
    assert "takes a function" in in_notebook.raws(asks[0], Limits())["t_x"].value
    assert in_file.raws(asks[1], Limits())["t_x"].kind in ("num", "calls")
