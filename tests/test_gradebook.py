"""The gradebook keeps all that it was ever given, on SQLite and PostgreSQL, all of a change or nothing."""

import json
import sqlite3
import stat
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from kinegrade.course.ledger import database
from kinegrade.course.ledger.gradebook import Gradebook, GradeKey, Mark, OvertakenError
from kinegrade.course.ledger.tables import reference
from kinegrade.course.settings.config import CourseError
from kinegrade.course.variants.variant import Record
from kinegrade.grader.marking.verdict import Finding, Verdict, not_graded
from sqlalchemy import event, select

RECORD = Record(
    "ada", "one", "lever", 3, {"L": 0.1, "q": [0.30000000000000004]}, {"lever_p": [[1e-9, -2.5]]}
)
BEN = replace(RECORD, student="ben", numbers={"L": 0.2, "q": [0.5]})
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


MARK = Mark("ada", "one", "lever_p", 1.5, "neat", "abcd1234")


@pytest.fixture
def gradebook(place):
    with Gradebook(place) as opened:
        yield opened


def told(gradebook, student="ada", sheet="one"):
    return [event.what for event in gradebook.history(student, sheet)]


def test_records_come_back_as_they_were_saved_and_by_sheet(gradebook):
    gradebook.save_records([RECORD])
    gradebook.save_records([replace(RECORD, sheet="two")])
    assert gradebook.records("one") == [RECORD]
    assert gradebook.records("three") == []


def test_records_of_one_save_are_kept_together_or_not_at_all(gradebook):
    gradebook.save_records([RECORD])
    with pytest.raises(OvertakenError, match="another kinegrade drew numbers of lever, sheet one"):
        gradebook.save_records([BEN, replace(RECORD, numbers={"L": 9})])
    assert gradebook.records("one") == [RECORD]
    assert told(gradebook, "ben") == []


def test_numbers_that_somebody_else_has_are_not_saved(gradebook):
    gradebook.save_records([RECORD])
    with pytest.raises(OvertakenError, match="while those of ben were drawn"):
        gradebook.save_records([replace(RECORD, student="ben")])
    gradebook.save_records([replace(RECORD, student="ben", exercise="other")])
    assert [record.student for record in gradebook.records("one")] == ["ada", "ben"]


def test_accepted_answers_count_for_one_record_and_the_old_ones_are_kept(gradebook):
    gradebook.save_records([RECORD])
    gradebook.save_records([BEN])
    gradebook.accept_answers(RECORD, {"lever_p": [2.0]}, "a wrong sign")
    assert gradebook.records("one") == [replace(RECORD, answers={"lever_p": [2.0]}), BEN]
    drawn, accepted = gradebook.history("ada", "one")
    assert (drawn.what, drawn.reason) == ("lever drawn, attempt 3", "")
    assert accepted.what == "other reference answers of lever accepted"
    assert accepted.reason == "a wrong sign"
    with gradebook.database.reading() as connection:
        kept = connection.execute(select(reference.c.answers).order_by(reference.c.entry))
        assert [json.loads(text) for (text,) in kept] == [
            RECORD.answers,
            BEN.answers,
            {"lever_p": [2.0]},
        ]


def test_verdicts_come_back_as_they_were_saved(gradebook):
    gradebook.save_grades({KEY: VERDICTS})
    assert gradebook.graded([KEY]).get(KEY) == VERDICTS
    assert gradebook.current("one") == {"ada": VERDICTS}


def test_what_was_never_marked_has_no_verdicts(gradebook):
    gradebook.save_grades({KEY: VERDICTS})
    for name in ("student", "sheet", "submission", "rules"):
        assert gradebook.graded([replace(KEY, **{name: "other"})]) == {}
    assert gradebook.current("two") == {}


def test_the_grade_saved_last_is_the_current_one_and_the_others_are_kept(gradebook):
    later, better = replace(KEY, submission="new bytes"), [replace(VERDICTS[0], points=2.0)]
    gradebook.save_grades({KEY: VERDICTS})
    gradebook.save_grades({later: better})
    assert gradebook.current("one") == {"ada": better}
    assert gradebook.graded([KEY]).get(KEY) == VERDICTS
    gradebook.make_current([KEY])
    assert gradebook.current("one") == {"ada": VERDICTS}
    assert gradebook.graded([later]).get(later) == better


