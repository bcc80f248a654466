"""course.toml and roster.csv: what can be read is read, and what cannot is named with its place."""

import re

import pytest
from courses import make_course
from kinegrade.course.settings.config import (
    CourseError,
    LimitsTable,
    MarkingTable,
    read_course,
    read_roster,
    read_settings,
)

GOOD = 'title = "T"\nsecret = "0123456789abcdef"\n[[sheet]]\nname = "one"\nexercises = ["rrt"]\n'


def settings(tmp_path, text):
    path = tmp_path / "course.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_settings(path)


def roster(tmp_path, text):
    path = tmp_path / "roster.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return list(read_roster(path))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "titel = 1\n" + GOOD,
            [
                "unknown key 'titel'",
                "did you mean 'title'?",
                "title, secret, sheet, formats, limits",
            ],
        ),
        (
            GOOD.replace("[[sheet]]", "[[sheets]]"),
            ["unknown key 'sheets'", "did you mean 'sheet'?"],
        ),
        (GOOD + 'mod = "exam"\n', ["unknown key 'sheet.1.mod'", "did you mean 'mode'?"]),
        (
            GOOD + "[limits]\ncell_second = 3\n",
            ["unknown key 'limits.cell_second'", "did you mean 'cell_seconds'?"],
        ),
        (GOOD + "[[other]]\n", ["unknown key 'other'", "valid here: title"]),
        (GOOD.replace('title = "T"\n', ""), ["the key 'title' is missing"]),
        (GOOD.replace('name = "one"\n', ""), ["the key 'sheet.1.name' is missing"]),
        (
            GOOD + 'mode = "test"\n',
            ["sheet.1.mode", "'practice', 'graded' or 'exam'", "got 'test'"],
        ),
        (
            GOOD + "[limits]\ncell_seconds = 0\n",
            ["limits.cell_seconds takes a number from 1 to 600", "got 0"],
        ),
        (
            GOOD + '[limits]\nmemory_mb = "much"\n',
            ["limits.memory_mb takes a whole number from 256 to 65536", "got 'much'"],
        ),
        (
            GOOD.replace('["rrt"]', "[]"),
            ["sheet.1.exercises takes a list that is not empty, got []"],
        ),
        (
            GOOD.replace('"one"', '"../one"'),
            ["sheet.1.name takes letters, digits, '.', '_' and '-'", "got '../one'"],
        ),
        (GOOD.replace('"one"', '"one."'), ["sheet.1.name", "got 'one.'"]),
        (GOOD.replace('"one"', '"nul"'), ["cannot be called 'nul'"]),
        (GOOD + GOOD[GOOD.index("[[") :], ["two sheets are called 'one'"]),
        (GOOD + GOOD[GOOD.index("[[") :].replace("one", "ONE"), ["two sheets are called"]),
        (
            GOOD.replace('"one"', '"week-1"') + "matlab = true\n",
            ["takes a name that MATLAB can run", "got 'week-1'"],
        ),
        (
            GOOD.replace('"one"', '"end"') + "matlab = true\n",
            ["takes a name that MATLAB can run", "got 'end'"],
        ),
        (GOOD + 'matlab = "maybe"\n', ["sheet.1.matlab takes true or false, got 'maybe'"]),
        (
            GOOD + '[packages]\nallow = "pandas"\n',
            ["packages.allow takes a list in square brackets, got 'pandas'"],
        ),
        (
            GOOD + '[packages]\nallow = ["-x"]\n',
            ["packages.allow.1 takes the name of a package, got '-x'"],
        ),
        (GOOD + "[packages]\nallow = [3]\n", ["takes a text in quotation marks, got 3"]),
        (GOOD.replace("[[sheet]]", "[sheet]"), ["sheet takes tables that begin with [[sheet]]"]),
        (GOOD + 'deadline = "soon"\n', ["takes a time such as 2026-10-08T23:59:00, got 'soon'"]),
        (GOOD + "points = -1\n", ["sheet.1.points takes a number above 0, got -1"]),
        (GOOD + "exercise.rrt = 3\n", ["sheet.1.exercise.rrt takes a table, got 3"]),
        (GOOD + "[limits]\ncell_seconds = 0.0001\n", ["takes a number from 1 to 600"]),
        (GOOD + 'resit_of = "z"\n', ["sheet 'one' is a resit of 'z', and no sheet is called so"]),
        (GOOD + 'resit_of = "one"\n', ["resit_of takes the name of a sheet that is no resit"]),
        ("title = \n", ["not TOML", "line 1"]),
        (b"title = '\xe9'\n", ["cannot be read as UTF-8 text"]),
        ("", ["is missing"]),
    ],
)
def test_a_course_file_that_cannot_be_meant_is_refused_with_what_and_where(tmp_path, text, words):
    with pytest.raises(CourseError) as error:
        settings(tmp_path, text)
    assert str(error.value).startswith(str(tmp_path / "course.toml"))
    assert [word for word in words if word not in str(error.value)] == []
    assert "\n" not in str(error.value)


