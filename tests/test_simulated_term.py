"""A whole term by script, for a class of thirty: at its end every mark is the one of a table by hand."""

import csv
import io
import json
import os
from datetime import UTC, datetime, timedelta

import numpy as np
from courses import enrol, hand_in, make_course, notebook, right_answers
from downloads import zip_bytes
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.settings.config import read_course
from kinegrade.course.variants.variant_code import variant_codes

CRANK = '''
"""Two parts: one is computed, the other is marked by hand."""
import numpy as np
from kinegrade.exercises.exercise import Exercise, Manual, Numbers, Part

EXERCISE = Exercise(
    slug="crank",
    title="A crank",
    source="made for tests",
    draw=lambda rng: {"r": float(rng.integers(100, 900)) / 1000, "q": float(rng.integers(200, 1300)) / 1000},
    parts=(
        Part("crank_p", "The pin", 4, Numbers((2,), "m"),
             lambda v, _: v["r"] * np.array([np.cos(v["q"]), np.sin(v["q"])])),
        Part("crank_why", "Why?", 2, Manual(((1.5, "names the axis"), (0.5, "says its sense"))),
             lambda v, _: "It turns about z."),
    ),
    statement=lambda v: "A crank.",
    units={"r": "m", "q": "rad"},
    scale=lambda v: v["r"],
)
'''
MISPRINTED = CRANK.replace('np.sin(v["q"])', '1.5 * np.sin(v["q"])')
SHEETS = """
deadline = 2026-10-08T23:59:00
grace_minutes = 15
late_percent = 10
late_most = 40
closes = 2026-10-15T23:59:00
attempts = "best"

[[sheet]]
name = "two"
title = "Sheet two"
exercises = ["crank"]

[[sheet]]
name = "again"
title = "Second try of sheet two"
resit_of = "two"
exercises = ["crank"]
points = 12
"""
DEADLINE = datetime(2026, 10, 8, 21, 59, tzinfo=UTC)
EARLY = DEADLINE - timedelta(days=1)
WHY = "It turns about z, counterclockwise."

CLASS = [(f"s{i:02}", f"Student Number{i:02}") for i in range(1, 31)]
BY_HAND = """
student  one   two   again  points  out_of  status
s01      5     6     -      11      11      graded
s02      5     4     -      9       11      graded         of the rubric nothing is met
s03      5     5.5   -      10.5    11      graded         of the rubric the first line is met
s04      5     0     12     11      11      graded         sheet two was wrong, the resit is right
s05      5     0     0      5       11      graded         sheet two was wrong, the resit is no better
s06      4     6     -      10      11      graded         two days late, a fifth
s07      3     6     -      9       11      graded         six days late, no more than two fifths
s08      -     6     -      6       11      incomplete     came in after the end
s09      5     6     -      11      11      graded         as late as s06, with an extension
s10      -     6     -      6       6       graded         excused from sheet one
s11      5     6     -      11      11      graded         turned signs, which were accepted for all
s12      5     6     -      11      11      graded         turned signs, whose complaint it was
s13      5     6     -      11      11      graded         turned signs, handed in after that
s14      5     6     -      11      11      graded         wrong first, then right
s15      5     6     -      11      11      graded         right first, then wrong
s16      3.5   6     -      9.5     11      graded         wrong in time, right three days late
s17      3     6     -      9       11      graded         wrong, and a point for the way by hand
s18      2     6     -      8       11      graded         wrong, and stays so
s19      5     6     -      11      11      graded         came by Moodle
s20      4.5   6     -      10.5    11      graded         came by Moodle, a day late
s21      5     6     -      11      11      graded         came by Canvas
s22      5     6     -      11      11      graded         a notebook
s23      5     -     -      5       11      incomplete     nothing for sheet two
s24      5     ?     -      -       11      not_graded     an argument that nobody read yet
s25      -     -     -      -       11      no_submission
s26      5     6     -      11      11      graded
s27      5     6     -      11      11      graded
s28      5     6     -      11      11      graded
s29      5     6     -      11      11      graded
s30      5     6     -      11      11      graded         joined late, with an extension
"""
MOODLE = """Identifier,"Full name","ID number",Status,Grade,"Maximum grade","Grade can be changed","Last modified (submission)","Last modified (grade)","Feedback comments"
"Participant 9019","Student Number19",s19,"Submitted for grading",,5.00,Yes,"Thursday, 8 October 2026, 11:00 PM",-,
"Participant 9020","Student Number20",s20,"Submitted for grading",,5.00,Yes,"Friday, 9 October 2026, 11:00 PM",-,
"Participant 9025","Student Number25",s25,"No submission",,5.00,Yes,-,-,
"""
CANVAS = """Student,ID,SIS User ID,SIS Login ID,Section,Sheet one (81)
    Points Possible,,,,,5
"Number21, Student",4721,s21,s21,A,
"Number16, Student",4716,s16,s16,A,
"Number25, Student",4725,s25,s25,A,
"""


