"""Behind the gradebook: the first format comes over whole, one writes at a time, a damaged row costs one student."""

import re
import sqlite3
import stat
import subprocess
import sys
from pathlib import Path

import postgres
import pytest
from courses import hand_in, handed_out, make_course, marked, right_answers
from kinegrade.course.handing_out.generate import generate
from kinegrade.course.ledger import database
from kinegrade.course.ledger.address import address, shown, without_password
from kinegrade.course.ledger.entries import user
from kinegrade.course.ledger.gradebook import Gradebook, GradeKey, Mark
from kinegrade.course.ledger.tables import LEDGER, VERSION
from kinegrade.course.results.result import recorded_results
from kinegrade.course.settings.config import CourseError, read_course
from kinegrade.course.variants.variant import Record
from sqlalchemy import create_engine, inspect, text

FIRST = Path(__file__).parent / "data" / "gradebook_format_1.sql"
"""A gradebook as the first version left it: three students, one marked twice, one mark by hand."""
REASON = "taken over from a gradebook that kept no times"
BUSY = "another kinegrade is at work on this course; what was done is kept"


def run_sql(place, *statements):
    """Changes a database behind the gradebook's back."""
    url = f"sqlite:///{place}" if isinstance(place, Path) else address(place)
    engine = create_engine(url)
    with engine.begin() as connection:
        for statement in statements:
            connection.exec_driver_sql(statement.replace("%", "%%"))
    engine.dispose()


@pytest.fixture
def first_format(place):
    dump = FIRST.read_text(encoding="utf-8").replace("BEGIN TRANSACTION;\n", "")
    run_sql(place, *dump.replace("COMMIT;\n", "").split(";\n")[:-1])
    return place


def test_all_of_the_first_format_is_taken_over(first_format):
    with Gradebook(first_format) as gradebook:
        assert [record.student for record in gradebook.records("one")] == ["ada", "ben", "cyd"]
        ada = gradebook.records("one")[0]
        assert ada == Record(
            "ada",
            "one",
            "lever",
            0,
            {"L": 0.82, "q": [1.137]},
            {"lever_p": [0.344661187, 0.744048833], "lever_J": [-0.744048833, 0.344661187]},
        )
        current = gradebook.current("one")
        assert {who: [one.points for one in found] for who, found in current.items()} == {
            "ada": [2, 3],
            "ben": [0, 3],
        }
        assert current["ben"][0].right == [False, False]
        assert gradebook.marks("one") == {
            ("ada", "lever_p"): Mark("ada", "one", "lever_p", 1.5, 'neat; it\'s "good"', "abcd1234")
        }
        earlier = GradeKey(
            "ben", "one", "c6753701cce23439206a3508423c6557", "ba90330a9f7c36bc9bc72f1c00a3e3fc"
        )
        verdicts = gradebook.graded([earlier]).get(earlier)
        assert verdicts is not None
        (finding,) = verdicts[1].findings
        assert finding.text.startswith(
            "Takes numbers of shape (2,), got text: what\ufffd is 'this' Ø"
        )
        events = gradebook.history("ben", "one")
        assert {event.reason for event in events} == {REASON}
        assert [event.what for event in events] == [
            "lever drawn, attempt 0",
            "submission c6753701 seen first",
            "submission c6753701 marked: 0 of 5",
            "submission aa7875e6 seen first",
            "submission aa7875e6 marked: 3 of 5",
            "the earlier marks of submission aa7875e6 count again: 3 of 5",
        ]


def test_numbers_of_the_first_format_are_not_drawn_for_somebody_else(first_format):
    with Gradebook(first_format) as gradebook:
        ada = gradebook.records("one")[0]
        with pytest.raises(CourseError, match="another kinegrade drew"):
            gradebook.save_records([Record("new", "one", "lever", 1, ada.numbers, {})])


def test_a_migrated_gradebook_has_the_tables_of_a_new_one(first_format):
    from alembic.autogenerate import compare_metadata
    from alembic.migration import MigrationContext

    for _ in range(2):  # the second finds nothing to do
        with Gradebook(first_format) as gradebook, gradebook.database.reading() as connection:
            assert compare_metadata(MigrationContext.configure(connection), LEDGER) == []
            assert set(inspect(connection).get_table_names()) == set(LEDGER.tables)
            assert connection.scalar(text("SELECT version_num FROM alembic_version")) == VERSION


