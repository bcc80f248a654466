"""A new course folder: complete, private, and never written over."""

import os

import pytest
from courses import SECRET, handed_out, make_course, write_secret
from kinegrade.course.commands.new_course import PRIVATE, write_course
from kinegrade.course.settings.config import CourseError, read_course
from kinegrade.course.variants.secret import read_secret


def secret_of(folder):
    return read_secret(read_course(folder))


def test_a_new_course_is_read_as_it_was_written(tmp_path):
    written = write_course(tmp_path / "deep" / "course")
    course = read_course(tmp_path / "deep" / "course")
    assert [sheet.name for sheet in course.settings.sheet] == ["jacobian"]
    assert [student.id for student in course.students] == ["student01", "student02"]
    assert (course.settings.limits.cell_seconds, course.settings.limits.notebook_seconds) == (
        30,
        180,
    )
    assert sorted(written) == sorted((tmp_path / "deep" / "course").iterdir())


def test_every_new_course_has_a_secret_of_its_own_that_is_not_in_its_settings(tmp_path):
    secrets, texts = [], []
    for name in ("first", "second"):
        write_course(tmp_path / name)
        texts.append((tmp_path / name / "course.toml").read_text(encoding="utf-8"))
        secrets.append(secret_of(tmp_path / name))
    assert secrets[0] != secrets[1]
    assert all(len(secret) == 64 for secret in secrets)
    assert not any(secret in text for secret in secrets for text in texts)
    assert all(text.count("\n#") >= 8 for text in texts)


@pytest.mark.skipif(os.name != "posix", reason="modes are those of POSIX")
def test_the_secret_is_its_owners_alone_and_reading_it_complains_of_nothing(tmp_path, capsys):
    write_course(tmp_path)
    assert (tmp_path / "secret").stat().st_mode & 0o777 == 0o600
    assert secret_of(tmp_path)
    assert capsys.readouterr().err == ""


def test_a_course_is_never_overwritten(tmp_path):
    write_course(tmp_path)
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    with pytest.raises(CourseError, match="already there; init never overwrites"):
        write_course(tmp_path)
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_a_roster_and_a_secret_that_are_there_are_kept_by_init(tmp_path):
    (tmp_path / "roster.csv").write_text("student,name\nada,Ada\n", encoding="utf-8")
    write_secret(tmp_path)
    write_course(tmp_path)
    assert [student.id for student in read_course(tmp_path).students] == ["ada"]
    assert secret_of(tmp_path) == SECRET


def test_an_init_that_was_killed_before_its_end_can_be_repeated(tmp_path, monkeypatch):
    monkeypatch.setattr("kinegrade.course.variants.secret.write_atomically", lambda *_, **__: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        write_course(tmp_path / "course")
    monkeypatch.undo()
    write_course(tmp_path / "course")
    assert read_course(tmp_path / "course").students
    assert secret_of(tmp_path / "course")


def test_all_that_a_course_writes_besides_its_settings_is_kept_out_of_a_repository(tmp_path):
    write_course(tmp_path)
    assert (tmp_path / ".gitignore").read_text(encoding="utf-8").split() == [*PRIVATE]
    named = {
        "secret",
        "gradebook.sqlite*",
        "released/",
        "solutions/",
        "submitted/",
        "feedback/",
        "report/",
        "exchange/",
    }
    assert set(PRIVATE) == named | {"grades*.csv"}


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("*.pyc\n", PRIVATE),
        ("secret\n/released\n", [n for n in PRIVATE if n not in ("secret", "released/")]),
    ],
)
def test_a_gitignore_that_is_there_is_left_alone_and_what_it_lacks_is_told(
    tmp_path, capsys, text, told
):
    path = tmp_path / ".gitignore"
    path.write_text(text, encoding="utf-8")
    assert path not in write_course(tmp_path)
    assert path.read_text(encoding="utf-8") == text
    assert (
        capsys.readouterr().err
        == f"{path} was there and is left alone; it should also name: {' '.join(told)}\n"
    )


def test_a_gitignore_that_lacks_nothing_is_not_mentioned(tmp_path, capsys):
    (tmp_path / ".gitignore").write_text("\n".join(["*.pyc", *PRIVATE]), encoding="utf-8")
    write_course(tmp_path)
    assert capsys.readouterr().err == ""


def test_a_cloned_course_that_has_handed_out_nothing_gets_a_secret_and_nothing_else(tmp_path):
    make_course(tmp_path)
    (tmp_path / "secret").unlink()
    before = (tmp_path / "course.toml").read_bytes()
    with pytest.raises(CourseError, match="kinegrade init"):
        handed_out(tmp_path)
    assert (tmp_path / "gradebook.sqlite").exists()  # which has nothing in it
    assert write_course(tmp_path) == [tmp_path / ".gitignore", tmp_path / "secret"]
    assert (tmp_path / "course.toml").read_bytes() == before
    assert len(secret_of(tmp_path)) == 64


@pytest.mark.parametrize("gone", ["gradebook.sqlite", "released"])
def test_a_lost_secret_of_sheets_that_were_handed_out_is_not_replaced(tmp_path, gone):
    make_course(tmp_path)
    handed_out(tmp_path)
    (tmp_path / "secret").unlink()
    (tmp_path / gone).rename(tmp_path / "elsewhere")
    with pytest.raises(CourseError, match="put the backup of the secret back"):
        write_course(tmp_path)
    assert not (tmp_path / "secret").exists()


def test_an_older_course_that_has_its_secret_in_its_settings_gets_no_other(tmp_path):
    make_course(tmp_path)
    (tmp_path / "secret").unlink()
    settings = tmp_path / "course.toml"
    settings.write_text(
        f'secret = "{SECRET}"\n' + settings.read_text(encoding="utf-8"), encoding="utf-8"
    )
    with pytest.raises(CourseError, match="init never overwrites"):
        write_course(tmp_path)