def test_a_secret_that_is_too_short_is_not_repeated_in_the_complaint(tmp_path):
    with pytest.raises(CourseError, match="secret takes a text of at least 16 characters") as error:
        settings(tmp_path, GOOD.replace("0123456789abcdef", "hush-hush"))
    assert "hush" not in str(error.value)


def test_a_course_file_may_start_with_a_byte_order_mark(tmp_path):
    assert settings(tmp_path, "\ufeff" + GOOD).title == "T"


@pytest.mark.parametrize("name", ["course.toml", "roster.csv"])
def test_a_file_that_is_not_there_or_is_a_folder_is_named(tmp_path, name):
    make_course(tmp_path)
    (tmp_path / name).unlink()
    with pytest.raises(CourseError, match=rf"{name} is not there: a course folder takes a {name}"):
        read_course(tmp_path)
    (tmp_path / name).mkdir()
    with pytest.raises(CourseError, match=rf"{name} is a folder; this takes a file"):
        read_course(tmp_path)


def test_sheets_are_found_by_name_and_a_wrong_name_gets_the_nearest(tmp_path):
    course = read_course(make_course(tmp_path))
    assert course.sheets(("one",)) == course.sheets() == course.settings.sheet
    with pytest.raises(
        CourseError, match=r"no sheet 'onne' \(did you mean 'one'\?\); course.toml has: one"
    ):
        course.sheets(("onne",))


@pytest.mark.parametrize(
    "text",
    [
        "student,name\nada,Ada Lovelace\nben,Ben\n",
        "\ufeffstudent,name\r\nada,Ada Lovelace\r\nben,Ben\r\n",
        "student,name\n\nada,Ada Lovelace\n,\n  ,  \nben,Ben",
        " student , name \n ada , Ada Lovelace \nben,Ben,,\n",
        'name,group,student\n"Ada\nLovelace",1,ada\nBen,2,ben\n',
        "student,name\rada,Ada Lovelace\rben,Ben\r",
        "student;name\r\nada;Ada Lovelace\r\nben;Ben\r\n",
        "Student\tName\nada\tAda Lovelace\nben\tBen\n",
        "\ufeff\nSTUDENT;Name;Section\nada;Ada Lovelace;1\nben;Ben\n",
    ],
)
def test_a_roster_is_read_however_a_spreadsheet_wrote_it(tmp_path, text):
    assert [(student.id, student.name) for student in roster(tmp_path, text)] == [
        ("ada", "Ada Lovelace"),
        ("ben", "Ben"),
    ]


def test_a_name_may_be_missing_or_hold_anything(tmp_path):
    read = roster(tmp_path, 'student,name\nada\nben,"Bot, ""Ben"" <b>"\ncyd,Çağ\u2028rı\n')
    assert [student.name for student in read] == ["ada", 'Bot, "Ben" <b>', "Çağ rı"]


@pytest.mark.parametrize("control", ["\0", "\x1b", "\u202e", "\u2066", "\x07", "\u200f"])
def test_a_name_keeps_no_control_character(tmp_path, control):
    (student,) = roster(tmp_path, f"student,name\nada,Ada{control}L\n")
    assert student.name == "Ada\N{REPLACEMENT CHARACTER}L"


