"""Parts that are marked by hand: they wait, are marked one by one or from a file, and are never lost or misplaced."""

import csv
import json
import re

import pytest
from courses import CLASS, LEVER, files_of, hand_in, handed_out, make_course, right_answers
from hypothesis import given
from hypothesis import strategies as st
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.text.escape import for_spreadsheet, from_spreadsheet, printable_lines

WHY = """        Part("lever_why", "Why?", 4, Manual(((3, "names the axis"), (1, "says where"))),
             lambda v, _: f"L = {v['L']}"),
        Part("lever_sketch", "A sketch", 2, Manual(((2, "arrows"),), on_paper=True), lambda *_: "three arrows"),
    ),"""


@pytest.fixture
def course(tmp_path, kinegrade):
    """Three students: one wrote an argument, one left it blank, one handed in nothing. Marked once."""
    folder = make_course(tmp_path / "course")
    text = LEVER.replace("Exercise, Numbers, Part", "Exercise, Manual, Numbers, Part")
    before, _, after = text.rpartition("    ),\n    statement")
    (folder / "exercises" / "lever.py").write_text(
        f"{before}{WHY}\n    statement{after}", encoding="utf-8"
    )
    made = handed_out(folder)
    answers = right_answers(made, "ada")
    hand_in(
        made,
        "ada",
        {k: x for k, x in answers.items() if hasattr(x, "tolist")}
        | {"lever_why": "The axis is z."},
    )
    hand_in(
        made, "ben", {k: x for k, x in right_answers(made, "ben").items() if hasattr(x, "tolist")}
    )
    kinegrade("grade", "--course", folder)
    return made


def points_of(course, kinegrade):
    kinegrade("report", "--course", course.folder)
    rows = csv.DictReader(
        (course.folder / "grades.csv").read_text(encoding="utf-8-sig").splitlines()
    )
    return {
        row["student"]: (row["status"], row["points"], row["lever_why"], row["lever_sketch"])
        for row in rows
    }


def test_an_answer_waits_for_its_mark_and_is_no_zero(course, kinegrade):
    found = points_of(course, kinegrade)
    assert found["ada"] == ("not_graded", "", "", "")
    assert found["ben"] == ("not_graded", "", "0", "")
    assert found["cyd"][0] == "no_submission"


def test_what_waits_is_listed_with_key_and_rubric(course, kinegrade):
    ran = kinegrade("marks", "list", "--course", course.folder)
    assert "ada  lever_why  4 points" in ran.out
    assert "answer: The axis is z." in ran.out
    assert f"key:    {right_answers(course, 'ada')['lever_why']}" in ran.out
    assert "3  names the axis" in ran.out
    assert ran.out.count("(on paper)") == 2
    assert "ben  lever_why" not in ran.out
    assert "3 answers wait" in ran.err


def test_the_lines_of_an_answer_are_listed_below_one_another(course, kinegrade):
    submitted = course.folder / "submitted" / "ada" / "one.json"
    answers = json.loads(submitted.read_text(encoding="utf-8"))
    hand_in(course, "ada", answers | {"lever_why": "First line.\n\tSecond\x1b line"})
    kinegrade("grade", "--course", course.folder)
    listed = kinegrade("marks", "list", "--course", course.folder).out
    assert "  answer: First line.\n          \tSecond\ufffd line\n  key:" in listed


def test_marks_entered_one_by_one_complete_the_grade(course, kinegrade):
    kinegrade(
        "marks",
        "set",
        "ada",
        "lever_why",
        "3.5",
        "--comment",
        "Where is the axis?",
        "--course",
        course.folder,
    )
    kinegrade("marks", "set", "ada", "lever_sketch", "2", "--course", course.folder)
    assert points_of(course, kinegrade)["ada"] == ("graded", "10.5", "3.5", "2")
    page = (course.folder / "feedback" / "ada" / "one.html").read_text(encoding="utf-8")
    assert "Where is the axis?" in page
    assert "The axis is z." in page
    kinegrade("grade", "--again", "--course", course.folder)
    assert points_of(course, kinegrade)["ada"][1] == "10.5"


def test_marks_go_out_and_come_back_in_a_file(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    assert (
        "4 answers, 3 of them wait"
        in kinegrade("marks", "write", path, "--course", course.folder).err
    )
    rows = [*csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())]
    for row in rows:
        row["points"] = "2" if row["student"] == "ada" else "1"
    write(path, rows)
    assert "4 marks entered" in kinegrade("marks", "read", path, "--course", course.folder).err
    found = points_of(course, kinegrade)
    assert (found["ada"][1:], found["ben"][1:]) == (("9", "2", "2"), ("7", "1", "1"))


