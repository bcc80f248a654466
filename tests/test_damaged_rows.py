"""One damaged row costs one student, named: every column of every table that marks follow from."""

import csv
import io
import shutil
import sqlite3
from contextlib import closing

import pytest
from courses import hand_in, handed_out, make_course, marked, right_answers
from kinegrade.course.ledger.entries import Change
from kinegrade.course.ledger.gradebook import Gradebook, Mark
from kinegrade.course.ledger.tables import LEDGER
from kinegrade.course.ledger.term import Acceptance, Extension
from kinegrade.course.marking.second_looks import publish, to_publish
from kinegrade.course.marking.written import write_recorded
from kinegrade.course.sheet.about import REQUEST
from kinegrade.course.term.opinions import answer_id
from sqlalchemy import Integer, select

TIMED = 'deadline = "2099-06-30 23:59"\nlate_percent = 10\n'
VALUES = {"bytes": "x'ff'", "nonsense": "'nonsense'"}


def takes_anything(column):
    """Whether SQLite keeps any value in it; the number that a row goes by takes integers alone."""
    is_only_key = column.primary_key and len(column.table.primary_key) == 1
    return not (is_only_key and isinstance(column.type, Integer))


COLUMNS = [
    (table.name, column.name)
    for table in LEDGER.sorted_tables
    for column in table.c
    if table.name != "alembic_version" and takes_anything(column)
]
OF_BEN = {
    "entry": "id IN (SELECT entry FROM extension WHERE student = 'ben')",
    "verdict": "place = 1 AND grade IN (SELECT entry FROM grade WHERE student = 'ben')",
    "finding": "grade IN (SELECT entry FROM grade WHERE student = 'ben')",
    "level": "1",
    "acceptance": "1",
}
"""Which rows are damaged: of ben alone, where a row is somebody's."""
NOBODYS = ("entry", "level", "acceptance", "grade", "submission", "counted")
"""Tables without a student, or whose rows only lead to others: without them, these are not found."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A course with a row in every table: all is marked, and ben's sheet by hand, too."""
    folder = tmp_path_factory.mktemp("whole") / "course"
    course = handed_out(make_course(folder, more=TIMED))
    sheet = course.settings.sheet[0]
    for student in course.students:
        right = right_answers(course, student.id)
        hand_in(course, student.id, right | {"lever_J": [1.0, 2.0, 3.0]})
    request = folder / "submitted" / "ben" / f"one{REQUEST}"
    request.write_text("lever_J: why?", encoding="utf-8")

    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        marked(course, gradebook)
        ben = gradebook.current("one")["ben"]
        mark = Mark("ben", "one", "lever_J", 1.5, "neat", answer_id(ben[1]))
        gradebook.save_marks([mark])
        gradebook.term.extend("ben", "one", Extension(), Change(reason="ill"))
        accepted = Acceptance("one", "lever_J", "finding", "nobody has it", 1.0)
        gradebook.term.accept(accepted, Change())
        gradebook.note_level("strong")
        found = to_publish(course, gradebook, sheet)
        publish(gradebook, sheet, found, Change())
        write_recorded(course, gradebook)
        with gradebook.database.reading() as connection:
            for table in LEDGER.sorted_tables:
                assert connection.execute(select(table)).first(), table.name
    return folder


@pytest.fixture
def course(whole, tmp_path):
    """A copy of it."""
    return shutil.copytree(whole, tmp_path / "course")


def damaged(folder, statement):
    """Damages rows, and says how many."""
    with closing(sqlite3.connect(folder / "gradebook.sqlite")) as connection, connection:
        return connection.execute(statement).rowcount


def rows(folder):
    text = (folder / "grades.csv").read_text(encoding="utf-8-sig")
    return {row["student"]: row for row in csv.DictReader(io.StringIO(text))}


