"""Sheets, marks and feedback for Moodle, Canvas, Gradescope, nbgrader and spreadsheets, in their forms."""

import csv
import io
import json
import re
import subprocess
import sys
import zipfile
from dataclasses import replace
from shutil import copytree

import pytest
from courses import hand_in, handed_out, make_course, right_answers
from downloads import (
    CANVAS,
    MOODLE,
    MOODLE_BLIND,
    MOODLE_FRENCH,
    MOODLE_GERMAN,
    MOODLE_SPANISH,
    sheet_of,
    written,
    zip_file,
)
from kinegrade.course.exchange import handed_back
from kinegrade.course.exchange.worksheet import read_worksheet
from kinegrade.course.ledger.gradebook import Gradebook, GradeKey
from kinegrade.course.marking.written import mark_and_write
from kinegrade.grader.marking.verdict import Finding, not_graded

ROSTER = """student,name,E-mail
ada,Ada Lovelace,ada@example.org
ben,Ben Bot,Ben@Example.org
cyd,Cyd the third,cyd@example.org
"""


@pytest.fixture(scope="module")
def marked(tmp_path_factory):
    """A marked course: ada has all points, ben a wrong sign, cyd handed in nothing."""
    folder = make_course(tmp_path_factory.mktemp("marked") / "course")
    (folder / "roster.csv").write_text(ROSTER)
    course = handed_out(folder)
    hand_in(course, "ada", right_answers(course, "ada"))
    answers = right_answers(course, "ben")
    hand_in(course, "ben", answers | {"lever_J": -answers["lever_J"]})
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        mark_and_write(course, gradebook, course.settings.sheet)
    return folder


@pytest.fixture
def folder(marked, tmp_path):
    """The marked course, to be changed."""
    return copytree(marked, tmp_path / "course")


@pytest.fixture
def handback(kinegrade, folder, tmp_path):
    def run(system, *more, worksheet=None):
        if worksheet:
            more = (*more, "--worksheet", written(tmp_path / "w.csv", worksheet))
        return kinegrade("handback", "one", "--to", system, "-c", folder, *more)

    return run


def rows_of(text):
    return list(csv.reader(io.StringIO(text.lstrip("\ufeff"))))


def let_wait(folder, student):
    """As if the grader had failed on a part: its verdict waits."""
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        first, second = gradebook.current("one")[student]
        waiting = not_graded(second.part, second.out_of, "the grader failed")
        gradebook.save_grades({GradeKey(student, "one", "file", "rules"): [first, waiting]})


def test_the_worksheet_of_moodle_gets_points_and_comments_and_keeps_the_rest(handback, folder):
    ran = handback("moodle", worksheet=MOODLE)
    assert ran.code == 0
    before, after = rows_of(MOODLE), rows_of((folder / "exchange" / "one-moodle.csv").read_text())
    assert after[0] == before[0]
    assert [row[5] for row in after[1:]] == ["5", "3.5", "3.50"]
    for old, new in zip(before, after, strict=True):
        assert new[:5] + new[6:10] == old[:5] + old[6:10]
    assert after[3] == before[3]
    assert after[1][10].startswith("5 of 5 points.<br>lever_p: correct, 2 of 2.")
    assert "lever_J: partly correct, 1.5 of 3." in after[2][10]


def test_a_worksheet_goes_back_in_its_own_form(tmp_path):
    text = "\ufeff" + MOODLE_GERMAN.replace(",", ";").replace("\n", "\r\n")
    path = written(tmp_path / "w.csv", text)
    again = read_worksheet(path).text()
    assert again.startswith("\ufeffID;")
    assert [row.split(";") for row in again.replace('"', "").split("\r\n")] == [
        row.split(";") for row in text.replace('"', "").split("\r\n")
    ]


@pytest.mark.parametrize("worksheet", [MOODLE_GERMAN, MOODLE_FRENCH, MOODLE_SPANISH])
def test_a_worksheet_with_decimal_commas_gets_decimal_commas(handback, folder, worksheet):
    more = worksheet.replace("5,00", "7,50")
    assert handback("moodle", "--scale", worksheet=more).code == 0
    table = rows_of((folder / "exchange" / "one-moodle.csv").read_text())
    assert [row[4] for row in table[1:]] == ["7,5", "5,25", ""]
    assert table[1][9].startswith("5 of 5 points.")


def test_other_points_in_moodle_are_refused_unless_they_are_to_be_converted(handback, folder):
    hundred = MOODLE.replace("5.00", "100.00")
    ran = handback("moodle", worksheet=hundred)
    assert ran.code == 1
    assert "there are 100 points to be had there, and 5 on the sheet" in ran.err
    assert handback("moodle", "--scale", worksheet=hundred).code == 0
    table = rows_of((folder / "exchange" / "one-moodle.csv").read_text())
    assert [row[5] for row in table[1:]] == ["100", "70", "3.50"]


