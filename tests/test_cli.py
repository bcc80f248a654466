"""The command line: data on stdout, the rest on stderr, one sentence for what is wrong, and the code that says it."""

import csv
import json
import sqlite3
from importlib.metadata import version

import pytest
from answers import EXERCISES, variant_of
from courses import CLASS, LEVER, files_of, hand_in, make_course, notebook, right_answers
from kinegrade.course import cli
from kinegrade.course.settings.config import read_course

COMMANDS = ("demo", "init", "generate", "grade", "check", "report", "plot")


@pytest.fixture
def folder(class_of_three):
    """A course of three: right, wrong, and nothing handed in."""
    hand_in(class_of_three, "ada", right_answers(class_of_three, "ada"))
    hand_in(class_of_three, "ben", {"lever_p": [9, 9], "lever_J": "[/red]"})
    return class_of_three.folder


def grades(folder):
    with (folder / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
        return {row["student"]: row for row in csv.DictReader(file)}


def complaint(ran):
    """The one sentence of a run that could not do its work."""
    lines = [line for line in ran.err.splitlines() if line.strip()]
    assert ran.code == 1, ran
    assert "Traceback" not in ran.err + ran.out
    assert "our fault" not in ran.err
    assert lines[-1].startswith("kinegrade: ")
    return lines[-1].removeprefix("kinegrade: ")


def test_help_lists_every_command(kinegrade):
    ran = kinegrade("--help")
    assert ran.code == 0
    assert [name for name in COMMANDS if name not in ran.out] == []


def test_the_version_is_that_of_the_package(kinegrade):
    ran = kinegrade("--version")
    assert (ran.code, ran.out, ran.err) == (0, f"{version('kinegrade')}\n", "")


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_itself(kinegrade, command):
    ran = kinegrade(command, "-h")
    assert ran.code == 0
    assert len(ran.out.splitlines()) > 5


@pytest.mark.parametrize(
    "arguments",
    [
        (),
        ("gradde",),
        ("check",),
        ("init",),
        ("grade", "--fast"),
        ("plot",),
        ("generate", "--course"),
        ("report", "one"),
    ],
)
def test_wrong_usage_ends_with_2(kinegrade, arguments):
    ran = kinegrade(*arguments)
    assert ran.code == 2
    assert "Usage" in ran.out + ran.err or "Error" in ran.err


def test_init_prints_the_files_it_wrote(kinegrade, tmp_path):
    ran = kinegrade("init", tmp_path / "new")
    assert ran.code == 0
    names = ("roster.csv", ".gitignore", "secret", "course.toml")
    assert ran.out.splitlines() == [str(tmp_path / "new" / name) for name in names]
    assert "kinegrade generate --course" in ran.err
    assert read_course(tmp_path / "new").students


def test_generate_prints_what_is_new_and_only_that(kinegrade, tmp_path):
    make_course(tmp_path)
    first, second = (
        kinegrade("generate", "-c", tmp_path),
        kinegrade("generate", "one", "-c", tmp_path),
    )
    assert first.out.splitlines() == [
        str(tmp_path / "released" / student / "one.ipynb") for student, _ in CLASS
    ]
    assert "3 new, 0 left as they were released." in first.err
    assert (first.code, second.code, second.out) == (0, 0, "")
    assert "0 new, 3 left" in second.err


def test_the_folder_one_is_in_is_the_course(kinegrade, folder, monkeypatch):
    monkeypatch.chdir(folder)
    assert kinegrade("grade").code == 0
    assert set(grades(folder)) == {"ada", "ben", "cyd"}


def test_grade_prints_a_table_and_writes_grades_feedback_and_report(kinegrade, folder):
    ran = kinegrade("grade", "-c", folder)
    assert ran.code == 0
    lines = [line.split() for line in ran.out.splitlines()]
    assert ["Sheet", "one"] in lines
    assert ["ada", "✓✓", "5", "/", "5"] in lines
    assert any(line[:4] == ["ben", "✗!", "0", "/"] for line in lines)
    assert ["cyd", "—", "no", "submission"] in lines
    assert str(folder / "report" / "index.html") in ran.err
    found = grades(folder)
    assert [found[student]["points"] for student in ("ada", "ben", "cyd")] == ["5", "0", ""]
    written = set(files_of(folder))
    assert {
        "feedback/ada/one.html",
        "feedback/ben/one.html",
        "report/index.html",
        "gradebook.sqlite",
    } <= written
    assert "feedback/cyd/one.html" not in written


def test_grading_again_gives_the_same_files(kinegrade, folder):
    first = kinegrade("grade", "-c", folder)
    before = files_of(folder)
    assert kinegrade("grade", "-c", folder) == first
    assert files_of(folder) == before


def test_grade_prints_json_where_a_script_asks(kinegrade, folder):
    ran = kinegrade("grade", "--json", "-c", folder)
    data = json.loads(ran.out)
    assert [(found["student"], found["points"], found["status"]) for found in data] == [
        ("ada", 5, "graded"),
        ("ben", 0, "graded"),
        ("cyd", None, "no_submission"),
    ]


def test_report_writes_the_same_from_the_gradebook_alone(kinegrade, folder):
    kinegrade("grade", "-c", folder)
    before, page = grades(folder), (folder / "feedback" / "ada" / "one.html").read_bytes()
    for name in (
        "grades.csv",
        "report/index.html",
        "feedback/ada/one.html",
        "submitted/ada/one.json",
    ):
        (folder / name).unlink()
    ran = kinegrade("report", "-c", folder)
    assert (ran.code, ran.out) == (0, f"{folder / 'report' / 'index.html'}\n")
    assert grades(folder) == before
    assert (folder / "feedback" / "ada" / "one.html").read_bytes() == page


def test_grading_one_sheet_keeps_the_others_in_grades_and_report(kinegrade, tmp_path):
    make_course(tmp_path, more='[[sheet]]\nname = "two"\nexercises = ["lever"]\n')
    kinegrade("generate", "-c", tmp_path)
    course = read_course(tmp_path)
    hand_in(course, "ada", right_answers(course, "ada"))
    hand_in(course, "ben", right_answers(course, "ben", "two"), "two.json")
    assert kinegrade("grade", "-c", tmp_path).code == 0
    ran = kinegrade("grade", "two", "-c", tmp_path)
    assert "Sheet one" not in ran.out
    assert grades(tmp_path)["ada"]["one_points"] == "5"
    assert grades(tmp_path)["ben"]["two_points"] == "5"
    report = (tmp_path / "report" / "index.html").read_text(encoding="utf-8")
    assert '<h2 id="one">Sheet one</h2>' in report
    assert '<h2 id="two">two</h2>' in report


def test_a_broken_sheet_does_not_keep_another_from_being_marked(kinegrade, folder):
    settings = folder / "course.toml"
    broken = '[[sheet]]\nname = "two"\nexercises = ["leever"]\n'
    settings.write_text(settings.read_text(encoding="utf-8") + broken, encoding="utf-8")
    ran = kinegrade("grade", "one", "-c", folder)
    assert ran.code == 0
    assert grades(folder)["ada"]["one_points"] == "5"
    assert "Sheet two is left out of the report: there is no exercise 'leever'" in ran.err


def test_report_leaves_a_broken_exercise_out_as_grading_does(kinegrade, tmp_path):
    make_course(tmp_path, more='[[sheet]]\nname = "two"\nexercises = ["stick"]\n')
    stick = tmp_path / "exercises" / "stick.py"
    stick.write_text(LEVER.replace("lever", "stick"), encoding="utf-8")
    kinegrade("generate", "-c", tmp_path)
    course = read_course(tmp_path)
    hand_in(course, "ada", right_answers(course, "ada"))
    stick.write_text("EXERCISE = 1 / 0\n", encoding="utf-8")
    graded = kinegrade("grade", "one", "-c", tmp_path)
    reported = kinegrade("report", "-c", tmp_path)
    (said,) = [line for line in graded.err.splitlines() if "left out" in line]
    assert said.startswith(
        f"Sheet two is left out of the report: {stick}: the exercise file stopped with ZeroDiv"
    )
    assert (graded.code, reported.code, reported.err.splitlines()) == (0, 0, [said])
    assert grades(tmp_path)["ada"]["one_points"] == "5"


def test_who_is_not_on_the_roster_is_mentioned(kinegrade, folder):
    hand_in(read_course(folder), "zoe", b"{}")
    ran = kinegrade("grade", "-c", folder)
    assert ran.code == 0
    assert f"{folder / 'submitted' / 'zoe'} belongs to nobody of roster.csv" in ran.err


def test_a_changed_reference_waits_until_it_is_accepted(kinegrade, folder):
    kinegrade("grade", "-c", folder)
    path = folder / "exercises" / "lever.py"
    path.write_text(
        path.read_text(encoding="utf-8").replace("np.array([-y, x])", "np.array([y, x])"),
        encoding="utf-8",
    )
    waiting = kinegrade("grade", "-c", folder)
    assert ["ada", "✓?", "2", "+", "?", "/", "5"] in [
        line.split()[:7] for line in waiting.out.splitlines()
    ]
    assert "--accept-change" in waiting.out
    assert grades(folder)["ada"]["points"] == ""
    accepted = kinegrade("grade", "--accept-change", "-c", folder)
    assert accepted.code == 0
    assert grades(folder)["ada"]["points"] != ""
    assert kinegrade("grade", "-c", folder).out == accepted.out


def test_an_exception_that_every_submission_meets_is_said_once_with_its_count(
    kinegrade, folder, monkeypatch
):
    monkeypatch.delenv("KINEGRADE_DEBUG", raising=False)
    path = folder / "exercises" / "lever.py"
    text = path.read_text(encoding="utf-8").replace(
        'needs=("lever_p",))', 'needs=("lever_p",), check=judged)'
    )
    text = text.replace(
        "EXERCISE = ", "def judged(v, given, value):\n    return v['width']\n\n\nEXERCISE = "
    )
    path.write_text(text, encoding="utf-8")
    for student, _ in CLASS:
        hand_in(read_course(folder), student, right_answers(read_course(folder), student))
    ran = kinegrade("grade", "-c", folder)
    said = [line for line in ran.err.splitlines() if "could not be marked" in line]
    assert ran.code == 0
    assert said[0].startswith("ERROR: lever_J could not be marked: KeyError: 'width' (line ")
    assert said[1:] == [f"2 more like it: {said[0]}"]
    assert "Traceback" not in ran.err
    monkeypatch.setenv("KINEGRADE_DEBUG", "1")
    assert kinegrade("grade", "--again", "-c", folder).err.count("Traceback") == 1


BROKEN_DRAWS = {
    "float('x')": "exercise lever: draw stopped with ValueError: could not convert string to float: 'x' (line ",
    "np.ones(2)": "exercise lever: draw gives what JSON cannot hold: L is a numpy array; write L.tolist()",
    "'long'": "exercise lever cannot be solved for ada: it stopped with ",
}


@pytest.mark.parametrize("length", BROKEN_DRAWS)
def test_an_exercise_that_cannot_be_drawn_or_solved_is_one_sentence(kinegrade, tmp_path, length):
    path = make_course(tmp_path) / "exercises" / "lever.py"
    text = path.read_text(encoding="utf-8").replace("float(rng.integers(40, 121)) / 100", length)
    path.write_text(text, encoding="utf-8")
    assert complaint(kinegrade("generate", "-c", tmp_path)).startswith(BROKEN_DRAWS[length])


BAD_COURSES = {
    "no course": (lambda folder: (folder / "course.toml").unlink(), "course.toml is not there"),
    "unknown key": (
        lambda folder: add(folder / "course.toml", "[limit]\n"),
        "unknown key 'limit' (did you mean 'limits'?)",
    ),
    "duplicate student": (
        lambda folder: add(folder / "roster.csv", "ADA,Twin\n"),
        "line 5: student 'ADA' is already in line 2",
    ),
    "missing column": (
        lambda folder: (folder / "roster.csv").write_text("alias,name\n"),
        "the column 'student' is missing",
    ),
    "bad id": (
        lambda folder: add(folder / "roster.csv", "../x,X\n"),
        "line 5: a student takes an id of letters",
    ),
    "unknown exercise": (
        lambda folder: make_course(folder, exercises=("lefer",)),
        "there is no exercise 'lefer'; did you mean 'lever'?",
    ),
    "no gradebook": (
        lambda folder: (folder / "gradebook.sqlite").write_bytes(b"not a database, by far" * 50),
        "gradebook.sqlite: not a gradebook that can be used: file is not a database",
    ),
    "broken exercise": (
        lambda folder: (folder / "exercises" / "lever.py").write_text("EXERCISE = (\n"),
        "lever.py: the exercise file stopped with SyntaxError",
    ),
}


def add(path, text):
    path.write_text(path.read_text(encoding="utf-8") + text, encoding="utf-8")


@pytest.mark.parametrize("command", ["generate", "grade", "report"])
@pytest.mark.parametrize("kind", BAD_COURSES)
def test_a_bad_course_is_one_sentence_and_code_1(kinegrade, folder, command, kind):
    spoil, words = BAD_COURSES[kind]
    spoil(folder)
    before = files_of(folder)
    assert words in complaint(kinegrade(command, "--course", folder))
    assert files_of(folder) == before


def test_a_roster_without_students_is_one_sentence(kinegrade, tmp_path):
    make_course(tmp_path, students=())
    assert "roster.csv has no students yet" in complaint(kinegrade("generate", "-c", tmp_path))


def test_an_unknown_sheet_is_one_sentence(kinegrade, folder):
    assert "there is no sheet 'on' (did you mean 'one'?)" in complaint(
        kinegrade("grade", "on", "-c", folder)
    )


def test_init_and_demo_leave_another_course_alone(kinegrade, folder):
    before = files_of(folder)
    assert "init never overwrites a course" in complaint(kinegrade("init", folder))
    assert "a course that is not the demonstration; name another folder" in complaint(
        kinegrade("demo", folder)
    )
    assert files_of(folder) == before


def test_init_into_a_file_is_one_sentence(kinegrade, tmp_path):
    (tmp_path / "file").touch()
    assert "File exists" in complaint(kinegrade("init", tmp_path / "file"))


def test_a_gradebook_of_a_later_version_is_one_sentence(kinegrade, folder):
    with sqlite3.connect(folder / "gradebook.sqlite") as connection:
        connection.execute("UPDATE alembic_version SET version_num = '99'")
    connection.close()
    assert "the gradebook has format 99; this version reads 3 and older" in complaint(
        kinegrade("grade", "-c", folder)
    )


def test_a_bad_submission_ends_with_0_and_everybody_else_is_marked(kinegrade, folder):
    (folder / "submitted" / "ben" / "one.json").unlink()
    hand_in(read_course(folder), "ben", notebook("lever_p = [1, 2]")[:80], "one.ipynb")
    (folder / "submitted" / "cyd" / "one.ipynb").mkdir(parents=True)
    ran = kinegrade("grade", "-c", folder)
    assert ran.code == 0
    assert [grades(folder)[student]["status"] for student in ("ada", "ben", "cyd")] == [
        "graded",
        "graded",
        "not_graded",
    ]
    assert grades(folder)["cyd"]["points"] == ""
    assert "not a notebook" in ran.out


def handed_in(tmp_path, mode, *cells):
    path = tmp_path / "mine.ipynb"
    numbers = {"three_axis": variant_of("three_axis")}
    about = {"sheet": "one", "mode": mode, "exercises": ["three_axis"], "numbers": numbers}
    path.write_bytes(notebook(*cells, about=about))
    return path


@pytest.mark.parametrize("mode", ["practice", "graded", "exam"])
def test_check_ends_with_1_when_something_is_wrong_with_the_file(kinegrade, tmp_path, mode):
    ran = kinegrade("check", handed_in(tmp_path, mode, "three_axis_A = [[1, 2], [3, 4]]"))
    assert ran.code == 1
    lines = [line.split(None, 2) for line in ran.out.splitlines()]
    assert [line[:2] for line in lines] == [
        ["✗", part.variable] for part in EXERCISES["three_axis"].asked
    ]
    assert "shape (3, 3)" in next(words for _, name, words in lines if name == "three_axis_A")
    assert ran.err.strip().startswith(mode.capitalize())


def test_check_ends_with_0_when_all_can_be_read_in_an_exam(kinegrade, tmp_path):
    asked = EXERCISES["three_axis"].asked
    cells = [f"{part.variable} = np.full({part.answer.shape}, 0.5)" for part in asked]
    ran = kinegrade("check", handed_in(tmp_path, "exam", *cells))
    assert (ran.code, ran.out.count("✓")) == (0, len(asked))
    assert "nothing more" in ran.err


def test_check_shows_where_a_formula_cannot_be_read(kinegrade, tmp_path):
    path = tmp_path / "mine.ipynb"
    about = {
        "sheet": "one",
        "mode": "exam",
        "exercises": ["rrt"],
        "numbers": {"rrt": variant_of("rrt")},
    }
    path.write_bytes(notebook("rrt_det = 'sin(q2) + wrong'", about=about))
    lines = kinegrade("check", path).out.splitlines()
    (first,) = (i for i, line in enumerate(lines) if line.startswith("✗ rrt_det "))
    assert lines[first + 1].strip() == "sin(q2) + wrong"
    assert lines[first + 2].index("^") == lines[first + 1].index("wrong")


def test_check_shows_what_a_terminal_would_obey_as_text(kinegrade, tmp_path):
    ran = kinegrade("check", handed_in(tmp_path, "exam", "three_axis_p = '\\x1b[2J'"))
    assert "\x1b" not in ran.out
    assert "\ufffd[2J" in ran.out


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        ("gone.ipynb", None, "gone.ipynb cannot be read: No such file"),
        ("mine.pdf", b"%PDF", "takes one of the endings .ipynb, .py, .json"),
        ("mine.json", b"{}", "does not say which sheet it belongs to"),
        ("mine.ipynb", b'{"cells": [', "does not say which sheet it belongs to"),
    ],
)
def test_check_says_what_it_cannot_look_at(kinegrade, tmp_path, name, data, words):
    if data is not None:
        (tmp_path / name).write_bytes(data)
    assert words in complaint(kinegrade("check", tmp_path / name))


