"""Which of a student's files counts: names, times, archives, folders, and what a file says inside."""

import io
import json
import os
import stat
import subprocess
import sys
import zipfile
from datetime import UTC, datetime

import pytest
from courses import hand_in, notebook, right_answers
from kinegrade.course.settings.config import CourseError
from kinegrade.course.sheet import upload
from kinegrade.course.sheet.archive import uploads_in
from kinegrade.course.sheet.file_names import called_after
from kinegrade.course.sheet.handed_in import find_submission, read_handed_in
from kinegrade.course.sheet.upload import Upload, on_disk
from kinegrade.course.sheet.versions import not_beside
from kinegrade.course.term.received import listed_times
from kinegrade.grader.collecting.ask import Ask, Limits

SHEETS = ("one", "one-2", "two")
ADA = {"sheet": "one", "student": "ada"}


@pytest.fixture
def course(class_of_three):
    return class_of_three


def put(course, name, data=b"{}", at=1e9, student="ada"):
    path = hand_in(course, student, data, name)
    os.utime(path, (at, at))
    return path


def found(course, sheet="one", **more):
    """What counts for ada, which is there."""
    submission = find_submission(course.folder, "ada", sheet, SHEETS, **more)
    assert submission is not None
    return submission


def nothing(course, sheet="one"):
    return find_submission(course.folder, "ada", sheet, SHEETS) is None


def named(course, **more):
    """Path below the student's folder of the file that counts, and what was not read."""
    submission = found(course, **more)
    own = course.folder / "submitted" / "ada"
    return submission.path.relative_to(own).as_posix(), submission.unread