def test_half_a_grade_is_never_kept(gradebook):
    gradebook.save_grades({KEY: VERDICTS})

    def broken(_connection, _cursor, statement, *_):
        if statement.startswith("INSERT INTO counted"):  # after its verdicts
            raise ZeroDivisionError

    engine = gradebook.database._engine
    event.listen(engine, "before_cursor_execute", broken)
    with pytest.raises(ZeroDivisionError):
        gradebook.save_grades({replace(KEY, submission="new bytes"): VERDICTS[:1]})
    event.remove(engine, "before_cursor_execute", broken)
    assert gradebook.current("one") == {"ada": VERDICTS}
    assert gradebook.graded([replace(KEY, submission="new bytes")]) == {}


def test_several_grades_go_together(gradebook):
    better = [replace(VERDICTS[0], points=2.0)]
    grace = replace(KEY, student="grace")
    gradebook.save_grades({KEY: VERDICTS})
    gradebook.save_grades({KEY: VERDICTS, grace: better})  # the first is no news
    assert gradebook.current("one") == {"ada": VERDICTS, "grace": better}
    assert len(gradebook.history("ada", "one")) == 2
    assert len(gradebook.history("grace", "one")) == 2


def test_a_gradebook_is_read_again_by_the_next_run(place):
    for _ in range(2):
        with Gradebook(place) as gradebook:
            gradebook.save_grades({KEY: VERDICTS})
    with Gradebook(place) as gradebook:
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


def test_a_full_disk_leaves_what_was_recorded_and_is_said(tmp_path, monkeypatch):
    path = tmp_path / "gradebook.sqlite"
    with Gradebook(path) as gradebook:
        gradebook.save_records([RECORD])
    set_up = database._set_up

    def without_room(connection, record):
        set_up(connection, record)
        connection.execute("PRAGMA max_page_count = 1")  # SQLite takes those that there are

    monkeypatch.setattr(database, "_set_up", without_room)
    with Gradebook(path) as gradebook, pytest.raises(CourseError, match="the disk is full; what"):
        gradebook.save_records([replace(BEN, numbers={"q": 100_000 * [0.5]})])
    monkeypatch.undo()
    with Gradebook(path) as gradebook:
        assert gradebook.records("one") == [RECORD]


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


def test_a_gradebook_that_breaks_later_says_so(tmp_path):
    path = tmp_path / "gradebook.sqlite"
    with Gradebook(path) as gradebook:
        gradebook.save_records([RECORD])
        with sqlite3.connect(path) as connection:
            connection.execute("DROP TABLE record")
        connection.close()
        with pytest.raises(CourseError, match="no such table: record"):
            gradebook.records("one")


def test_a_new_gradebook_is_its_owners_alone_as_the_secret_is(tmp_path):
    path = tmp_path / "gradebook.sqlite"
    with Gradebook(path) as gradebook:
        gradebook.save_records([RECORD])
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    path.chmod(0o660)  # what an owner shares on purpose stays so
    with Gradebook(path) as gradebook:
        gradebook.save_records([BEN])
    assert stat.S_IMODE(path.stat().st_mode) == 0o660


def test_marks_by_hand_count_by_the_last_and_keep_author_time_and_reason(gradebook):
    gradebook.save_marks([MARK, replace(MARK, part="lever_J", points=1)], author="Ina")
    gradebook.save_marks([MARK])  # nothing new
    better = replace(MARK, points=2)
    gradebook.save_marks([better], author="Olaf", reason="second opinion")
    assert gradebook.marks("one") == {
        ("ada", "lever_p"): better,
        ("ada", "lever_J"): replace(MARK, part="lever_J", points=1),
    }
    events = gradebook.history("ada", "one")
    assert [(one.author, one.what, one.reason) for one in events] == [
        ("Ina", "lever_p marked by hand: 1.5 points, 'neat'", ""),
        ("Ina", "lever_J marked by hand: 1.0 points, 'neat'", ""),
        ("Olaf", "lever_p marked by hand: 2.0 points, 'neat'", "second opinion"),
    ]
    times = [datetime.fromisoformat(one.at) for one in events]
    assert times == sorted(times)
    assert abs(datetime.now(UTC) - times[-1]) < timedelta(minutes=10)