class Term:
    """A course folder, and what an instructor types there."""

    def __init__(self, folder, kinegrade):
        self.folder = folder
        self._kinegrade = kinegrade

    @property
    def course(self):
        return read_course(self.folder)

    def do(self, *arguments, code=0):
        ran = self._kinegrade(*arguments, "--course", str(self.folder))
        assert ran.code == code, ran.err
        return ran

    def give(self, student, answers, at=EARLY, name="one.json"):
        path = hand_in(self.course, student, answers, name)
        os.utime(path, (at.timestamp(), at.timestamp()))

    def lever(self, student):
        return right_answers(self.course, student)

    def turned(self, student):
        right = self.lever(student)
        return {**right, "lever_J": -np.asarray(right["lever_J"])}

    def wrong(self, student):
        right = self.lever(student)
        return {**right, "lever_J": np.asarray(right["lever_J"]) + 0.37}

    def crank(self, student, sheet="two", *, by=0.0):
        """What is true, whatever the exercise file says; off by so much."""
        numbers = self.numbers(sheet)[student]
        tip = numbers["r"] * np.array([np.cos(numbers["q"]), np.sin(numbers["q"])])
        return {"crank_p": tip + by, "crank_why": WHY}

    def numbers(self, sheet):
        with Gradebook(self.folder / "gradebook.sqlite") as gradebook:
            return {record.student: record.numbers for record in gradebook.records(sheet)}

    def exercise(self, text):
        (self.folder / "exercises" / "crank.py").write_text(text, encoding="utf-8")

    def grades(self):
        text = (self.folder / "grades.csv").read_text(encoding="utf-8-sig")
        return {row["student"]: row for row in csv.DictReader(io.StringIO(text))}

    def mark_arguments(self, sheet, marks):
        """Marks arguments from a file in which codes stand for students: points, or ticks."""
        file = self.folder / "arguments.csv"
        file.unlink(missing_ok=True)
        self.do("marks", "write", str(file), sheet, "--blind")
        rows = list(csv.DictReader(io.StringIO(file.read_text(encoding="utf-8-sig"))))
        with Gradebook(self.folder / "gradebook.sqlite") as gradebook:
            codes = variant_codes(gradebook.records(sheet))
        of_code = {code: student for student, code in codes.items()}
        for row in rows:
            row.update(marks.get(of_code[row["student"]], {}))
        out = io.StringIO()
        writer = csv.DictWriter(out, rows[0])
        writer.writeheader()
        writer.writerows(rows)
        file.write_text(out.getvalue(), encoding="utf-8")
        self.do("marks", "read", str(file), "--marker", "ann")


def table():
    """The table by hand, by student; what is said behind it is for readers."""
    heading, *lines = BY_HAND.strip().splitlines()
    names = heading.split()
    return {line.split()[0]: dict(zip(names, line.split(), strict=False)) for line in lines}