def zipped(*files):
    """A zip archive of names, or of infos of them, with their bytes."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files:
            archive.writestr(name, data)
    return packed.getvalue()


@pytest.mark.parametrize(
    ("stem", "sheet"),
    [
        ("one", "one"),
        ("ONE", "one"),
        ("one (1)", "one"),
        ("one(12)", "one"),
        ("one - Copy", "one"),
        ("one-Copy1", "one"),
        ("one - Copy (2)", "one"),
        ("one_final", "one"),
        ("one-v2", "one"),
        ("one-3", "one"),
        ("one-2", "one-2"),
        ("one-2 (1)", "one-2"),
        ("one-data", ""),
        ("oneself", ""),
        ("one2", ""),
        ("my one", ""),
        ("", ""),
    ],
)
def test_a_file_is_called_after_a_sheet_or_a_later_version_of_it(stem, sheet):
    assert called_after(stem, SHEETS) == sheet


@pytest.mark.parametrize("name", ["one.py", "one (1).ipynb", "one-3.ipynb", "One.IPYNB"])
def test_the_newest_counts_and_the_others_are_named(course, name):
    put(course, "one.ipynb")
    put(course, name, at=1e9 + 60)
    assert named(course) == (name, ("one.ipynb",))
    put(course, "one.ipynb", at=1e9 + 120)
    assert named(course) == ("one.ipynb", (name,))


def test_files_of_one_second_go_by_a_fixed_order(course):
    put(course, "one (1).ipynb", at=1e9 + 0.9)
    put(course, "one.py", at=1e9 + 0.5)
    put(course, "one.ipynb", at=1e9 + 0.1)
    assert named(course) == ("one.ipynb", ("one (1).ipynb", "one.py"))


def test_a_time_that_is_listed_goes_before_that_of_the_file(course):
    put(course, "one.ipynb")
    put(course, "one.py", at=1e9 + 60)
    late = {("ada", "one", "one.ipynb"): datetime(2030, 1, 1, tzinfo=UTC)}
    assert named(course, received=late) == ("one.ipynb", ("one.py",))


def test_times_are_read_from_the_list_with_the_latest_line_of_a_file(tmp_path):
    assert listed_times(tmp_path) == {}
    (tmp_path / "submitted").mkdir()
    (tmp_path / "submitted" / "received.csv").write_text(
        "student,sheet,file,received\nada,one,one.ipynb,2026-11-23T23:59:00+01:00\n"
        "ada,one,one.ipynb,2026-11-22T23:59:00Z\n",
        encoding="utf-8",
    )
    expected = {("ada", "one", "one.ipynb"): datetime(2026, 11, 23, 22, 59, tzinfo=UTC)}
    assert listed_times(tmp_path) == expected


def test_a_sheet_that_is_as_it_was_handed_out_does_not_count_where_there_are_answers(course):
    released = course.folder / "released" / "ada" / "one.ipynb"
    put(course, "one.json")
    put(course, "one.ipynb", released.read_bytes(), at=1e9 + 60)
    assert named(course) == ("one.json", ("one.ipynb",))


def test_a_matlab_script_counts_where_there_is_nothing_else(course):
    put(course, "one.m", b"lever_p = [1 2];", at=1e9 + 60)
    assert named(course) == ("one.m", ())
    put(course, "one.mat")
    assert named(course) == ("one.mat", ("one.m",))


@pytest.mark.parametrize(
    ("name", "source"),
    [("one.csv", "np.loadtxt('one.csv')"), ("one.py", "from one import f\nlever_p = f()")],
)
def test_data_and_modules_of_a_notebook_are_no_versions_of_it(course, name, source):
    put(course, "one.ipynb", notebook(source))
    put(course, name, at=1e9 + 60)
    assert named(course) == ("one.ipynb", ())


def test_a_notebook_is_read_once_for_all_files_that_it_may_read(tmp_path):
    reads = []
    source = notebook("np.loadtxt('one (3).csv')")
    run = Upload(tmp_path / "one.ipynb", tmp_path, 1, lambda: reads.append(1) or source)
    tables = [Upload(tmp_path / f"one ({i}).csv", tmp_path, 1, bytes) for i in range(20)]
    left = not_beside([run, *tables])
    assert left == [run, *tables[:3], *tables[4:]]
    assert len(reads) == 1


def test_a_notebook_of_any_name_is_known_by_what_it_says_inside(course):
    put(course, "my solution.ipynb", notebook("lever_p = 1", about=ADA))
    assert named(course) == ("my solution.ipynb", ())
    assert nothing(course, "two")


def test_what_a_notebook_says_of_itself_is_read_without_the_rest_of_it(course):
    about = b'"metadata": {"kinegrade": {"sheet": "one", "student": "ada"}}'
    cells = b'"cells": [{"kinegrade": 1}, {"source": "\\"kinegrade\\": {}"}, {"kinegrade": {"a'
    put(course, "my solution.ipynb", b"{" + about + b", " + cells)  # which is no JSON
    assert named(course) == ("my solution.ipynb", ())
    put(course, "my solution.ipynb", b"{" + cells + b'": 1}}], ' + about + b"}")
    assert named(course) == ("my solution.ipynb", ())


def test_a_script_of_any_name_is_known_by_what_it_says_inside(course):
    put(course, "main.py", b'lever_p = 1\n# kinegrade: {"sheet": "one", "student": "ada"}\n')
    assert named(course) == ("main.py", ())


@pytest.mark.parametrize(
    "about", [{"sheet": "one", "student": "ben"}, {"sheet": "other", "student": "ada"}, "ada", [1]]
)
def test_what_says_to_be_somebody_elses_is_not_taken(course, about):
    put(course, "my solution.ipynb", notebook("lever_p = 1", about=about))
    assert nothing(course)


@pytest.mark.parametrize("archive", ["one.zip", "one (1).zip", "ada homework.zip"])
@pytest.mark.parametrize(
    "inner", ["one.ipynb", "ada/one.ipynb", "a\\b\\one.ipynb", "One-2b/one (1).py"]
)
def test_what_is_in_an_archive_is_read_as_if_it_lay_there(course, archive, inner):
    put(course, archive, zipped((inner, b"{}"), ("__MACOSX/one.ipynb", b""), (".one.py", b"")))
    path, unread = named(course)
    assert path == f"{archive}/{inner}".replace("\\", "/")
    assert (unread, getattr(found(course).handed_in, "name", "")) == ((), archive)


def test_an_archive_of_several_sheets_is_read_for_each(course):
    put(course, "all.zip", zipped(("one.ipynb", b"[1]"), ("two.py", b"x = 2")))
    assert (found(course).data, found(course, sheet="two").data) == (b"[1]", b"x = 2")


def test_an_archive_of_another_name_is_named_where_there_is_another_file(course):
    put(course, "one.json")
    put(course, "all.zip", zipped(("one.ipynb", b"{}")), at=1e9 + 60)
    assert named(course) == ("one.json", ("all.zip",))


def test_modules_and_data_beside_a_notebook_in_an_archive_stay_beside_it(course, jail):
    source = "import arm\nlever_p = np.loadtxt('points.txt') * arm.TWO"
    files = [
        ("w/one.ipynb", notebook(source)), ("w/arm.py", b"TWO = 2"), ("w/points.txt", b"1 2"),
        ("arm.py", b"TWO = 3"), ("w/notes.txt", b""),
    ]  # fmt: skip
    put(course, "one.zip", zipped(*files))
    assert set(found(course).beside()) == {"arm.py", "points.txt"}
    raws = found(course).raws([Ask("lever_p")], Limits(), jail)
    assert raws["lever_p"].value.tolist() == [2, 4]


@pytest.mark.parametrize("folder", ["one", "one/src"])
def test_what_is_in_a_folder_of_the_sheet_is_read_as_if_it_lay_there(course, folder, jail):
    put(course, f"{folder}/main.py", b"import arm\nlever_p = [arm.TWO, 0]")
    put(course, f"{folder}/arm.py", b"TWO = 2")
    with pytest.raises(CourseError, match=r"holds .*arm.py and main.py; .* takes the name one.py"):
        found(course)
    put(course, f"{folder}/one.py", b"import arm\nlever_p = [arm.TWO, 0]")
    assert named(course) == (f"{folder}/one.py", ())
    assert found(course).raws([Ask("lever_p")], Limits(), jail)["lever_p"].value.tolist() == [2, 0]


def test_the_only_notebook_in_an_archive_for_the_sheet_is_the_one(course):
    put(course, "one.zip", zipped(("solution.ipynb", b"{}"), ("arm.py", b""), ("b.csv", b"")))
    assert named(course) == ("one.zip/solution.ipynb", ())


def test_two_notebooks_in_an_archive_are_named_and_none_is_guessed(course):
    put(course, "one.zip", zipped(("a.ipynb", b"{}"), ("b.ipynb", b"{}")))
    with pytest.raises(CourseError, match=r"^submitted/ada/one.zip holds a.ipynb and b.ipynb; the"):
        found(course)


def test_of_an_archive_and_a_file_the_newest_counts(course):
    put(course, "one.zip", zipped(("one.py", b"{}")))
    put(course, "one.ipynb", at=1e9 + 60)
    assert named(course) == ("one.ipynb", ("one.zip/one.py",))
    put(course, "one.zip", zipped(("one.py", b"{}")), at=1e9 + 120)
    assert named(course) == ("one.zip/one.py", ("one.ipynb",))


def info(name="one.ipynb", mode=0o644, **more):
    made = zipfile.ZipInfo(name)
    made.external_attr = mode << 16
    for key, value in more.items():
        setattr(made, key, value)
    return made


def encrypted():
    data = bytearray(zipped(("one.ipynb", b"{}")))
    data[6] |= 1
    data[data.index(b"PK\x01\x02") + 8] |= 1
    return bytes(data)


def damaged():
    data = zipped((info(), b'{"cells": []}' * 50))
    return data.replace(data[45:60], bytes(15), 1)


def lying_listing():
    data = bytearray(zipped(("one.ipynb", b"{}")))
    place = data.rindex(b"PK\x05\x06")
    data[place + 12 : place + 16] = b"\xff\xff\xff\x7f"
    return bytes(data)


def twice():
    with pytest.warns(UserWarning, match="Duplicate name"):
        return zipped(("one.ipynb", b"{}"), ("one.ipynb", b"[]"))


HOSTILE = {
    "not a zip": (lambda: b"PK\x03\x04 no zip", "is no zip archive, or a damaged one"),
    "empty": (lambda: b"", "is no zip archive, or a damaged one"),
    "up": (lambda: zipped(("../ben/one.ipynb", b"{}")), "leads out of its folder"),
    "up in the middle": (lambda: zipped(("a/../../one.ipynb", b"{}")), "leads out of its folder"),
    "up by backslash": (lambda: zipped(("..\\one.ipynb", b"{}")), "leads out of its folder"),
    "absolute": (lambda: zipped(("/etc/one.ipynb", b"{}")), "has an absolute path"),
    "drive": (lambda: zipped(("C:/one.ipynb", b"{}")), "has an absolute path"),
    "link": (lambda: zipped((info(mode=stat.S_IFLNK | 0o777), b"/secret")), "is a link, or no file"),
    "pipe": (lambda: zipped((info(mode=stat.S_IFIFO | 0o644), b"")), "is a link, or no file"),
    "encrypted": (encrypted, "is locked by a password"),
    "damaged": (damaged, "is damaged; zip it again"),
    "bomb": (lambda: zipped(*[(f"{i}.csv", bytes(60 << 20)) for i in range(5)]), "unpacks to 300 MB"),
    "many": (lambda: zipped(*[(f"{i}.csv", b"") for i in range(501)]), "holds too many files"),
    "deep": (lambda: zipped(("a/" * 9 + "one.ipynb", b"{}")), "folders deep"),
    "listing": (lying_listing, "holds too many files"),
    "twice": (twice, "holds two files called 'one.ipynb'"),
    "packed strangely": (
        lambda: zipped((info(compress_type=zipfile.ZIP_LZMA), b"{}")),
        "packed in a way that is not read here",
    ),
}  # fmt: skip


@pytest.mark.parametrize("kind", HOSTILE)
def test_an_archive_that_may_hurt_is_refused_with_a_sentence(course, kind):
    make, words = HOSTILE[kind]
    put(course, "one.zip", make())
    with pytest.raises(CourseError, match=f"^submitted/ada/one.zip.*{words}"):
        found(course)


def test_an_archive_that_cannot_be_read_costs_no_newer_file(course):
    put(course, "one.zip", b"no zip")
    put(course, "one.ipynb", at=1e9 + 60)
    assert named(course) == ("one.ipynb", ("one.zip",))


def test_a_link_to_an_archive_or_a_folder_is_refused(course):
    put(course, "one.zip", zipped(("one.ipynb", b"{}")), student="ben")
    put(course, "one/one.ipynb", student="cyd")
    ada = course.folder / "submitted" / "ada"
    ada.mkdir()
    (ada / "one.zip").symlink_to("../ben/one.zip")
    with pytest.raises(CourseError, match="is a link"):
        found(course)
    (ada / "one.zip").unlink()
    (ada / "one").symlink_to("../cyd/one", target_is_directory=True)
    with pytest.raises(CourseError, match="is a link"):
        found(course)


def test_a_file_in_an_archive_is_no_larger_than_one_beside_it(course, monkeypatch):
    monkeypatch.setattr("kinegrade.course.sheet.upload.MAX_BYTES", 1 << 20)
    put(course, "one.zip", zipped(("one.json", bytes(2 << 20))))
    with pytest.raises(CourseError, match=r"one.zip/one.json has 2 MB; a submission may have 1 MB"):
        found(course)


def test_nothing_is_written_where_an_archive_is_read(course):
    put(course, "one.zip", zipped(("one.ipynb", b"{}"), ("b/c.csv", b"1")))
    before = sorted(course.folder.rglob("*"))
    assert found(course).data == b"{}"
    assert sorted(course.folder.rglob("*")) == before


def test_an_archive_to_check_may_be_called_as_it_likes(tmp_path):
    path = tmp_path / "download (3).zip"
    path.write_bytes(
        zipped(("x/my.ipynb", notebook("a = 1", about=ADA)), ("x/scratch.ipynb", b"{}"))
    )
    assert read_handed_in(path).path == path / "x" / "my.ipynb"
    path.write_bytes(zipped(("notes.txt", b"")))
    with pytest.raises(CourseError, match="holds no file that can be marked"):
        read_handed_in(path)


def test_the_files_of_an_archive_are_listed_without_those_of_systems(tmp_path):
    path = tmp_path / "a.zip"
    path.write_bytes(zipped(("b/", b""), ("b/c.csv", b"1"), ("b/.d", b""), ("Thumbs.db", b"")))
    assert [upload.path for upload in uploads_in(path)] == [path / "b" / "c.csv"]


def test_right_answers_in_an_archive_are_marked_as_those_beside_it(course, kinegrade):
    answers = right_answers(course, "ada")
    source = "\n".join(f"{name} = np.array({value.tolist()})" for name, value in answers.items())
    put(course, "homework.zip", zipped(("one.py", source)))
    put(course, "one.ipynb", b"{}", student="ben")
    put(course, "one.py", source.encode(), student="ben", at=1e9 + 60)
    put(course, "one.zip", b"no zip", student="cyd")
    ran = kinegrade("grade", "--course", course.folder, "--json")
    assert ran.code == 0
    results = {result["student"]: result for result in json.loads(ran.out)}
    assert results["ada"]["points"] == 5
    assert results["ben"]["points"] is not None
    assert (results["cyd"]["status"], results["cyd"]["points"]) == ("not_graded", None)
    assert "zip it again" in results["cyd"]["reason"]
    page = (course.folder / "feedback" / "ben" / "one.html").read_text(encoding="utf-8")
    assert "Not read: <code>one.ipynb</code>." in page
    assert kinegrade("report", "--course", course.folder).code == 0
    assert (course.folder / "feedback" / "ben" / "one.html").read_text(encoding="utf-8") == page


@pytest.mark.parametrize("name", [b"data\xff.csv", b"one\xff.csv", b"one \xff.py"])
def test_a_name_that_is_no_text_stops_nobody(course, name):
    put(course, "one.ipynb", b'{"cells": [], "says": "data\xff.csv"}')
    put(course, os.fsdecode(name), at=5e8)
    assert named(course)[0] == "one.ipynb"
    assert found(course).beside() == {}


def test_a_file_beside_a_notebook_that_cannot_be_read_is_named(course, monkeypatch):
    put(course, "one.ipynb", b'{"cells": "data.csv"}')
    put(course, "data.csv")
    submission = found(course)
    monkeypatch.setattr(upload, "_open_now", refuses)
    with pytest.raises(CourseError, match=r"data\.csv cannot be read: Permission denied"):
        submission.beside()


def test_a_folder_that_cannot_be_looked_into_is_no_missing_submission(course, kinegrade):
    own = course.folder / "submitted" / "ada"
    own.parent.mkdir()
    own.symlink_to("ada")
    put(course, "one.json", b"{}", student="ben")
    ran = kinegrade("grade", "--course", course.folder, "--json")
    results = {result["student"]: result for result in json.loads(ran.out)}
    assert results["ben"]["status"] == "graded"
    assert (results["ada"]["status"], results["ada"]["points"]) == ("not_graded", None)
    assert "submitted/ada cannot be looked into" in results["ada"]["reason"]


def refuses(*_):
    raise PermissionError(13, "Permission denied")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pipes in folders")
def test_what_became_a_pipe_or_a_link_since_it_was_looked_at_is_not_waited_for(course, monkeypatch):
    secret = course.folder / "secret"
    paths = [course.folder / "submitted" / "ada" / name for name in ("one.json", "one (1).json")]
    paths[0].parent.mkdir(parents=True)
    os.mkfifo(paths[0])
    paths[1].symlink_to(secret)
    monkeypatch.setattr(upload, "_mode", lambda _: stat.S_IFREG)
    assert on_disk(paths[0]).read() == b""
    with pytest.raises(CourseError, match="cannot be read: Too many levels of symbolic links"):
        on_disk(paths[1]).read()


def ordinary(*words):
    """A command, run by somebody who may not look everywhere, as the root of a machine may."""
    rights = "-dac_override,-dac_read_search,-fowner"
    without = ["setpriv", "--bounding-set", rights, "--inh-caps", rights]
    command = [sys.executable, "-c", "from kinegrade.course.cli import main; main()", *words]
    if os.geteuid() == 0:
        command = [*without, *command]
    return subprocess.run(command, check=False, capture_output=True, text=True)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such rights")
@pytest.mark.parametrize("inner", ["", "one"])
def test_a_folder_that_nobody_may_look_into_costs_nobody_else_anything(course, inner):
    hand_in(course, "ben", right_answers(course, "ben"))
    own = course.folder / "submitted" / "ada"
    (own / "one").mkdir(parents=True)
    (own / "one" / "one.json").write_text("{}")
    closed = own / inner
    closed.chmod(0o444)  # its names can be read, and nothing else
    try:
        ran = ordinary("grade", "-c", str(course.folder))
        grades = (course.folder / "grades.csv").read_text()
        looked = ordinary("report", "-c", str(course.folder))
    finally:
        closed.chmod(0o755)
    assert (ran.returncode, looked.returncode) == (0, 0), ran.stderr + looked.stderr
    assert '"ada","Ada Lovelace","","5","","not_graded"' in grades
    assert '"ben","Ben Bot","5","5","100","graded"' in grades
    page = (course.folder / "feedback" / "ada" / "one.html").read_text()
    assert "cannot be looked at: Permission denied" in page
    assert str(course.folder) not in page


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such rights")
def test_a_file_beside_that_cannot_be_read_is_named_without_the_folders_above(course):
    path = hand_in(course, "ada", notebook("from helper import lever_p"), "one.ipynb")
    helper = path.with_name("helper.py")
    helper.write_text("lever_p = 1")
    helper.chmod(0)
    assert ordinary("grade", "-c", str(course.folder)).returncode == 0
    page = (course.folder / "feedback" / "ada" / "one.html").read_text()
    assert "submitted/ada/helper.py cannot be read: Permission denied" in page
    assert str(course.folder) not in page
