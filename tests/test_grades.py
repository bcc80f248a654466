"""grades.csv: one line a student, nothing in it is obeyed, and what waits is never a zero."""

import csv
import io
from pathlib import Path

import pytest
from courses import lever
from kinegrade.course.results.grades import BOM, SheetResults, grades_csv, totals
from kinegrade.course.results.result import Result
from kinegrade.course.settings.config import Sheet, Student
from kinegrade.grader.marking.verdict import Verdict, not_graded

ADA, BEN, CYD = Student("ada", "Ada Lovelace"), Student("ben", "Ben"), Student("cyd", "Cyd")
HALF = (
    Verdict("lever_p", "correct", 2.0, 2.0),
    Verdict("lever_J", "partly", 0.5, 3.0),
)
WAITS = (Verdict("lever_p", "correct", 2.0, 2.0), not_graded("lever_J", 3.0, "wait"))


@pytest.fixture
def sheet(tmp_path):
    """Makes a sheet of the exercise `lever` with these results."""

    def made(*results, name="one"):
        return SheetResults(
            Sheet(name=name, exercises=("lever",)), [lever(tmp_path)], list(results)
        )

    return made


def rows(*sheets):
    return list(csv.DictReader(io.StringIO(grades_csv(sheets).removeprefix(BOM))))


def test_grades_are_quoted_one_line_a_student_with_a_column_a_part(sheet):
    assert grades_csv([sheet(Result(ADA, "one", HALF))]) == (
        '\ufeff"student","name","points","out_of","percent","status",'
        '"one_points","one_out_of","one_status","lever_p","lever_J"\n'
        '"ada","Ada Lovelace","2.5","5","50","graded","2.5","5","graded","2","0.5"\n'
    )


def test_the_file_says_to_a_spreadsheet_that_it_is_utf_8(sheet):
    written = grades_csv([sheet(Result(Student("ada", "Zoë"), "one", HALF))]).encode()
    assert written.startswith(b"\xef\xbb\xbf")
    assert "Zoë" in written.decode("utf-8-sig")


def test_all_sheets_stand_in_one_line_and_in_the_total(sheet):
    one = sheet(Result(ADA, "one", HALF))
    two = sheet(Result(ADA, "two", (Verdict("lever_p", "correct", 2.0, 2.0),)), name="two")
    (row,) = rows(one, two)
    assert (row["points"], row["out_of"], row["percent"]) == ("4.5", "10", "45")
    assert (row["one_points"], row["two_points"]) == ("2.5", "2")
    assert (row["one/lever_p"], row["two/lever_p"], row["two/lever_J"]) == ("2", "2", "")


def test_a_sheet_that_others_handed_in_counts_and_is_named_missing(sheet):
    one = sheet(Result(ADA, "one", HALF), Result(BEN, "one", HALF))
    two = sheet(Result(ADA, "two", HALF), Result(BEN, "two", reason="no submission"), name="two")
    later = sheet(Result(ADA, "three"), Result(BEN, "three"), name="three")
    ada, ben = totals([one, two, later])
    assert (ada.points, ada.out_of, ada.status, ada.missing) == (5.0, 10.0, "graded", ())
    assert (ben.points, ben.out_of, ben.percent) == (2.5, 10.0, 25.0)
    assert (ben.status, ben.missing) == ("incomplete", ("two",))


def test_a_grade_that_is_not_there_is_empty(sheet):
    found = sheet(
        Result(ADA, "one", HALF), Result(BEN, "one", WAITS), Result(CYD, "one", reason="no")
    )
    _, waiting, absent = rows(found)
    assert (waiting["points"], waiting["percent"], waiting["status"]) == ("", "", "not_graded")
    assert (waiting["one_points"], waiting["lever_p"], waiting["lever_J"]) == ("", "2", "")
    assert (absent["points"], absent["one_out_of"], absent["lever_p"]) == ("", "", "")
    assert (absent["status"], absent["one_status"]) == ("no_submission", "no_submission")


def test_before_anybody_has_marks_nobody_is_excused(sheet):
    one = sheet(Result(ADA, "one", reason="nothing marked yet"))
    assert [total.status for total in totals([one])] == ["not_graded"]
    two = sheet(Result(ADA, "one", HALF), Result(BEN, "one", HALF, excused=True))
    assert [total.status for total in totals([two])] == ["graded", "excused"]


@pytest.mark.parametrize(
    "status", ["graded", "incomplete", "not_graded", "no_submission", "excused"]
)
def test_every_status_is_explained(status):
    pages = Path(__file__).parents[1] / "docs" / "pages.md"
    assert f"\n| {status} | " in pages.read_text(encoding="utf-8")


def test_the_columns_of_the_roster_are_kept(sheet):
    student = Student("ada", "Ada", (("Matrikel", "007"), ("group", "=A")))
    (row,) = rows(sheet(Result(student, "one", HALF)))
    assert [*row][:4] == ["student", "name", "Matrikel", "group"]
    assert (row["Matrikel"], row["group"]) == ("007", "'=A")


def test_a_course_without_students_or_sheets_has_a_heading(sheet):
    assert grades_csv([]).count("\n") == 1
    assert grades_csv([sheet()]).count("\n") == 1


@pytest.mark.parametrize("name", ["=1+1", "+cmd|' /C calc'!A0", "-2", "@SUM(A1)", "\t=1", "\n=1"])
def test_a_name_is_never_run_by_a_spreadsheet(sheet, name):
    assert rows(sheet(Result(Student("ada", name), "one", HALF)))[0]["name"] == f"'{name}"


@pytest.mark.parametrize("name", ['Bot, "Ben"', "O'Brien", "Ada\nLovelace", "Zoë;x", "<b>&amp;"])
def test_a_name_comes_back_as_it_is(sheet, name):
    assert rows(sheet(Result(Student("ada", name), "one", HALF)))[0]["name"] == name