def test_a_folder_where_a_file_is_meant_is_called_one(kinegrade, folder):
    for command in (("marks", "read", folder, "-c", folder), ("check", folder)):
        assert complaint(kinegrade(*command)) == f"{folder} is a folder; this takes a file"


def failing(error):
    def fail(*_):
        raise error

    return fail


def test_a_failure_of_ours_says_so_and_is_shown_in_full_only_on_request(
    kinegrade, tmp_path, monkeypatch
):
    monkeypatch.setattr(
        "kinegrade.course.commands.new_course.write_course", failing(KeyError("oops"))
    )
    monkeypatch.delenv("KINEGRADE_DEBUG", raising=False)
    ran = kinegrade("init", tmp_path)
    assert ran.code == 1
    assert ran.err.startswith("kinegrade: this is our fault, not yours: KeyError: 'oops'")
    assert len(ran.err.splitlines()) == 1
    monkeypatch.setenv("KINEGRADE_DEBUG", "1")
    with pytest.raises(KeyError):
        cli.main()


def test_a_full_disk_is_one_sentence(kinegrade, tmp_path, monkeypatch):
    monkeypatch.setattr(
        "kinegrade.course.commands.new_course.write_course",
        failing(OSError(28, "No space left on device", "a.toml")),
    )
    assert complaint(kinegrade("init", tmp_path)) == "a.toml: No space left on device"