def test_a_migration_that_is_stopped_half_way_leaves_what_was_there(first_format, monkeypatch):
    with monkeypatch.context() as patched:
        patched.setattr("alembic.op.bulk_insert", lambda *_: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            Gradebook(first_format)
    with Gradebook(first_format) as gradebook:
        assert len(gradebook.records("one")) == 3


def test_a_migrated_file_is_its_owners_alone(tmp_path):
    path = tmp_path / "gradebook.sqlite"
    run_sql(path, *FIRST.read_text(encoding="utf-8").split(";\n")[1:-2])
    path.chmod(0o644)
    Gradebook(path).close()
    assert stat.S_IMODE(path.stat().st_mode) == 0o600


@pytest.mark.parametrize(
    "verdicts",
    ["", "[", "7", "[7]", "[{}]", '[{"part": "x", "status": "correct", "points": "many"}]'],
)
def test_a_damaged_grade_of_the_first_format_costs_its_student_alone(first_format, verdicts):
    damage = f"UPDATE grade SET verdicts = '{verdicts}'"  # noqa: S608
    run_sql(first_format, f"{damage} WHERE student = 'ada'")
    with Gradebook(first_format) as gradebook:
        assert list(gradebook.current("one")) == ["ben"]
        assert list(gradebook.damaged("one")) == ["ada"]
        with gradebook.database.reading() as connection:
            kept = connection.scalar(text("SELECT reading FROM verdict WHERE status = 'damaged'"))
        assert kept == verdicts


@pytest.mark.parametrize(
    ("setup", "found"),
    [
        ("UPDATE alembic_version SET version_num = '99'", "99"),
        ("DROP TABLE alembic_version; CREATE TABLE meta (key TEXT, value TEXT); INSERT INTO meta VALUES ('format', '0')", "0"),
    ],
)  # fmt: skip
def test_another_format_is_refused(place, setup, found):
    Gradebook(place).close()
    run_sql(place, *setup.split("; "))
    with pytest.raises(
        CourseError, match=f"format {found}; this version reads {VERSION} and older"
    ):
        Gradebook(place)


def test_alembic_is_loaded_only_where_there_is_something_to_migrate(tmp_path):
    code = (
        "import sys; from pathlib import Path; from kinegrade.course.ledger.gradebook import Gradebook\n"
        "for _ in range(2): Gradebook(Path(sys.argv[1])).close()\n"
        "assert 'alembic' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code, tmp_path / "gradebook.sqlite"], check=True)


def test_who_waits_too_long_for_another_is_told_so(place, monkeypatch):
    monkeypatch.setattr(database, "WAIT", 1)
    mark = Mark("ada", "one", "lever_p", 1.5, "", "abcd1234")
    with Gradebook(place) as first, Gradebook(place) as second:
        with first.database.writing():
            assert second.marks("one") == {}  # reading needs nobody's leave
            with pytest.raises(CourseError, match=BUSY):
                second.save_marks([mark])
        second.save_marks([mark])
        assert first.marks("one") == {("ada", "lever_p"): mark}


DAMAGES = {
    "numbers that are no JSON": ("record", "numbers", "{'L': "),
    "numbers that are a list": ("record", "numbers", "[1, 2]"),
    "no numbers": ("record", "numbers", ""),
    "answers that are no JSON": ("reference", "answers", "\x00\x01"),
    "answers that are text": ("reference", "answers", '"x"'),
}


@pytest.mark.parametrize("what", DAMAGES)
def test_a_damaged_record_costs_one_student_who_is_named(tmp_path, what, capsys):
    table, column, value = DAMAGES[what]
    course = handed_out(make_course(tmp_path))
    for student in course.students:
        hand_in(course, student.id, right_answers(course, student.id))
    path = tmp_path / "gradebook.sqlite"
    with sqlite3.connect(path) as connection:
        connection.execute(f"UPDATE {table} SET {column} = ? WHERE student = 'ben'", (value,))  # noqa: S608
    connection.close()

    with Gradebook(path) as gradebook:
        results = marked(course, gradebook)
        assert [result.points for result in results] == [5, None, 5]
        sentence = (
            "lever of ben cannot be read: a row of the gradebook is damaged; put a backup back"
        )
        assert results[1].reason == sentence
        assert [verdict.status for verdict in results[1].verdicts] == ["not_graded"] * 2
        (tmp_path / "released" / "cyd" / "one.ipynb").unlink()
        released = generate(course, gradebook, course.settings.sheet)
        assert [sheet.student for sheet in released] == ["ada", "cyd"]
        assert f"ben, sheet one: {sentence}" in capsys.readouterr().err


def test_bytes_that_are_no_text_cost_one_student(tmp_path):
    course = handed_out(make_course(tmp_path))
    path = tmp_path / "gradebook.sqlite"
    with sqlite3.connect(path) as connection:
        connection.execute(
            "UPDATE record SET numbers = CAST(x'80ff' AS TEXT) WHERE student = 'ben'"
        )
    connection.close()
    with Gradebook(path) as gradebook:
        assert [record.student for record in gradebook.records("one")] == ["ada", "cyd"]
        assert list(gradebook.damaged("one")) == ["ben"]
    assert len(course.students) == 3


@pytest.mark.parametrize(
    "damage",
    [
        "UPDATE verdict SET answer = '[0.1, '",
        "UPDATE verdict SET mask = 'yes'",
        "UPDATE verdict SET status = 'Correct'",
        "UPDATE verdict SET points = 'full'",
        "UPDATE verdict SET points = 'inf'",
        "UPDATE verdict SET out_of = ''",
    ],
)
def test_a_damaged_grade_is_named_in_the_report_and_marked_anew(tmp_path, damage):
    course = handed_out(make_course(tmp_path))
    for student in course.students:
        hand_in(course, student.id, right_answers(course, student.id))
    path, sheet = tmp_path / "gradebook.sqlite", course.settings.sheet[0]
    with Gradebook(path) as gradebook:
        marked(course, gradebook)
    where = "WHERE place = 1 AND grade IN (SELECT entry FROM grade WHERE student = 'ben')"
    run_sql(path, f"{damage} {where}")

    with Gradebook(path) as gradebook:
        ada, ben, cyd = recorded_results(course, gradebook, sheet)
        assert (ada.points, ben.points, cyd.points) == (5, None, 5)
        assert ben.reason == (
            "the grade of ben cannot be read: a row of the gradebook is damaged; "
            "`kinegrade grade` marks anew"
        )
    with Gradebook(path) as gradebook:
        assert [one.points for one in marked(course, gradebook)] == [5, 5, 5]
        assert [one.points for one in recorded_results(course, gradebook, sheet)] == [5, 5, 5]


def test_a_damaged_mark_costs_one_student_until_it_is_entered_again(tmp_path):
    path = tmp_path / "gradebook.sqlite"
    marks = [Mark(student, "one", "lever_p", 1.0, "", "x") for student in ("ada", "ben")]
    with Gradebook(path) as gradebook:
        gradebook.save_marks(marks)
    run_sql(path, "UPDATE mark SET points = 'one' WHERE student = 'ada'")
    with Gradebook(path) as gradebook:
        assert list(gradebook.marks("one")) == [("ben", "lever_p")]
        assert "the mark of lever_p of ada cannot be read" in gradebook.damaged("one")["ada"]
        gradebook.save_marks(marks)
    with Gradebook(path) as gradebook:
        assert list(gradebook.marks("one").values()) == marks
        assert gradebook.damaged("one") == {}


@pytest.mark.parametrize(
    ("place", "complaint"),
    [
        ("mysql://me:hush@host/db", "mysql:// is no gradebook; a gradebook takes a file, or a URL"),
        ("postgresql://me:hush@host:port/db", "the gradebook's URL cannot be read"),
        ("://hush", "the gradebook's URL cannot be read"),
    ],
)
def test_a_url_of_something_else_is_refused_without_repeating_it(place, complaint):
    with pytest.raises(CourseError, match=re.escape(complaint)) as raised:
        address(place)
    assert "hush" not in str(raised.value)


@pytest.mark.parametrize(
    "place", ["postgresql://me:hush@host/db", "postgresql+psycopg2://me@host/db?password=hush"]
)
def test_neither_user_nor_password_are_shown(place):
    assert shown(address(place)) == "postgresql://host/db"
    assert address(place).drivername == "postgresql+psycopg"
    with pytest.raises(CourseError, match=r"PGPASSWORD or the file ~/\.pgpass"):
        without_password(place)


def test_a_server_that_is_not_there_is_a_sentence(postgres_server):
    place = f"postgresql://me:hush@127.0.0.1:{postgres.free_port()}/course"
    with pytest.raises(
        CourseError, match=r"postgresql://127\.0\.0\.1/course: not a gradebook"
    ) as raised:
        Gradebook(place)
    assert "hush" not in str(raised.value)
    assert "\n" not in str(raised.value)


def test_a_password_comes_from_the_environment_or_pgpass(postgres_server, monkeypatch, tmp_path):
    name = address(postgres_server.database()).database
    place = f"postgresql://marker@127.0.0.1:{postgres_server.port}/{name}"
    monkeypatch.setenv("PGPASSFILE", str(tmp_path / "pgpass"))
    with pytest.raises(CourseError, match="no password supplied"):
        Gradebook(place)
    monkeypatch.setenv("PGPASSWORD", "a wrong one")
    with pytest.raises(CourseError, match="password authentication failed") as raised:
        Gradebook(place)
    assert "a wrong one" not in str(raised.value)
    monkeypatch.setenv("PGPASSWORD", postgres.PASSWORD)
    Gradebook(place).close()
    monkeypatch.delenv("PGPASSWORD")
    (tmp_path / "pgpass").write_text(f"*:*:*:marker:{postgres.PASSWORD}\n", encoding="utf-8")
    (tmp_path / "pgpass").chmod(0o600)
    Gradebook(place).close()


def test_without_psycopg_the_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "psycopg", None)
    with pytest.raises(CourseError, match=re.escape("pip install 'kinegrade[postgres]'")):
        Gradebook("postgresql://me@host/db")


def test_a_course_keeps_its_gradebook_where_its_settings_say(postgres_server, tmp_path, kinegrade):
    place = postgres_server.database()
    make_course(tmp_path, more=f'[gradebook]\nurl = "{place}"\n')
    assert kinegrade("generate", "-c", tmp_path).code == 0
    assert not (tmp_path / "gradebook.sqlite").exists()
    with Gradebook(place) as gradebook:
        (first, *_) = gradebook.records("one")
    answers = {name: value for name, value in first.answers.items() if name.startswith("lever")}
    hand_in(read_course(tmp_path), "ada", answers)
    ran = kinegrade("grade", "-c", tmp_path)
    assert ran.code == 0, ran.err
    assert re.search(r"ada +✓✓ +5 / 5", ran.out)
    assert kinegrade("report", "-c", tmp_path).code == 0

    elsewhere = tmp_path / "other.sqlite"
    assert kinegrade("generate", "-c", tmp_path, "--gradebook", elsewhere).code == 0
    with Gradebook(elsewhere) as gradebook:
        assert len(gradebook.records("one")) == 3


def test_a_password_in_the_settings_is_refused_and_not_repeated(tmp_path, kinegrade):
    for url in ("postgresql://me:hush@host/db", "postgres://me:hush@host/db", "hush"):
        make_course(tmp_path, more=f'[gradebook]\nurl = "{url}"\n')
        ran = kinegrade("generate", "-c", tmp_path)
        assert ran.code == 1
        assert "gradebook.url" in ran.err
        assert "hush" not in ran.err


def test_who_has_no_name_on_this_machine_is_unknown(monkeypatch):
    for variable in ("LOGNAME", "USER", "LNAME", "USERNAME"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setattr("os.getuid", lambda: 4_000_000)
    assert user() == "unknown"
    monkeypatch.setenv("LOGNAME", "ina")
    assert user() == "ina"
