"""`kinegrade gradebook`: the history of a sheet is printed, and a copy holds all there is."""

import re
import sqlite3
import stat

import pytest
from courses import CLASS, enrol, hand_in, handed_out, make_course, right_answers
from kinegrade.course.ledger.entries import Change
from kinegrade.course.ledger.gradebook import Gradebook, Mark
from kinegrade.course.ledger.tables import LEDGER
from kinegrade.course.ledger.term import Extension
from sqlalchemy import select

LINE = r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d  one  \S+  "


@pytest.fixture
def folder(tmp_path, kinegrade):
    """A course in which ada's sheet was marked, twice as her answers changed, and once by hand."""
    course = handed_out(make_course(tmp_path / "course"))
    right = right_answers(course, "ada")
    for answers in ({"lever_p": [9.0, 9.0]}, right):
        hand_in(course, "ada", answers)
        assert kinegrade("grade", "-c", course.folder).code == 0
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        mark = Mark("ada", "one", "lever_p", 2.0, "\x1b[31mneat", "abcd1234")
        gradebook.save_marks([mark], author="Ina", reason="second opinion")
    return course.folder


def rows(place):
    with Gradebook(place) as gradebook, gradebook.database.reading() as connection:
        return {
            name: sorted(map(repr, connection.execute(select(table))))
            for name, table in LEDGER.tables.items()
        }


def test_the_history_of_a_sheet_is_printed_the_oldest_first(kinegrade, folder):
    ran = kinegrade("gradebook", "history", "ada", "-c", folder)
    assert (ran.code, ran.err) == (0, "")
    lines = ran.out.splitlines()
    assert [re.sub(LINE, "", line) for line in lines[:1]] == ["lever drawn, attempt 0"]
    assert [re.sub(r".*submission \w{8} ", "", line) for line in lines[1:5]] == [
        "seen first",
        "marked: 0 of 5",
        "seen first",
        "marked: 5 of 5",
    ]
    assert lines[5].endswith(
        "Ina  lever_p marked by hand: 2.0 points, '\\x1b[31mneat'  (second opinion)"
    )
    assert len(lines) == 6
    assert [line for line in lines if not re.match(LINE, line)] == []


def test_somebody_of_whom_nothing_is_kept_has_no_history(kinegrade, folder):
    assert kinegrade("gradebook", "history", "nobody", "one", "-c", folder).out == ""
    ran = kinegrade("gradebook", "history", "ada", "won", "-c", folder)
    assert (ran.code, "did you mean 'one'?" in ran.err) == (1, True)


def test_a_copy_holds_every_row_and_goes_to_the_other_database_and_back(
    kinegrade, folder, tmp_path, postgres_server
):
    original = rows(folder / "gradebook.sqlite")
    assert len(original["finding"]) + len(original["verdict"]) > 3
    place, back = postgres_server.database(), tmp_path / "back.sqlite"
    there = kinegrade("gradebook", "copy", place, "-c", folder)
    assert there.code == 0, there.err
    assert re.search(
        r"\d+ changes copied from .*gradebook.sqlite to postgresql://this machine/", there.err
    )
    assert rows(place) == original
    assert kinegrade("gradebook", "copy", back, "-c", folder, "--gradebook", place).code == 0
    assert rows(back) == original
    assert stat.S_IMODE(back.stat().st_mode) == 0o600
    marked = kinegrade("grade", "-c", folder, "--gradebook", place)
    assert re.search(r"ada +✓✓ +5 / 5", marked.out)
    assert rows(place) == original  # nothing is new


def test_a_copy_never_goes_over_another_gradebook(kinegrade, folder, tmp_path):
    kept = tmp_path / "kept.sqlite"
    assert kinegrade("gradebook", "copy", kept, "-c", folder).code == 0
    before = rows(kept)
    for target in (kept, folder / "gradebook.sqlite"):
        ran = kinegrade("gradebook", "copy", target, "-c", folder)
        assert ran.code == 1
        assert f"{target} holds a gradebook already; name a new place" in ran.err
    assert rows(kept) == before


def test_nobody_has_no_history_and_who_left_still_has_one(kinegrade, folder):
    ran = kinegrade("gradebook", "history", "adda", "-c", folder)
    assert ran.code == 1
    assert "roster.csv has no student 'adda' (did you mean 'ada'?)" in ran.err

    enrol(folder, CLASS[1:])
    ran = kinegrade("gradebook", "history", "ada", "-c", folder)
    assert (ran.code, "marked: 5 of 5" in ran.out) == (0, True)


@pytest.mark.parametrize(
    ("damage", "named"),
    [
        (
            "UPDATE extension SET excused = 'nonsense'",
            "table extension with student ada, sheet one",
        ),
        ("UPDATE counted SET grade = 99999", "table counted with student ada, sheet one"),
    ],
)
def test_a_damaged_row_that_cannot_be_copied_is_named_and_nothing_is_left(
    kinegrade, folder, tmp_path, damage, named
):
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        gradebook.term.extend("ada", "one", Extension(excused=True), Change())
    with sqlite3.connect(folder / "gradebook.sqlite") as connection:
        connection.execute(damage)
    connection.close()
    ran = kinegrade("gradebook", "copy", tmp_path / "copy.sqlite", "-c", folder)
    assert ran.code == 1
    assert f"gradebook.sqlite: the row of {named}" in " ".join(ran.err.split())
    assert "is damaged, and nothing was copied" in " ".join(ran.err.split())
    assert "SQL" not in ran.err
    assert not (tmp_path / "copy.sqlite").exists()