def test_a_sheet_that_is_not_released_yet_is_said_to_be_early(kinegrade, tmp_path):
    make_course(tmp_path, more="release = 2999-01-01T08:00:00Z\n")
    handed_out(tmp_path)
    ran = kinegrade("handout", "one", "-c", tmp_path)
    assert ran.code == 0
    assert "is for Tuesday, 1 January 2999, 08:00 (UTC); do not hand it out before" in ran.err


@pytest.mark.parametrize("system", ["moodle", "canvas", "csv", "nbgrader"])
def test_what_is_not_graded_is_an_empty_cell_and_never_a_zero(handback, folder, system):
    let_wait(folder, "ada")
    worksheet = {"moodle": MOODLE.replace('graded",,5.00', 'graded",4,5.00'), "canvas": CANVAS}
    ran = handback(system, worksheet=worksheet.get(system))
    assert "Not graded yet, so without points: ada." in ran.err
    (path,) = (folder / "exchange").glob("one*.csv")
    (row,) = [row for row in rows_of(path.read_text()) if "ada" in row]
    heading = rows_of(path.read_text())[0]
    names = {"moodle": "Grade", "canvas": "Sheet one (8123)", "csv": "points", "nbgrader": "score"}
    assert row[heading.index(names[system])] == ""


def test_feedback_pages_go_where_moodle_looks_for_them(handback, folder):
    handback("moodle", worksheet=MOODLE.replace('"Ben Bot"', '"Ben_Bot/x"'))
    with zipfile.ZipFile(folder / "exchange" / "one-moodle-feedback.zip") as archive:
        names = archive.namelist()
        page = (folder / "feedback" / "ada" / "one.html").read_bytes()
        assert archive.read("Ada Lovelace_9001_assignsubmission_file_/one.html") == page
    assert [moodles_reading(name) for name in sorted(names)] == [
        ("9001", "assignsubmission", "file", "/one.html"),
        ("9002", "assignsubmission", "file", "/one.html"),
    ]


def moodles_reading(name):
    """Participant, plugin and file of a path, as Moodle's importer takes it apart."""
    parts = name.split("/")
    while parts:
        info = parts.pop(0).split("_", 4)
        if len(info) >= 5 and info[1].isdigit():  # 4 are enough since Moodle 4.1
            return info[1], info[2], info[3], "/".join([info[4], *parts])
    return None


def test_the_gradebook_of_canvas_gets_one_column_and_names_no_other(handback, folder):
    assert handback("canvas", worksheet=CANVAS).code == 0
    assert rows_of((folder / "exchange" / "one-canvas.csv").read_text()) == [
        ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Sheet one (8123)"],
        ["    Points Possible", "", "", "", "", "5"],
        ["Lovelace, Ada", "4711", "ada", "al", "ROB-1", "5"],
        ["Bot, Ben", "4712", "ben", "bb", "ROB-1", "3.5"],
        ["third, Cyd the", "4713", "cyd", "cc", "ROB-2", "4.5"],
    ]


def test_who_is_excused_is_so_in_canvas_and_has_no_zero_anywhere(handback, kinegrade, folder):
    kinegrade("excuse", "ada", "one", "-c", folder)
    handback("canvas", worksheet=CANVAS)
    handback("moodle", worksheet=MOODLE)
    canvas = rows_of((folder / "exchange" / "one-canvas.csv").read_text())
    moodle = rows_of((folder / "exchange" / "one-moodle.csv").read_text())
    assert canvas[2][-1] == "EX"
    assert (moodle[1][5], moodle[1][10][:15]) == ("", "You are excused")


def test_what_is_not_published_is_told(handback, kinegrade, folder):
    said = "Not published, so they may still change: ada, ben. `kinegrade publish one` freezes"
    assert said in handback("csv").err
    kinegrade("publish", "one", "-c", folder)
    assert said not in handback("csv").err


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("Sheet one", "Blatt 1"), "--column takes one of: Blatt 1 (8123), Other (8124)"),
        ((",5,10", ",50,10"), "there are 50 points to be had there, and 5 on the sheet"),
        (("Section", "Gruppe"), "no column is called section"),
        ((",ada,", ",x,"), ""),
    ],
)
def test_a_gradebook_of_canvas_that_does_not_fit_is_one_sentence(handback, change, words):
    ran = handback("canvas", worksheet=CANVAS.replace(*change))
    assert ran.code == (1 if words else 0)
    assert words in ran.err