def test_after_a_term_every_mark_is_the_one_of_a_table_by_hand(tmp_path, kinegrade):
    term = Term(make_course(tmp_path / "course", students=CLASS[:29], more=SHEETS), kinegrade)
    settings = term.folder / "course.toml"
    settings.write_text(
        'timezone = "Europe/Berlin"\n' + settings.read_text(encoding="utf-8"), encoding="utf-8"
    )
    term.exercise(MISPRINTED)
    term.do("generate")
    sheet_one(term, tmp_path)
    complaint(term)
    late_joiner(term)
    sheet_two(term)
    resit(term)
    by_the_end(term)
    handed_back(term, tmp_path)
    next_year(term, tmp_path)


def sheet_one(term, tmp_path):
    """Everybody hands in, in all the ways in which people do."""
    plain = ["s01", "s02", "s03", "s04", "s05", "s23", "s24", "s26", "s27", "s28", "s29"]
    for student in plain:
        term.give(student, term.lever(student))
    for student, days in (("s06", 2), ("s07", 6), ("s08", 9), ("s09", 2)):
        term.give(student, term.lever(student), DEADLINE + timedelta(days=days))
    for student in ("s11", "s12"):
        term.give(student, term.turned(student))
    for student in ("s14", "s16", "s17", "s18"):
        term.give(student, term.wrong(student))
    term.give("s15", term.lever("s15"))
    cells = [f"{name} = {value.tolist()}" for name, value in term.lever("s22").items()]
    term.give("s22", notebook("from math import *", *cells), name="one.ipynb")
    by_moodle_and_canvas(term, tmp_path)

    term.do("extend", "s09", "one", "--until", "2026-10-11T23:59", "--reason", "ill")
    term.do("excuse", "s10", "one", "--reason", "joined from another course")
    term.do("grade", "one")
    second_files = {"s14": term.lever("s14"), "s15": term.wrong("s15"), "s16": term.lever("s16")}
    for student, answers in second_files.items():
        late = timedelta(days=3) if student == "s16" else timedelta()
        term.give(student, answers, DEADLINE + late)
    term.do("grade", "one")
    term.do("marks", "set", "s17", "lever_J", "1", "--comment", "The way is right.")


def by_moodle_and_canvas(term, tmp_path):
    """Downloads as these systems write them, with what their tables say."""
    files = {}
    for student in ("s19", "s20"):
        name = f"Student Number{student[1:]}_90{student[1:]}_assignsubmission_file"
        files[f"{name}/one.json"] = as_json(term.lever(student))
    moodle = tmp_path / "moodle.zip"
    moodle.write_bytes(zip_bytes(files))
    (tmp_path / "moodle.csv").write_text(MOODLE, encoding="utf-8")
    term.do("collect", moodle, "--worksheet", tmp_path / "moodle.csv", "--sheet", "one")
    canvas = tmp_path / "canvas.zip"
    canvas.write_bytes(
        zip_bytes({"number21student_4721_88001_one.json": as_json(term.lever("s21"))})
    )
    (tmp_path / "canvas.csv").write_text(CANVAS, encoding="utf-8")
    times = ("--received", "2026-10-08T20:00")  # Canvas's download has none
    table_of = ("--worksheet", tmp_path / "canvas.csv", "--sheet", "one")
    term.do("collect", canvas, *table_of, *times)


def as_json(answers):
    return json.dumps(
        {name: np.asarray(value).tolist() for name, value in answers.items()}
    ).encode()


def complaint(term):
    """What was told stays until it is told again; who complained is right, and so are all others."""
    told = term.do("publish", "one")
    assert "26 results published, 0 changed" in told.err
    hand_in(
        term.course, "s12", b"lever_J: the sheet does not say which way is up", "one.request.txt"
    )
    assert "s12  one  lever_J  open" in term.do("marks", "requests").out
    accept = ("accept", "one", "lever_J", "--like", "s11", "--reason", "The sheet left it open.")
    moved = term.do(*accept, "--dry-run").out.splitlines()
    assert [line.split()[0] for line in moved] == ["s11", "s12"]
    term.do(*accept, "--yes")
    term.do("marks", "set", "s12", "lever_J", "--comment", "You are right.", "--sheet", "one")
    assert term.do("marks", "requests").out == ""
    term.do("report")
    assert term.grades()["s11"]["one_points"] == "3.5"  # as was told
    changed = term.do("publish", "one").out.splitlines()
    assert changed == moved
    assert term.grades()["s11"]["one_points"] == "5"


