"""A course of another year: settings and exercises come along, people and their marks do not."""

import os

import pytest
from courses import LEVER, hand_in, handed_out, make_course, right_answers
from kinegrade.course.commands.next_year import write_next_course
from kinegrade.course.settings.config import CourseError, read_course
from kinegrade.course.variants.secret import read_secret

MORE = """show_solutions = true  # since December
pinned.lever.x = 1  # 2026-11-01

[marking]
slip = 0.5

[gradebook]
url = "postgresql://marker@db.example.org/robotics"
"""


@pytest.fixture
def last(tmp_path):
    folder = make_course(tmp_path / "last")
    course = handed_out(folder)
    hand_in(course, "ada", right_answers(course, "ada"))
    (folder / "exercises" / "arms.py").write_text("TWO = 2\n", encoding="utf-8")
    (folder / "exercises" / "__pycache__").mkdir()
    (folder / "exercises" / "__pycache__" / "arms.pyc").write_bytes(b"")
    (folder / "exercises" / ".notes").write_bytes(b"")
    return folder


def files_of(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_settings_and_exercises_are_taken_over_and_nothing_else(last, tmp_path, kinegrade):
    new = tmp_path / "new"
    ran = kinegrade("init", new, "--from", last)
    assert ran.code == 0, ran.err
    assert files_of(new) == {
        *("course.toml", "roster.csv", "secret", ".gitignore"),
        *("exercises/lever.py", "exercises/arms.py"),
    }
    assert len(ran.out.splitlines()) == 6
    course = read_course(new)
    assert course.students == ()
    assert (course.settings.title, course.sheets()[0].exercises) == ("Tests", ("lever",))
    assert (new / "exercises" / "lever.py").read_text(encoding="utf-8") == LEVER
    assert "has no students yet" in kinegrade("generate", "--course", new).err


def test_the_secret_is_a_new_one_of_its_owner_alone(last, tmp_path):
    settings = last / "course.toml"
    old = "the secret of an older course"
    settings.write_text(
        f'secret = "{old}"\n' + settings.read_text(encoding="utf-8"), encoding="utf-8"
    )
    (last / "secret").unlink()
    write_next_course(tmp_path / "new", last)
    assert old not in (tmp_path / "new" / "course.toml").read_text(encoding="utf-8")
    secret = read_secret(read_course(tmp_path / "new"))
    assert secret != old
    assert len(secret) == 64
    if os.name == "posix":
        assert (tmp_path / "new" / "secret").stat().st_mode & 0o777 == 0o600


def test_what_is_of_last_year_alone_is_commented_out_and_named(last, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("kinegrade.course.commands.next_year.read_settings", lambda _: None)
    dates = 'deadline = 2026-11-23T23:59:00\nrelease = "2026-11-01"\ncloses=2026-12-01\n'
    extra = "extended = { ada = 2026-12-02 }\nnote = 'not 2026-01-01'\n"
    text = (last / "course.toml").read_text(encoding="utf-8")
    (last / "course.toml").write_text(f"{text}{dates}{extra}{MORE}", encoding="utf-8")
    write_next_course(tmp_path / "new", last)
    lines = (tmp_path / "new" / "course.toml").read_text(encoding="utf-8").splitlines()
    told = capsys.readouterr().err
    for gone in ("deadline", "release", "closes", "extended", "url", "show_solutions"):
        (line,) = [line for line in lines if gone in line]
        assert line.startswith("# ")
        assert line[2:] in told
    assert "note = 'not 2026-01-01'" in lines
    assert "pinned.lever.x = 1  # 2026-11-01" in lines
    assert "slip = 0.5" in lines


def test_nothing_is_overwritten_and_nothing_is_written_from_what_is_no_course(last, tmp_path):
    with pytest.raises(CourseError, match="init never overwrites a course"):
        write_next_course(last, last)
    (tmp_path / "empty").mkdir()
    with pytest.raises(CourseError, match=r"course.toml is not there"):
        write_next_course(tmp_path / "new", tmp_path / "empty")
    assert not (tmp_path / "new").exists()


def test_a_link_among_the_exercises_is_not_followed(last, tmp_path, capsys):
    (last / "exercises" / "link.py").symlink_to(last / "secret")
    write_next_course(tmp_path / "new", last)
    assert "exercises/link.py" not in files_of(tmp_path / "new")
    assert "is a link and is not copied" in capsys.readouterr().err


def test_a_date_that_is_no_line_of_its_own_is_refused_with_a_sentence(last, tmp_path, monkeypatch):
    monkeypatch.setattr("kinegrade.course.commands.next_year.read_settings", lambda _: None)
    with (last / "course.toml").open("a", encoding="utf-8") as file:
        file.write("x = [\n 2026-11-01,\n 3 ]\ny = { a = 1,\n deadline = 2026-11-01 }\n")
    with pytest.raises(CourseError, match="takes a line of its own"):
        write_next_course(tmp_path / "new", last)