def test_a_column_of_another_name_can_be_named(handback, folder):
    assert handback("canvas", "--column", "Other (8124)", "--scale", worksheet=CANVAS).code == 0
    table = rows_of((folder / "exchange" / "one-canvas.csv").read_text())
    assert [row[-1] for row in table] == ["Other (8124)", "10", "10", "7", "7"]


def test_comments_of_canvas_carry_the_numbers_of_person_and_file(handback, folder, tmp_path):
    files = {
        "lovelaceada_4711_88001_one.json": b"{}",
        "lovelaceada_4711_88009_one-1.json": b"{}",
        "botben_LATE_4712_88002_one.json": b"{}",
    }
    download = zip_file(tmp_path / "submissions.zip", files)
    handback("canvas", "--download", download, worksheet=CANVAS)
    with zipfile.ZipFile(folder / "exchange" / "one-canvas-comments.zip") as archive:
        names = archive.namelist()
    assert sorted(names) == [
        "botben_LATE_4712_88002_one.html",
        "lovelaceada_4711_88009_one.html",
    ]
    for name in names:  # as Canvas takes them apart
        assert len([piece for piece in name.split("_") if re.fullmatch(r"\d+", piece)]) == 2


def test_feedback_of_nbgrader_lies_in_its_folders(handback, folder, tmp_path):
    ran = handback("nbgrader", "-o", tmp_path / "nb")
    page = tmp_path / "nb" / "feedback" / "ben" / "one" / "one.html"
    assert str(page) in ran.out
    assert page.read_bytes() == (folder / "feedback" / "ben" / "one.html").read_bytes()
    table = list(csv.DictReader((tmp_path / "nb" / "one-nbgrader.csv").read_text().splitlines()))
    assert [(row["student_id"], row["score"], row["max_score"]) for row in table] == [
        ("ada", "5", "5"),
        ("ben", "3.5", "5"),
        ("cyd", "", "5"),
    ]


def test_the_plain_table_has_the_columns_of_the_roster(handback, folder):
    handback("csv")
    table = rows_of((folder / "exchange" / "one.csv").read_text())
    assert table[0] == ["student", "name", "E-mail", "points", "out_of", "status", "feedback"]
    assert table[3] == ["cyd", "Cyd the third", "cyd@example.org", "", "5", "no_submission", ""]
    assert [row[3] for row in table[1:]] == ["5", "3.5", ""]


def autograder(folder, tmp_path, user):
    """Gradescope's folder, with an unpacked autograder and one submission."""
    root = tmp_path / "autograder"
    with zipfile.ZipFile(folder / "exchange" / "one-gradescope-results.zip") as archive:
        archive.extractall(root / "source")
        modes = {info.filename: info.external_attr >> 16 for info in archive.infolist()}
    assert modes["run_autograder"] == modes["setup.sh"] == 0o755
    (root / "submission_metadata.json").write_text(json.dumps({"users": [user]}))
    return root


@pytest.mark.parametrize(
    "user",
    [
        {"sid": "ben", "name": "?"},
        {"sid": "", "email": "BEN@example.org"},
        {"email": "ben@example.org"},
    ],
)
def test_gradescope_gives_everybody_what_was_marked_here(handback, folder, tmp_path, user):
    handback("gradescope")
    root = autograder(folder, tmp_path, user)
    ran = subprocess.run(
        [sys.executable, "-I", root / "source" / "handed_back.py", root], check=False
    )
    assert ran.returncode == 0
    results = json.loads((root / "results" / "results.json").read_text())
    assert (results["score"], results["output"]) == (3.5, "3.5 of 5 points.")
    assert [test["score"] for test in results["tests"]] == [2, 1.5]
    assert [test["status"] for test in results["tests"]] == ["passed", "failed"]
    assert results["extra_data"]["student"] == "ben"


def test_no_hidden_test_hides_the_total_of_gradescope(handback, folder, tmp_path):
    handback("gradescope")
    known = json.loads((autograder(folder, tmp_path, {}) / "source" / "results.json").read_text())
    for results in known["results"].values():
        shown = [results["visibility"], *(test["visibility"] for test in results["tests"])]
        assert set(shown) == {"visible"}


@pytest.mark.parametrize("user", [{"sid": "cyd"}, {"sid": "zoe"}, {}])
def test_gradescope_gets_no_zero_of_whom_nothing_is_marked(handback, folder, tmp_path, user):
    handback("gradescope")
    root = autograder(folder, tmp_path, user)
    assert handed_back.main(root) == 1
    assert not (root / "results").exists()


def test_who_waits_for_a_mark_is_not_in_the_zip_for_gradescope(handback, folder, tmp_path):
    let_wait(folder, "ada")
    handback("gradescope")
    known = json.loads((autograder(folder, tmp_path, {}) / "source" / "results.json").read_text())
    assert set(known["results"]) == {"ben"}


