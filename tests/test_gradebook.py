"""The gradebook keeps what it was given, all of a change or nothing, and knows what is no gradebook."""

import sqlite3
from dataclasses import replace

import pytest
from kinegrade.course.config import CourseError
from kinegrade.course.gradebook import Gradebook, GradeKey
from kinegrade.course.variant import Record
from kinegrade.grader.marking.verdict import Finding, Verdict, not_graded

RECORD = Record(
    "ada", "one", "lever", 3, {"L": 0.1, "q": [0.30000000000000004]}, {"lever_p": [[1e-9, -2.5]]}
)
KEY = GradeKey("ada", "one", "bytes", "rules")
VERDICTS = [
    Verdict(
        "lever_p",
        "partly",
        1.25,
        2,
        (Finding("Ø", private=True), Finding("two")),
        "read",
        [True],
        [0.5],
    ),
    not_graded("lever_J", 3, "wait"),
]


@pytest.fixture
def gradebook(tmp_path):
    with Gradebook(tmp_path / "gradebook.sqlite") as opened:
        yield opened


def test_records_come_back_as_they_were_saved_and_by_sheet(gradebook):
    gradebook.save_records([RECORD, replace(RECORD, sheet="two")])
    assert gradebook.records("one") == [RECORD]
    assert gradebook.records("three") == []


def test_records_of_one_save_are_kept_together_or_not_at_all(gradebook):
    gradebook.save_records([RECORD])
    with pytest.raises(CourseError, match="UNIQUE constraint failed"):
        gradebook.save_records([replace(RECORD, student="ben"), RECORD])
    assert gradebook.records("one") == [RECORD]


def test_accepted_answers_replace_those_of_one_record(gradebook):
    other = replace(RECORD, student="ben")
    gradebook.save_records([RECORD, other])
    gradebook.accept_answers(RECORD, {"lever_p": [2.0]})
    assert gradebook.records("one") == [replace(RECORD, answers={"lever_p": [2.0]}), other]


def test_verdicts_come_back_as_they_were_saved(gradebook):
    gradebook.save_grade(KEY, VERDICTS)
    assert gradebook.verdicts(KEY) == VERDICTS
    assert gradebook.current("one") == {"ada": VERDICTS}


def test_what_was_never_marked_has_no_verdicts(gradebook):
    gradebook.save_grade(KEY, VERDICTS)
    for name in ("student", "sheet", "submission", "rules"):
        assert gradebook.verdicts(replace(KEY, **{name: "other"})) is None
    assert gradebook.current("two") == {}


def test_the_grade_saved_last_is_the_current_one_and_the_others_are_kept(gradebook):
    later, better = replace(KEY, submission="new bytes"), [replace(VERDICTS[0], points=2.0)]
    gradebook.save_grade(KEY, VERDICTS)
    gradebook.save_grade(later, better)
    assert gradebook.current("one") == {"ada": better}
    assert gradebook.verdicts(KEY) == VERDICTS
    gradebook.make_current(KEY)
    assert gradebook.current("one") == {"ada": VERDICTS}
    assert gradebook.verdicts(later) == better


def test_half_a_grade_is_never_kept(gradebook, monkeypatch):
    gradebook.save_grade(KEY, VERDICTS)
    monkeypatch.setattr("kinegrade.course.gradebook._current.insert", lambda: 1 / 0, raising=False)
    with pytest.raises(ZeroDivisionError):
        gradebook.save_grade(replace(KEY, submission="new bytes"), VERDICTS[:1])
    monkeypatch.undo()
    assert gradebook.current("one") == {"ada": VERDICTS}
    assert gradebook.verdicts(replace(KEY, submission="new bytes")) is None


def test_a_gradebook_is_read_again_by_the_next_run(tmp_path):
    for _ in range(2):
        with Gradebook(tmp_path / "g.sqlite") as gradebook:
            gradebook.save_grade(KEY, VERDICTS)
    with Gradebook(tmp_path / "g.sqlite") as gradebook:
        assert gradebook.current("one") == {"ada": VERDICTS}


@pytest.mark.parametrize("folder", ["a b", "what?", "50%41", "a#b", "ü&x=1", "file:x", ":memory:"])
def test_a_folder_may_have_any_name(tmp_path, folder):
    (tmp_path / folder).mkdir()
    with Gradebook(tmp_path / folder / "gradebook.sqlite") as gradebook:
        gradebook.save_records([RECORD])
    assert [path.name for path in (tmp_path / folder).iterdir()] == ["gradebook.sqlite"]


def test_a_file_that_is_no_database_is_refused_and_left_as_it_is(tmp_path):
    path = tmp_path / "gradebook.sqlite"
    path.write_bytes(b"student,points\nada,5\n" * 100)
    with pytest.raises(
        CourseError,
        match=r"gradebook.sqlite: not a gradebook that can be used: file is not a database",
    ):
        Gradebook(path)
    assert path.read_bytes() == b"student,points\nada,5\n" * 100


def test_a_folder_in_the_place_of_the_gradebook_is_refused(tmp_path):
    with pytest.raises(CourseError, match="not a gradebook that can be used: unable to open"):
        Gradebook(tmp_path)


def test_a_missing_folder_is_refused(tmp_path):
    with pytest.raises(CourseError, match="unable to open database file"):
        Gradebook(tmp_path / "nowhere" / "gradebook.sqlite")


def test_an_empty_file_is_a_new_gradebook(tmp_path):
    (tmp_path / "gradebook.sqlite").touch()
    with Gradebook(tmp_path / "gradebook.sqlite") as gradebook:
        assert gradebook.records("one") == []


def test_a_later_format_is_refused(tmp_path):
    path = tmp_path / "gradebook.sqlite"
    Gradebook(path).close()
    with sqlite3.connect(path) as connection:
        connection.execute("UPDATE meta SET value = '99'")
    connection.close()
    with pytest.raises(CourseError, match="the gradebook has format 99; this version reads 1"):
        Gradebook(path)


def test_a_gradebook_that_breaks_later_says_so(tmp_path):
    path = tmp_path / "gradebook.sqlite"
    with Gradebook(path) as gradebook:
        gradebook.save_records([RECORD])
        with sqlite3.connect(path) as connection:
            connection.execute("DROP TABLE record")
        connection.close()
        with pytest.raises(CourseError, match="no such table: record"):
            gradebook.records("one")