@pytest.mark.parametrize("value", VALUES)
@pytest.mark.parametrize(("table", "column"), COLUMNS)
def test_a_damaged_cell_never_costs_anybody_else(course, kinegrade, table, column, value):
    before = rows(course)
    if table != "published":  # what students were told would stand in the way of what is so today
        assert damaged(course, "DELETE FROM published")
    where = OF_BEN.get(table, "student = 'ben'")
    statement = f"UPDATE {table} SET {column} = {VALUES[value]} WHERE {where}"  # noqa: S608
    assert damaged(course, statement)
    for command in ("report", "grade"):
        ran = kinegrade(command, "-c", course)
        assert "our fault" not in ran.err
        assert ran.code == 0, ran.err
        if command == "report" and value == "bytes" and _is_named(table, column):
            assert "ben cannot be read: a row of the gradebook is damaged" in ran.err
        after = rows(course)
        assert {name: row for name, row in after.items() if name != "ben"} == {
            name: row for name, row in before.items() if name != "ben"
        }


def _is_named(table, column):
    """Whether a row is still found without this cell, and is one student's."""
    return (
        table not in NOBODYS
        and not LEDGER.tables[table].c[column].primary_key
        and column != "entry"
    )


def changed(course, kinegrade, statement, command="report"):
    """Ben's line in grades.csv once his row is damaged and a command was run, and what it said."""
    damaged(course, "DELETE FROM published")
    assert damaged(course, statement)
    ran = kinegrade(command, "-c", course)
    assert ran.code == 0, ran.err
    return rows(course)["ben"], ran.err


def test_a_damaged_mark_leaves_the_sheet_open_and_is_named(course, kinegrade):
    for command in ("report", "grade"):
        ben, err = changed(
            course, kinegrade, "UPDATE mark SET points = 'x' WHERE student = 'ben'", command
        )
        assert (ben["status"], ben["points"]) == ("not_graded", "")
        assert (
            "Sheet one: the mark of lever_J of ben cannot be read: a row of the gradebook is "
            "damaged; `kinegrade marks set` enters it."
        ) in err
    report = (course / "report" / "index.html").read_text(encoding="utf-8")
    assert "the mark of lever_J of ben cannot be read" in report


OF_BENS_GRADE = "grade IN (SELECT entry FROM grade WHERE student = 'ben')"


@pytest.mark.parametrize(
    "damage",
    [
        "UPDATE verdict SET points = 1000 WHERE place = 0 AND",
        "UPDATE verdict SET points = -1 WHERE place = 0 AND",
        "DELETE FROM verdict WHERE place = 0 AND",
        "DELETE FROM verdict WHERE place = 1 AND",
        "DELETE FROM verdict WHERE",
        "UPDATE counted SET grade = 99999 WHERE student = 'ben' AND",
    ],
)
def test_a_grade_that_cannot_be_is_not_believed_and_marked_anew(course, kinegrade, damage):
    before = rows(course)["ben"]
    ben, err = changed(course, kinegrade, f"{damage} {OF_BENS_GRADE}")
    assert (ben["status"], ben["points"]) == ("not_graded", "")
    assert "the grade of ben " in err
    assert "`kinegrade grade` marks anew" in err
    assert kinegrade("grade", "-c", course).code == 0
    assert rows(course)["ben"] == before


OTHERS = (
    ("gradebook", "history", "ben"),
    ("gradebook", "copy", "copy.sqlite"),
    ("marks", "list"),
    ("marks", "differing"),
    ("marks", "requests"),
)
"""Commands that read the gradebook for people to look at."""


@pytest.mark.parametrize("value", VALUES)
@pytest.mark.parametrize(("table", "column"), COLUMNS)
def test_whoever_looks_at_a_damaged_cell_gets_no_crash(
    course, kinegrade, monkeypatch, table, column, value
):
    where = OF_BEN.get(table, "student = 'ben'")
    statement = f"UPDATE {table} SET {column} = {VALUES[value]} WHERE {where}"  # noqa: S608
    assert damaged(course, statement)
    monkeypatch.chdir(course)
    for command in OTHERS:
        assert "our fault" not in kinegrade(*command).err, command


def test_a_damaged_grade_of_somebody_who_is_not_marked_now_waits(course, kinegrade):
    damaged(course, "DELETE FROM published")
    assert damaged(course, f"UPDATE verdict SET points = 1000 WHERE {OF_BENS_GRADE}")  # noqa: S608
    assert kinegrade("grade", "--student", "ada", "-c", course).code == 0
    assert rows(course)["ben"]["one_status"] == "not_graded"