def test_a_disk_that_fills_up_while_a_file_is_written_names_the_file(
    kinegrade, tmp_path, monkeypatch
):
    full = OSError(28, "No space left on device")
    monkeypatch.setattr("kinegrade.course.machine.files.os.fsync", failing(full))
    said = complaint(kinegrade("init", tmp_path / "new"))
    assert said.startswith(str(tmp_path / "new"))
    assert said.endswith(": No space left on device")
    assert not list(tmp_path.rglob("*.part"))


def test_a_place_that_cannot_be_written_is_called_as_it_was_asked_for(
    kinegrade, tmp_path, monkeypatch
):
    kept_out = OSError(30, "Read-only file system", str(tmp_path / ".x.svg.mnwp2ztt.part"))
    monkeypatch.setattr(
        "kinegrade.course.machine.files.tempfile.mkstemp", lambda **_: failing(kept_out)()
    )
    path = tmp_path / "x.svg"
    said = complaint(kinegrade("plot", "planar_2r", "-o", path))
    assert said == f"{path}: Read-only file system"


def test_a_stopped_run_says_that_it_can_go_on(kinegrade, tmp_path, monkeypatch):
    monkeypatch.setattr(
        "kinegrade.course.commands.new_course.write_course", failing(KeyboardInterrupt())
    )
    ran = kinegrade("init", tmp_path)
    assert ran.code == 130
    assert "what was done is kept, and the same command goes on from there" in ran.err