def late_joiner(term):
    """Somebody joins, and somebody hands in what was accepted before."""
    enrol(term.folder, CLASS)
    before = (term.folder / "released" / "s01" / "one.ipynb").read_bytes()
    term.do("generate")
    assert (term.folder / "released" / "s01" / "one.ipynb").read_bytes() == before
    term.do("extend", "s30", "one", "--until", "2026-10-20T23:59", "--reason", "joined late")
    term.give("s30", term.lever("s30"), DEADLINE + timedelta(days=8))
    term.give("s13", term.turned("s13"))
    term.do("grade", "one")
    term.do("publish", "one")


def sheet_two(term):
    """A misprint in an exercise is found after the marks, and mended for everybody."""
    for student, _ in CLASS:
        if student not in ("s23", "s25"):
            off = 0.5 if student in ("s04", "s05") else 0.0
            term.give(student, term.crank(student, by=off), name="two.json")
    term.do("grade", "two")
    assert float(term.grades()["s26"]["two/crank_p"]) < 4

    term.exercise(CRANK)
    term.do("grade", "two")
    assert term.grades()["s26"]["two_status"] == "not_graded"
    term.do("grade", "two", "--accept-change")
    marks = {student: {"ticks": "1,2"} for student, _ in CLASS}
    marks["s03"] = {"ticks": "1"}
    for student in ("s02", "s04", "s05"):
        marks[student] = {"points": "0"}
    del marks["s24"]
    term.mark_arguments("two", marks)
    term.do("regrade", "two")


def resit(term):
    """Two come again, with numbers of their own."""
    two, again = term.numbers("two"), term.numbers("again")
    assert two["s04"] != again["s04"]
    term.give("s04", term.crank("s04", "again"), name="again.json")
    term.give("s05", term.crank("s05", "again", by=0.5), name="again.json")
    term.do("grade", "again", "--accept-change")  # its sheets were drawn with the misprint, too
    term.mark_arguments("again", {"s04": {"ticks": "1,2"}, "s05": {"points": "0"}})
    term.do("report")


def by_the_end(term):
    grades = term.grades()
    found = {}
    for student in table():
        row = grades[student]
        cells = [row["one_points"], row["two_points"], row["again_points"]]
        found[student] = [*cells, row["points"], row["out_of"], row["status"]]
    wanted = {}
    for student, row in table().items():
        cells = [row[name] for name in ("one", "two", "again", "points", "out_of", "status")]
        wanted[student] = ["" if cell in ("-", "?") else cell for cell in cells]
    assert found == wanted


def handed_back(term, tmp_path):
    """Both systems get the points of the table, and nothing for who handed in nothing."""
    term.do("handback", "one", "--to", "moodle", "--worksheet", tmp_path / "moodle.csv")
    rows = read(term.folder / "exchange" / "one-moodle.csv")
    assert {row["ID number"]: row["Grade"] for row in rows} == {"s19": "5", "s20": "4.5", "s25": ""}
    term.do("handback", "one", "--to", "canvas", "--worksheet", tmp_path / "canvas.csv")
    rows = read(term.folder / "exchange" / "one-canvas.csv")[1:]
    points = {row["SIS User ID"]: row["Sheet one (81)"] for row in rows}
    assert points == {"s21": "5", "s16": "3.5", "s25": ""}


def read(path):
    return list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8-sig"))))


def next_year(term, tmp_path):
    """Nothing that was decided is forgotten."""
    told = term.do("gradebook", "history", "s12", "one").out
    for event in ("marks published", "asked about lever_J", "commented on"):
        assert event in told