@pytest.mark.parametrize(
    ("system", "words"),
    [
        ("modle", "--to takes one of moodle, canvas, gradescope, nbgrader, csv, got 'modle'"),
        ("moodle", "--to moodle takes --worksheet FILE.csv, its grading worksheet"),
        ("canvas", "--to canvas takes --worksheet FILE.csv, its gradebook"),
    ],
)
def test_a_way_that_cannot_be_gone_is_one_sentence(handback, system, words):
    ran = handback(system)
    assert (ran.code, words in ran.err) == (1, True)


def test_what_is_for_the_instructor_goes_nowhere(handback, folder):
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        first, second = gradebook.current("one")["ada"]
        findings = (Finding("For the instructor.", private=True), Finding("For ada."))
        told = [replace(first, findings=findings), second]
        gradebook.save_grades({GradeKey("ada", "one", "file", "rules"): told})
    handback("csv")
    text = (folder / "exchange" / "one.csv").read_text()
    assert "For ada." in text
    assert "For the instructor." not in text


def test_a_blind_worksheet_of_nobody_is_refused(handback):
    assert "nobody of roster.csv is in it" in handback("moodle", worksheet=MOODLE_BLIND).err


def test_a_line_of_nobody_is_named_by_what_it_has(kinegrade, folder, tmp_path):
    worksheet = written(tmp_path / "w.csv", "Kolumna,Inna\nx,y\n")
    ran = kinegrade("handout", "one", "--worksheet", worksheet, "-c", folder)
    assert "w.csv: x, y: nobody of roster.csv; left as it is." in ran.err


def test_sheets_go_to_moodle_and_into_a_folder_for_everybody(kinegrade, folder, tmp_path):
    worksheet = written(tmp_path / "w.csv", MOODLE)
    ran = kinegrade("handout", "one", "--worksheet", worksheet, "-c", folder)
    assert ran.out.splitlines() == [
        str(folder / "exchange" / "one-sheets.zip"),
        str(folder / "exchange" / "one-moodle-sheets.zip"),
    ]
    ada = (folder / "released" / "ada" / "one.ipynb").read_bytes()
    with zipfile.ZipFile(folder / "exchange" / "one-sheets.zip") as archive:
        assert archive.namelist() == ["ada/one.ipynb", "ben/one.ipynb", "cyd/one.ipynb"]
        assert archive.read("ada/one.ipynb") == ada
    with zipfile.ZipFile(folder / "exchange" / "one-moodle-sheets.zip") as archive:
        assert archive.read("Ada Lovelace_9001_assignsubmission_file_/one.ipynb") == ada


def test_who_is_not_in_the_worksheet_is_told(kinegrade, folder, tmp_path):
    text = "".join(MOODLE.splitlines(keepends=True)[:3])
    worksheet = written(tmp_path / "w.csv", text)
    ran = kinegrade("handout", "one", "--worksheet", worksheet, "-c", folder)
    assert f"cyd is not in {worksheet}" in ran.err


def test_a_sheet_that_was_not_generated_cannot_be_handed_out(kinegrade, tmp_path):
    course = make_course(tmp_path / "other")
    assert "nothing of sheet one is in released/" in kinegrade("handout", "one", "-c", course).err


def test_the_same_zip_comes_out_on_every_run(kinegrade, folder):
    kinegrade("handout", "one", "-c", folder)
    path = folder / "exchange" / "one-sheets.zip"
    first = path.read_bytes()
    kinegrade("handout", "one", "-c", folder)
    assert path.read_bytes() == first


def test_what_went_to_moodle_comes_back_and_is_marked(kinegrade, folder, tmp_path):
    """The whole way: handed out, handed in by Moodle, collected, marked, handed back."""
    worksheet = written(tmp_path / "w.csv", MOODLE)
    files = {
        "Cyd the third_9003_assignsubmission_file/one.json": b'{"lever_p": [0, 0]}',
        "Ben Bot_9002_assignsubmission_file/one.ipynb": sheet_of("ada"),
    }
    download = zip_file(tmp_path / "d.zip", files)
    ran = kinegrade("collect", download, "--worksheet", worksheet, "-c", folder)
    assert (ran.code, "it came from ben, and the sheet in it is that of ada" in ran.err) == (
        1,
        True,
    )
    kinegrade("grade", "-c", folder)
    kinegrade("handback", "one", "--to", "moodle", "--worksheet", worksheet, "-c", folder)
    table = rows_of((folder / "exchange" / "one-moodle.csv").read_text())
    assert [row[5] for row in table[1:]] == ["5", "3.5", "0"]