def test_letters_that_are_joined_or_kept_apart_stay_so(tmp_path):
    (student,) = roster(tmp_path, "student,name\nada,می\u200cخواهم\n")
    assert student.name == "می\u200cخواهم"


LIMITS = {
    "limits.cell_seconds": ["-1", "600.5", "inf", "nan", "true", '"5"', "1e400"],
    "limits.notebook_seconds": ["0", "3601", "-inf"],
    "limits.memory_mb": ["255", "65537", "1e3", "999999999999999999999"],
    "marking.slip": ["-0.1", "1.1", "nan", '"1"', "false"],
    "marking.presentation": ["2"],
    "marking.concept": ["-inf"],
}


@pytest.mark.parametrize(
    ("key", "value"), [(key, value) for key, values in LIMITS.items() for value in values]
)
def test_every_number_of_a_course_file_has_a_range_that_is_told(tmp_path, key, value):
    table, name = key.split(".")
    with pytest.raises(CourseError) as error:
        settings(tmp_path, f"{GOOD}[{table}]\n{name} = {value}\n")
    words = r" takes a (whole )?number from \d+ to \d+, got "
    assert re.search(re.escape(key) + words, str(error.value))


def test_every_number_of_a_course_file_is_among_those_that_are_tried():
    numbers = set()
    for table, model in (("limits", LimitsTable), ("marking", MarkingTable)):
        numbers |= {f"{table}.{name}" for name in model.model_fields}
    assert numbers == set(LIMITS)


@pytest.mark.parametrize(
    "student",
    ["../x", "a/b", ".hidden", "-rf", "CON", "nul.txt", "Lpt1", "a b", "ä", "x" * 65, "a.", ""],
)
def test_an_id_that_cannot_name_a_folder_everywhere_is_refused_with_its_line(tmp_path, student):
    with pytest.raises(
        CourseError, match=r"roster.csv, line 3: a student takes an id of letters, digits"
    ) as error:
        roster(tmp_path, f"student,name\nada,Ada\n{student},Somebody\n")
    assert repr(student) in str(error.value)


@pytest.mark.parametrize("student", ["a", "7", "Ada.L-2_x", "s1234567", "console", "x" * 64])
def test_an_id_that_can_name_a_folder_is_taken(tmp_path, student):
    assert roster(tmp_path, f"student,name\n{student},Ada\n")[0].id == student


@pytest.mark.parametrize("twin", ["ada", "ADA", " Ada "])
def test_a_student_twice_is_refused_with_both_lines(tmp_path, twin):
    with pytest.raises(
        CourseError, match=r"roster.csv, line 5: student '\w+' is already in line 2"
    ):
        roster(tmp_path, f"student,name\nada,Ada\n\nben,Ben\n{twin},Ada too\n")


def test_a_student_twice_in_other_capitals_is_told_that_these_do_not_count(tmp_path):
    words = r"line 3: student 'S1' is already in line 2, as 's1': .* capitals do not count"
    with pytest.raises(CourseError, match=words):
        roster(tmp_path, "student,name\ns1,Ada\nS1,Ben\n")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("student\nada\n", "the column 'name' is missing; the first line has: student"),
        ("student,name,Student\nada,Ada,x\n", "the column 'student' is there twice"),
        ('student,name\nada,"Ada\nben,Ben\n', "line 2: a quotation mark is left open"),
        ('student,name\nada,"Ada\nben,"Ben"\n', "line 2: a quotation mark is left open"),
        (
            'student,name\nada,"Ada" L\n',
            "line 2: a quotation mark is left open, or has text behind",
        ),
        (
            'student,name\nada,"Ada\nben,"\ncyd,Cyd\n',
            "line 2: a cell goes on to line 3 and holds what looks like the next student",
        ),
        ("ada,Ada\n", "the column 'student' is missing; the first line has: ada, Ada"),
        ("", "the column 'student' is missing; the first line has: nothing"),
        ("student,name\nada,Lovelace, Ada\n", "line 2: 3 cells for 2 columns"),
        (
            "student,name\nada," + "x" * 200_000 + "\n",
            "not a CSV file: field larger than field limit",
        ),
        ("student,name\nada,Adè\n".encode("latin-1"), "cannot be read as UTF-8 text"),
        ("student,name\nada,Ada\n".encode("utf-16"), "the file is UTF-16 text"),
        ("student,name\nada,Ada\n".encode("utf-16-le"), "the file is UTF-16 text"),
        (b"PK\x03\x04" + bytes(40), "the file is a zip archive (an Excel workbook is one, too)"),
    ],
)
def test_a_roster_that_cannot_be_meant_is_refused_with_what_and_where(tmp_path, text, words):
    with pytest.raises(CourseError) as error:
        roster(tmp_path, text)
    assert str(error.value).startswith(str(tmp_path / "roster.csv"))
    assert words in str(error.value)