def test_a_file_of_marks_says_that_it_is_utf_8_and_is_read_with_and_without_that(
    course, kinegrade, tmp_path
):
    path = tmp_path / "marks.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    text = path.read_text(encoding="utf-8")
    assert text.startswith("\ufeff")
    by_script = '"\ufeff""student"""' + text.removeprefix(
        '\ufeff"student"'
    )  # as csv.DictWriter has it
    for written in (text, text[1:], by_script):
        path.write_text(
            written.replace('"ada","one","lever_why",""', '"ada","one","lever_why","3"'),
            encoding="utf-8",
        )
        assert "1 mark entered" in kinegrade("marks", "read", path, "--course", course.folder).err


def rows_of(path):
    return [*csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())]


def test_a_comment_alone_is_read_and_leaves_points_as_they_are(course, kinegrade, tmp_path):
    path, again = tmp_path / "marks.csv", tmp_path / "again.csv"
    where = ("--course", course.folder)
    kinegrade("marks", "write", path, *where)
    kinegrade("marks", "set", "ada", "lever_why", "--ticks", "1", *where)  # after the file
    rows = rows_of(path)
    for row in rows:
        row["comment"] = f"For {row['student']}."
    write(path, rows)
    assert "4 marks entered" in kinegrade("marks", "read", path, *where).err
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        marks = gradebook.marks("one")
    assert {mark.comment for mark in marks.values()} == {"For ada.", "For ben."}
    assert marks["ada", "lever_why"].points == 3
    assert marks["ada", "lever_why"].ticks == "1"
    assert marks["ben", "lever_sketch"].points is None

    kinegrade("marks", "write", again, *where)
    assert "1 mark entered" in kinegrade("marks", "read", again, *where).err  # the one with points


def test_an_untouched_file_gives_nothing_to_a_new_answer(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    where = ("--course", course.folder)
    kinegrade("marks", "set", "ada", "lever_why", "--ticks", "1", "--comment", "So.", *where)
    answers = json.loads((course.folder / "submitted" / "ada" / "one.json").read_text("utf-8"))
    hand_in(course, "ada", answers | {"lever_why": "The axis is x."})
    kinegrade("grade", *where)
    kinegrade("marks", "write", path, *where)
    (row,) = [row for row in rows_of(path) if row["answer"] == "The axis is x."]
    assert (row["points"], row["ticks"], row["comment"]) == ("", "", "So.")
    assert "0 marks entered" in kinegrade("marks", "read", path, *where).err
    assert points_of(course, kinegrade)["ada"][2] == ""


def test_the_code_on_the_pages_stands_for_the_student(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    rows = [*csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())]
    codes = {row["student"]: row["code"] for row in rows}
    assert len(set(codes.values())) == len(codes) == 2

    typed = codes["ada"].lower().replace("-", " ")
    ran = kinegrade("marks", "set", typed, "lever_why", 3, "--course", course.folder)
    assert ran.code == 0
    for row in rows:
        row["student"] = row["code"]
        row["points"] = "1" if row["part"] == "lever_sketch" else ""
    write(path, rows)
    assert "2 marks entered" in kinegrade("marks", "read", path, "--course", course.folder).err
    found = points_of(course, kinegrade)
    assert found["ada"][2:] == ("3", "1")
    assert found["ben"][3] == "1"


def test_a_code_of_nobody_is_refused(course, kinegrade):
    ran = kinegrade("marks", "set", "0000-0000", "lever_why", 3, "--course", course.folder)
    assert ran.code == 1
    assert "roster.csv has no student '0000-0000' and no answer has that code" in ran.err


@pytest.mark.parametrize(
    ("student", "words"),
    [
        ("nobody", "roster.csv has no student 'nobody'\n"),
        ("adda", "roster.csv has no student 'adda' (did you mean 'ada'?)"),
        ("cyd", "cyd, lever_why: there is no such answer to mark"),
    ],
)
def test_a_mark_for_nobody_says_so(course, kinegrade, student, words):
    ran = kinegrade("marks", "set", student, "lever_why", 3, "--course", course.folder)
    assert ran.code == 1
    assert words in ran.err


def test_one_answer_that_waits_is_said_as_one(course, kinegrade, tmp_path):
    where = ("--course", course.folder)
    for part in ("lever_why", "lever_sketch"):
        kinegrade("marks", "set", "ada", part, 1, *where)
    said = kinegrade("marks", "write", tmp_path / "marks.csv", *where).err
    assert "4 answers, 1 of them waits for a mark." in said


def write(path, rows, delimiter=","):
    with path.open("w", encoding="utf-8", newline="") as out:
        writer = csv.DictWriter(out, rows[0].keys(), delimiter=delimiter)
        writer.writeheader()
        writer.writerows(rows)


def test_a_file_from_a_spreadsheet_with_semicolons_and_decimal_commas_is_read(
    course, kinegrade, tmp_path
):
    path = tmp_path / "marks.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    rows = [
        row | {"points": "1,5"}
        for row in csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())
    ]
    write(path, rows, ";")
    kinegrade("marks", "read", path, "--course", course.folder)
    assert points_of(course, kinegrade)["ada"][2:] == ("1.5", "1.5")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"points": "5"}, "points take 0 to 4, got 5"),
        ({"points": "-1"}, "points take 0 to 4, got -1"),
        ({"points": "nan"}, "points take 0 to 4, got nan"),
        ({"points": "", "ticks": "9"}, "ada, lever_why: its rubric has 2 lines, got 9"),
        ({"ticks": "9"}, "ada, lever_why: its rubric has 2 lines, got 9"),
        ({"points": "two"}, "points take a number, got 'two'"),
        ({"points": "1", "student": "zoe"}, "roster.csv has no student 'zoe'"),
        ({"points": "1", "sheet": "on"}, "there is no sheet 'on' (did you mean 'one'?)"),
        (
            {"points": "1", "part": "lever_p"},
            "the parts are: lever_sketch, lever_why",
        ),
        (
            {"points": "1", "answer_id": "00000000"},
            "the answer changed since this file was written",
        ),
    ],
)
def test_one_wrong_line_enters_nothing_and_is_named(course, kinegrade, tmp_path, change, words):
    path = tmp_path / "marks.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    rows = [
        row | {"points": "1"}
        for row in csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())
    ]
    number = next(
        i for i, row in enumerate(rows) if (row["student"], row["part"]) == ("ada", "lever_why")
    )
    rows[number] |= change
    write(path, rows)
    ran = kinegrade("marks", "read", path, "--course", course.folder)
    assert ran.code == 1
    assert words in ran.err
    assert f"line {number + 2}" in ran.err
    assert "nothing was entered" in ran.err
    assert points_of(course, kinegrade)["ada"][1] == ""