def test_all_that_happened_to_a_sheet_is_told_in_its_order(gradebook):
    later, full = replace(KEY, submission="new bytes"), [replace(VERDICTS[0], points=2.0)]
    gradebook.save_records([RECORD])
    gradebook.save_records([BEN])
    gradebook.see([KEY, replace(KEY, student="ben"), KEY])
    gradebook.save_grades({KEY: VERDICTS})
    gradebook.save_grades({KEY: VERDICTS})  # the same again is no news
    gradebook.save_grades({later: full})
    gradebook.make_current([KEY])
    gradebook.make_current([KEY])
    gradebook.save_grades({KEY: full})
    assert told(gradebook) == [
        "lever drawn, attempt 3",
        "submission bytes seen first",
        "submission bytes marked: 1.25 of 5, not graded: 1",
        "submission new byte seen first",
        "submission new byte marked: 2 of 2",
        "the earlier marks of submission bytes count again: 1.25 of 5, not graded: 1",
        "submission bytes marked: 2 of 2",
    ]
    assert told(gradebook, "ben") == ["lever drawn, attempt 3", "submission bytes seen first"]
    assert told(gradebook, "ada", "two") == []


def test_no_row_is_ever_overwritten_or_taken_out(place):
    with Gradebook(place) as gradebook:
        said = []
        engine = gradebook.database._engine
        event.listen(
            engine, "before_cursor_execute", lambda *parts: said.append(parts[2].split()[0])
        )
        gradebook.save_records([RECORD])
        gradebook.accept_answers(RECORD, {"lever_p": [2.0]})
        for points in (1.0, 2.0, 1.0):
            gradebook.save_grades({KEY: [replace(VERDICTS[0], points=points)]})
            gradebook.save_marks([replace(MARK, points=points)])
        gradebook.save_grades({replace(KEY, submission="new bytes"): VERDICTS})
        gradebook.make_current([KEY])
        assert gradebook.marks("one")["ada", "lever_p"].points == 1
        assert gradebook.current("one")["ada"][0].points == 1
    assert "INSERT" in said
    assert {"UPDATE", "DELETE", "REPLACE", "DROP"} & set(said) == set()


@pytest.mark.parametrize(
    "text", ["a\0b", "half a pair \ud800", "\x1b[31m", "'; DROP TABLE mark; --", "100 %s :x"]
)
def test_any_text_of_a_student_can_be_kept(gradebook, text):
    hostile = replace(VERDICTS[0], findings=(Finding(text),), reading=text, answer=text)
    gradebook.save_grades({KEY: [hostile]})
    (back,) = gradebook.graded([KEY])[KEY]
    assert back.answer == text
    shown = text.replace("\0", "\ufffd").replace("\ud800", "?")
    assert (back.reading, back.findings) == (shown, (Finding(shown),))
    gradebook.save_grades({KEY: [hostile]})
    assert len(told(gradebook)) == 2  # seen and marked, once
    gradebook.save_marks([replace(MARK, comment=text)])
    assert gradebook.marks("one")["ada", "lever_p"].comment == shown


def test_many_submissions_are_looked_up_at_once_and_count_again_together(place):
    """More than fit one statement, some of them never marked, and one with a newer grade."""
    keys = [replace(KEY, student=f"s{i}") for i in range(450)]
    with Gradebook(place) as gradebook:
        for key in keys[::50]:
            gradebook.save_grades({key: VERDICTS})
        later = replace(keys[0], submission="new bytes")
        gradebook.save_grades({later: VERDICTS[:1]})
        gradebook.see(keys)
        gradebook.see(keys)
        assert gradebook.graded(keys) == dict.fromkeys(keys[::50], VERDICTS)
        assert gradebook.current(KEY.sheet)["s0"] == VERDICTS[:1]
        before = len(gradebook.history("s50", KEY.sheet))
        gradebook.make_current(keys)
        assert gradebook.current(KEY.sheet)["s0"] == VERDICTS
        assert len(gradebook.history("s50", KEY.sheet)) == before
        assert len(gradebook.history("s1", KEY.sheet)) == 1
        assert gradebook.graded([]) == {}
