"""The secret: looked for where it belongs, only when numbers are drawn, and never repeated."""

import os

import pytest
from courses import SECRET, files_of, hand_in, handed_out, make_course, right_answers, write_secret
from kinegrade.course.settings.config import CourseError, read_course
from kinegrade.course.variants.secret import read_secret

OTHER = "quite another secret, long enough"


@pytest.fixture
def folder(tmp_path):
    return make_course(tmp_path / "course")


def found(folder):
    return read_secret(read_course(folder))


def put_into_settings(folder, secret=SECRET):
    settings = folder / "course.toml"
    settings.write_text(
        f'secret = "{secret}"\n' + settings.read_text(encoding="utf-8"), encoding="utf-8"
    )


@pytest.mark.parametrize("text", [SECRET, f"{SECRET}\n", f"  {SECRET}\r\n\n", f"\ufeff{SECRET}"])
def test_white_space_around_it_is_not_part_of_it(folder, text):
    (folder / "secret").write_text(text, encoding="utf-8")
    assert found(folder) == SECRET


def test_the_variable_replaces_the_file_and_says_so_where_they_differ(folder, monkeypatch, capsys):
    monkeypatch.setenv("KINEGRADE_SECRET", f"{SECRET}\n")
    assert (found(folder), capsys.readouterr().err) == (SECRET, "")
    monkeypatch.setenv("KINEGRADE_SECRET", OTHER)
    assert found(folder) == OTHER
    assert f"KINEGRADE_SECRET is taken in place of {folder / 'secret'}" in capsys.readouterr().err
    (folder / "secret").unlink()
    assert (found(folder), capsys.readouterr().err) == (OTHER, "")


def test_a_variable_that_is_set_to_nothing_counts_as_not_set(folder, monkeypatch):
    monkeypatch.setenv("KINEGRADE_SECRET", " ")
    assert found(folder) == SECRET


def test_an_older_course_goes_on_working_and_is_told_once_that_the_secret_may_move(
    folder, kinegrade
):
    before = files_of(handed_out(folder).folder)
    (folder / "secret").unlink()
    for path in (folder / "released").rglob("*.ipynb"):
        path.unlink()
    (folder / "gradebook.sqlite").unlink()
    put_into_settings(folder)
    ran = kinegrade("generate", "-c", folder)
    assert ran.code == 0
    assert ran.err.count("can be shared") == 1
    assert ran.err.count(str(folder / "secret")) == 1
    released = {
        name: data for name, data in files_of(folder).items() if name.startswith("released")
    }
    assert released == {name: data for name, data in before.items() if name.startswith("released")}


def test_the_same_secret_in_both_places_is_fine_and_two_are_an_error(folder, monkeypatch):
    put_into_settings(folder)
    assert found(folder) == SECRET
    write_secret(folder, OTHER)
    with pytest.raises(
        CourseError, match=r"course.toml and .*secret hold different secrets; keep the one"
    ) as error:
        found(folder)
    assert OTHER not in str(error.value)
    assert SECRET not in str(error.value)
    write_secret(folder)
    monkeypatch.setenv("KINEGRADE_SECRET", OTHER)
    with pytest.raises(
        CourseError, match=r"course.toml and KINEGRADE_SECRET hold different secrets"
    ):
        found(folder)


def test_a_missing_one_says_where_it_was_looked_for_and_what_to_do(folder, kinegrade):
    (folder / "secret").unlink()
    ran = kinegrade("generate", "-c", folder)
    assert ran.code == 1
    line = ran.err.splitlines()[-1]
    for words in (
        f"KINEGRADE_SECRET is not set, and {folder / 'secret'} is not there",
        "a new one means other numbers: put the backup back",
        f"`kinegrade init {folder}` writes one",
    ):
        assert words in line
    assert not (folder / "released").exists()


@pytest.mark.parametrize("where", ["file", "variable"])
def test_a_short_one_is_refused_and_not_repeated(folder, monkeypatch, where):
    write_secret(folder, "hush-hush")
    if where == "variable":
        monkeypatch.setenv("KINEGRADE_SECRET", "hush-hush")
    with pytest.raises(CourseError, match="a secret takes at least 16 characters, got 9") as error:
        found(folder)
    assert "hush" not in str(error.value)


def test_a_file_that_is_no_text_or_a_folder_is_named(folder):
    (folder / "secret").write_bytes(b"\xff" * 40)
    with pytest.raises(CourseError, match="secret cannot be read as UTF-8 text"):
        found(folder)
    (folder / "secret").unlink()
    (folder / "secret").mkdir()
    with pytest.raises(CourseError, match="secret cannot be read"):
        found(folder)


@pytest.mark.skipif(os.name != "posix", reason="modes are those of POSIX")
@pytest.mark.parametrize(
    ("mode", "warned"), [(0o600, False), (0o400, False), (0o640, True), (0o644, True)]
)
def test_one_that_others_can_read_is_a_warning(folder, capsys, mode, warned):
    write_secret(folder, mode=mode)
    assert found(folder) == SECRET
    err = capsys.readouterr().err
    assert ("can be read by others on this machine; `chmod 600" in err) is warned
    assert bool(err) is warned


def test_what_draws_no_numbers_needs_none(folder, kinegrade):
    course = handed_out(folder)
    hand_in(course, "ada", right_answers(course, "ada"))
    (folder / "secret").unlink()
    for arguments in (
        ("grade", "-c", folder),
        ("report", "-c", folder),
        ("marks", "list", "-c", folder),
        ("validate", "lever", "--draws", 1, "-c", folder),
        ("generate", "-c", folder),  # nothing is left to be drawn
    ):
        assert kinegrade(*arguments).code == 0, arguments


def test_a_student_who_joins_late_needs_the_secret(folder, kinegrade):
    handed_out(folder)
    (folder / "secret").unlink()
    with (folder / "roster.csv").open("a", encoding="utf-8") as file:
        file.write("zoe,Zoe\n")
    ran = kinegrade("generate", "-c", folder)
    assert (ran.code, "the course has no secret" in ran.err) == (1, True)