def test_a_new_answer_waits_for_a_new_mark(course, kinegrade):
    kinegrade("marks", "set", "ada", "lever_why", "4", "--course", course.folder)
    kinegrade("marks", "set", "ada", "lever_sketch", "2", "--course", course.folder)
    submitted = course.folder / "submitted" / "ada" / "one.json"
    answers = json.loads(submitted.read_text(encoding="utf-8"))
    hand_in(course, "ada", answers | {"lever_why": "The axis is x."})
    kinegrade("grade", "--course", course.folder)
    assert points_of(course, kinegrade)["ada"][2:] == ("", "2")
    page = (course.folder / "feedback" / "ada" / "one.html").read_text(encoding="utf-8")
    assert "waits for a new mark" in page
    hand_in(course, "ada", answers)
    kinegrade("grade", "--course", course.folder)
    assert points_of(course, kinegrade)["ada"][1:] == ("11", "4", "2")


def test_marked_answers_are_not_marked_again_by_the_grader(course, kinegrade, monkeypatch):
    kinegrade("marks", "set", "ada", "lever_why", "4", "--course", course.folder)
    monkeypatch.setattr(
        "kinegrade.course.grading.work.mark", lambda *_, **__: pytest.fail("marked twice")
    )
    kinegrade("grade", "--course", course.folder)
    assert points_of(course, kinegrade)["ada"][2] == "4"