def test_other_columns_of_a_roster_are_kept_in_their_order(tmp_path):
    (ada,) = roster(tmp_path, "group,student,name,Matrikel\n=A,ada,Ada, 007 \n")
    assert ada.more == (("group", "=A"), ("Matrikel", "007"))


def test_a_roster_without_students_is_empty(tmp_path):
    assert roster(tmp_path, "student,name\n") == []


EXPORTED = {
    "Excel in German": (
        "\ufeffMatrikelnummer;Vorname;Nachname;Gruppe\r\n0012345;Ada;Lovelace;1\r\n0012346;Ben;Bot;2\r\n",
        [("0012345", "Ada Lovelace"), ("0012346", "Ben Bot")],
    ),
    "capitals and other words": (
        "KENNUNG\tFull Name\nab12cd\tAda Lovelace\n",
        [("ab12cd", "Ada Lovelace")],
    ),
    "zeros kept by a formula": (
        'Student ID,Name\n"=""00123""",Ada\n="007",Ben\n',
        [("00123", "Ada"), ("007", "Ben")],
    ),
    "Moodle": (
        '"First name","Last name","ID number","Email address",Groups\nAda,Lovelace,s01,ada@example.org,A\nBen,Bot,s02,ben@example.org,\n',
        [("s01", "Ada Lovelace"), ("s02", "Ben Bot")],
    ),
    "Moodle without id numbers": (
        "First name,Last name,ID number,Username\nAda,Lovelace,s01,al\nBen,Bot,,bb\n",
        [("al", "Ada Lovelace"), ("bb", "Ben Bot")],
    ),
    "Canvas": (
        'Student,ID,SIS User ID,SIS Login ID,Section,Sheet one (8123)\n    Points Possible,,,,,5\n"Lovelace, Ada",4711,s01,ada@example.org,R1,3\n"Student, Test",99,,x,R1,\n',
        [("s01", "Lovelace, Ada")],
    ),
    "Canvas without a SIS": (
        'Student,ID,SIS Login ID,Section\n"Lovelace, Ada",4711,ada@example.org,R1\n',
        [("4711", "Lovelace, Ada")],
    ),
    "two people of one name": (
        "Student, Name, Section\ns1,Ada Lovelace,1\ns2,Ada Lovelace,2\n",
        [("s1", "Ada Lovelace"), ("s2", "Ada Lovelace")],
    ),
}


@pytest.mark.parametrize("system", EXPORTED)
def test_what_other_systems_export_is_a_roster(tmp_path, system):
    text, students = EXPORTED[system]
    assert [(student.id, student.name) for student in roster(tmp_path, text)] == students


def test_a_roster_of_canvas_keeps_its_ids_and_no_grades(tmp_path):
    text, _ = EXPORTED["Canvas"]
    (ada,) = roster(tmp_path, text)
    assert ada.more == (("ID", "4711"), ("SIS Login ID", "ada@example.org"), ("Section", "R1"))


def test_an_id_that_nobody_filled_in_is_named_with_its_line(tmp_path):
    with pytest.raises(CourseError, match=r"line 3: a student takes an id of letters.*got ''"):
        roster(tmp_path, "Vorname,Nachname,Matrikelnummer\nAda,L,1\nBen,B,\n")