def test_a_file_of_marks_is_never_overwritten(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    before = path.read_bytes()
    ran = kinegrade("marks", "write", path, "--course", course.folder)
    assert (ran.code, path.read_bytes()) == (1, before)
    assert "may hold marks" in ran.err


def test_a_file_without_the_columns_is_refused(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    path.write_text("student,points\nada,3\n", encoding="utf-8")
    assert (
        "the column 'sheet' is missing"
        in kinegrade("marks", "read", path, "--course", course.folder).err
    )


def test_what_a_student_typed_is_no_formula_in_a_spreadsheet(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    submitted = course.folder / "submitted" / "ada" / "one.json"
    hand_in(
        course,
        "ada",
        json.loads(submitted.read_text(encoding="utf-8")) | {"lever_why": "=HYPERLINK(1)"},
    )
    kinegrade("grade", "--course", course.folder)
    kinegrade("marks", "write", path, "--course", course.folder)
    assert '"\'=HYPERLINK(1)"' in path.read_text(encoding="utf-8")


def test_marking_by_hand_touches_no_submission(course, kinegrade):
    before = files_of(course.folder / "submitted")
    kinegrade("marks", "set", "ada", "lever_why", "4", "--course", course.folder)
    points_of(course, kinegrade)
    assert files_of(course.folder / "submitted") == before
    assert [student for student, _ in CLASS] == ["ada", "ben", "cyd"]


@pytest.mark.parametrize("comment", ["", "= is missing in line 2", "'quoted'", "-1 for the sign"])
def test_a_comment_comes_back_as_it_went_out(course, kinegrade, tmp_path, comment):
    path, again = tmp_path / "marks.csv", tmp_path / "again.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    rows = [*csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())]
    assert {row["comment"] for row in rows} == {""}
    for row in rows:
        row |= {"points": "1", "comment": comment}
    write(path, rows)
    for file in (again, tmp_path / "third.csv"):
        kinegrade("marks", "read", path, "--course", course.folder)
        kinegrade("marks", "write", file, "--course", course.folder)
        path = file
    told = [*csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())]
    ours = "'" if comment.startswith(("=", "-")) else ""
    assert {row["comment"] for row in told} == {f"{ours}{comment}"}


COMMENTS = [
    "= 1", "'= 1", "''= 1", "'quoted'", "-1", "'-1", "+", "@", "\t=1", "two\nlines", " spaces  within ",
    "'", "''", "＝1", "a;b", 'say "so"', "a,b", "1e5", "00123", "\n=1",
]  # fmt: skip


@pytest.mark.parametrize("comment", COMMENTS)
def test_a_comment_of_the_command_goes_through_a_file_unchanged(
    course, kinegrade, tmp_path, comment
):
    where = ("--course", course.folder)
    kinegrade("marks", "set", "ada", "lever_why", "1", f"--comment={comment}", *where)
    for name in ("one.csv", "two.csv", "three.csv"):
        kinegrade("marks", "write", tmp_path / name, *where)
        kinegrade("marks", "read", tmp_path / name, *where)
    assert comment_of(course) == comment


def comment_of(course):
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        return gradebook.marks("one")["ada", "lever_why"].comment


@given(st.text(max_size=40))
def test_any_text_comes_back_from_a_spreadsheet_as_far_as_it_can_be_printed(text):
    shown = printable_lines(text)
    assert from_spreadsheet(for_spreadsheet(text)) == shown
    assert printable_lines(shown) == shown


def test_no_spreadsheet_takes_the_id_of_an_answer_for_a_number(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    rows = [*csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())]
    assert all(re.fullmatch("id-[0-9a-f]{8}", row["answer_id"]) for row in rows)


def test_a_file_of_before_has_the_bare_ids_and_is_read(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    rows = [*csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())]
    for row in rows:
        row |= {"points": "1", "answer_id": row["answer_id"].removeprefix("id-")}
    write(path, rows)
    assert "4 marks entered" in kinegrade("marks", "read", path, "--course", course.folder).err


@pytest.mark.parametrize("points", ["1_0", "١", "1,5,0", "0x1", "one"])
def test_points_are_numbers_as_everybody_writes_them(course, kinegrade, tmp_path, points):
    path = tmp_path / "marks.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    rows = [*csv.DictReader(path.read_text(encoding="utf-8-sig").splitlines())]
    rows[0]["points"] = points
    write(path, rows)
    assert "points take a number" in kinegrade("marks", "read", path, "--course", course.folder).err


def test_a_quotation_mark_that_is_left_open_names_its_line(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    kinegrade("marks", "write", path, "--course", course.folder)
    text = path.read_text(encoding="utf-8")
    path.write_text(f'{text}"ada,one', encoding="utf-8")
    ran = kinegrade("marks", "read", path, "--course", course.folder)
    assert f"line {text.count(chr(10)) + 1}: a quotation mark is left open" in ran.err


def test_a_heading_that_is_too_long_for_a_cell_is_no_fault_of_ours(course, kinegrade, tmp_path):
    path = tmp_path / "marks.csv"
    path.write_text("x" * 200_000 + ",points\n", encoding="utf-8")
    ran = kinegrade("marks", "read", path, "--course", course.folder)
    assert (ran.code, "not a CSV file" in ran.err) == (1, True)
