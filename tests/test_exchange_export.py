"""An autograder for Gradescope that marks as we do and gives nothing away; JUnit; what Classroom reads."""

import json
import subprocess
import sys
import zipfile
from shutil import copy, copytree

import junitparser
import pytest
import yaml
from courses import hand_in, handed_out, make_course, notebook, right_answers
from downloads import sheet_of
from kinegrade.course.exchange import autograder_run, classroom_check
from kinegrade.course.exchange.wheel import wheel
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.marking.written import mark_and_write
from kinegrade.course.settings.config import read_course
from kinegrade.grader.jail import jail as jails
from wheels import neighbours

SECRET = "the secret of a course, which nobody gets"  # noqa: S105


@pytest.fixture(scope="module")
def marked(tmp_path_factory):
    """A marked course: ada has all points, ben a wrong sign, cyd one answer; its secret lies twice."""
    folder = make_course(tmp_path_factory.mktemp("m") / "course", secret=SECRET)
    settings = folder / "course.toml"
    settings.write_text(f'secret = "{SECRET}"\n{settings.read_text()}')
    course = handed_out(folder)
    hand_in(course, "ada", right_answers(course, "ada"))
    answers = right_answers(course, "ben")
    hand_in(course, "ben", {"lever_J": -answers["lever_J"], "lever_p": answers["lever_p"]})
    hand_in(course, "cyd", {"lever_p": right_answers(course, "cyd")["lever_p"]})
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        mark_and_write(course, gradebook, course.settings.sheet)
    return course.folder


@pytest.fixture
def autograder(kinegrade, marked, tmp_path):
    """Gradescope's folder with the unpacked autograder; takes who handed in, and what."""
    ran = kinegrade("export", "gradescope", "one", "-c", marked, "-o", tmp_path / "a.zip")
    assert (ran.code, ran.out) == (0, f"{tmp_path / 'a.zip'}\n")
    assert (tmp_path / "a.zip").stat().st_mode & 0o077 == 0
    root = tmp_path / "autograder"
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        archive.extractall(root / "source")

    def submit(users, **files):
        about = {"users": users, "created_at": "2026-11-23T14:22:32.365935-07:00"}
        (root / "submission_metadata.json").write_text(json.dumps(about))
        (root / "submission").mkdir()
        for name, data in files.items():
            (root / "submission" / name.replace("_dot_", ".")).write_bytes(data)
        return root

    return submit


def plain(answers):
    return json.dumps({name: value.tolist() for name, value in answers.items()}).encode()


def results_of(root):
    return json.loads((root / "results" / "results.json").read_text())


def test_the_autograder_gives_the_marks_that_the_course_gives(autograder, marked):
    answers = right_answers(read_course(marked), "ben")
    data = plain({"lever_J": -answers["lever_J"], "lever_p": answers["lever_p"]})
    root = autograder([{"sid": "ben", "email": "", "name": "?"}], one_dot_json=data)
    assert autograder_run.main(root) == 0
    results = results_of(root)
    assert results["score"] == 3.5
    assert [test["score"] for test in results["tests"]] == [2, 1.5]
    assert {test["visibility"] for test in results["tests"]} == {"visible"}
    assert "sign" in results["tests"][1]["output"]
    told = {"sheet": "one", "student": "ben", "status": "graded", "out_of": 5, "level": ""}
    assert told.items() < results["extra_data"].items()


def test_the_autograder_holds_no_secret_and_nothing_that_was_handed_in(autograder, marked):
    root = autograder([])
    names = {str(path.relative_to(root / "source")) for path in (root / "source").rglob("*.*")}
    assert {"course.json", "gradebook.sqlite", "setup.sh", "exercises/lever.py"} < names
    for path in (root / "source").rglob("*"):
        if path.is_file():
            assert SECRET.encode() not in path.read_bytes()
    with Gradebook(root / "source" / "gradebook.sqlite") as gradebook:
        assert {record.student for record in gradebook.records("one")} == {"ada", "ben", "cyd"}
        assert gradebook.current("one") == {}


LOOKS_FOR_ANSWERS = """
import os
lever_p = [0.0, 0.0]
for name in ("gradebook.sqlite", "course.json"):
    try:
        with open(os.path.join({source!r}, name), "rb") as file:
            if file.read():
                lever_p = {right!r}
    except OSError:
        pass
"""


def test_code_of_a_student_reads_no_answers_in_the_container(autograder, marked):
    """Outside of the walls, the same code reads them and hands in what is right."""
    right = right_answers(read_course(marked), "ada")["lever_p"].tolist()
    root = autograder([{"sid": "ada"}])
    cell = LOOKS_FOR_ANSWERS.format(source=str(root / "source"), right=right)
    exec(cell, outside := {})  # noqa: S102 - our own
    assert outside["lever_p"] == right
    (root / "submission" / "one.ipynb").write_bytes(sheet_of("ada", cell))
    assert autograder_run.main(root) == 0
    assert results_of(root)["tests"][0]["score"] == 0
    assert results_of(root)["extra_data"]["level"] in ("strong", "medium")


REFUSALS = {
    "nobody": ([{"sid": "zoe"}], {"one_dot_json": b"{}"}, "0 students of the roster"),
    "two": ([{"sid": "ada"}, {"sid": "ben"}], {"one_dot_json": b"{}"}, "2 students of the roster"),
    "no file": ([{"sid": "ada"}], {}, "no answers to sheet one were found: the file takes the"),
    "a picture": ([{"sid": "ada"}], {"x_dot_png": b""}, "no answers to sheet one were found"),
    "another's sheet": (
        [{"sid": "ada"}],
        {"one_dot_ipynb": sheet_of("ben")},
        "the sheet in it is that of ben",
    ),
}


@pytest.mark.parametrize("case", REFUSALS)
def test_what_cannot_be_marked_there_is_a_sentence_and_no_zero(autograder, capsys, case):
    users, files, words = REFUSALS[case]
    root = autograder(users, **files)
    assert autograder_run.main(root) == 1
    said = capsys.readouterr().out
    assert said.startswith("Not marked: ")
    assert words in said
    assert not (root / "results").exists()


def test_without_walls_no_notebook_is_run_there(autograder, capsys, monkeypatch):
    monkeypatch.setattr(jails, "missing", lambda _: "a container")
    root = autograder([{"sid": "ada"}], one_dot_ipynb=notebook("lever_p = [0.0, 0.0]"))
    assert autograder_run.main(root) == 1
    assert "level strong is not to be had: a container" in capsys.readouterr().out
    assert not (root / "results").exists()


@pytest.mark.parametrize("more", [(), ("--accept-medium",)])
def test_how_far_the_walls_may_go_down_is_said_by_the_instructor(kinegrade, marked, tmp_path, more):
    kinegrade("export", "gradescope", "one", "-c", marked, "-o", tmp_path / "a.zip", *more)
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        about = json.loads(archive.read("course.json"))
    assert about["accept_medium"] is bool(more)


def test_deadlines_are_left_to_gradescope(kinegrade, marked, tmp_path):
    course = copytree(marked, tmp_path / "course")
    settings = course / "course.toml"
    settings.write_text(
        f"{settings.read_text()}deadline = 2020-01-01T00:00:00\ncloses = 2020-01-02T00:00:00\n"
    )
    kinegrade("export", "gradescope", "one", "-c", course, "-o", tmp_path / "a.zip")
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        (sheet,) = json.loads(archive.read("course.json"))["settings"]["sheet"]
    assert (sheet["deadline"], sheet["closes"]) == (None, None)


def test_a_sheet_that_was_not_drawn_has_no_autograder(kinegrade, tmp_path):
    course = make_course(tmp_path / "other")
    ran = kinegrade("export", "gradescope", "one", "-c", course)
    assert "nothing of sheet one was drawn yet; `kinegrade generate` comes first" in ran.err


def test_the_wheel_in_it_is_one_that_pip_installs(autograder, tmp_path):
    name, data = wheel()
    (tmp_path / name).write_bytes(data)
    pip = [sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--no-index"]
    subprocess.run([*pip, "--target", tmp_path / "there", tmp_path / name], check=True)
    root = autograder([{"sid": "ada"}], one_dot_json=b'{"lever_p": [0, 0]}')
    code = f"import sys; sys.path[:0] = {[str(tmp_path / 'there'), *neighbours()]!r}\n"
    code += "import runpy; sys.argv = ['x', sys.argv[1]]\n"
    code += "runpy.run_module('kinegrade.course.exchange.autograder_run', run_name='__main__')"
    ran = subprocess.run([sys.executable, "-S", "-c", code, root], check=False)
    assert ran.returncode == 0
    assert results_of(root)["score"] == 0


def test_junit_says_what_passed_failed_and_was_skipped(kinegrade, marked, tmp_path):
    ran = kinegrade("export", "junit", "one", "-c", marked, "-o", tmp_path / "j.xml")
    assert ran.code == 0
    suites = junitparser.JUnitXml.fromfile(str(tmp_path / "j.xml"))
    counts = [(suite.name, suite.tests, suite.failures, suite.skipped) for suite in suites]
    assert counts == [("ada/one", 2, 0, 0), ("ben/one", 2, 1, 0), ("cyd/one", 2, 0, 1)]
    scores = [{one.name: one.value for one in suite.properties()} for suite in suites]
    assert [one["score"] for one in scores] == ["5", "3.5", "2"]
    assert {one["max_score"] for one in scores} == {"5"}
    (failure, _) = [result for suite in suites for case in suite for result in case.result]
    assert failure.message == "partly correct, 1.5 of 3 points"
    assert "sign" in failure.text


def test_the_workflow_of_classroom_looks_at_a_sheet_without_any_secret(kinegrade, marked, tmp_path):
    ran = kinegrade("export", "classroom", "one", "-c", marked, "-o", tmp_path / "out")
    assert ran.code == 0
    template = tmp_path / "out" / "template"
    workflow = yaml.safe_load((template / ".github" / "workflows" / "classroom.yml").read_text())
    steps = workflow["jobs"]["autograding"]["steps"]
    install, check, _ = steps[2]["run"].splitlines()
    assert (template / install.split()[-1]).exists()
    assert steps[3]["env"] == {"KINEGRADE_RESULTS": "${{ steps.kinegrade.outputs.result }}"}
    for path in template.rglob("*"):
        assert path.name not in ("gradebook.sqlite", "secret", "lever.py")

    copytree(marked / "exercises", tmp_path / "repo" / "exercises")
    copy(marked / "released" / "ada" / "one.ipynb", tmp_path / "repo")
    subprocess.run([sys.executable, *check.split()[1:]], cwd=tmp_path / "repo", check=True)
    results = json.loads((tmp_path / "repo" / "result.json").read_text())
    assert results["max_score"] == 2
    assert results["status"] == "fail"
    assert [test["name"] for test in results["tests"]] == ["lever_p", "lever_J"]


def test_results_for_classroom_add_up_to_the_points(kinegrade, marked, tmp_path):
    kinegrade("export", "classroom", "one", "-c", marked, "-o", tmp_path / "out")
    files = sorted((tmp_path / "out" / "results").iterdir())
    assert [path.name for path in files] == ["ada.json", "ben.json", "cyd.json"]
    ada, ben, _ = [json.loads(path.read_text()) for path in files]
    assert [test["score"] for test in ben["tests"]] == [2, 1.5]
    assert (ada["status"], ben["status"], ben["max_score"]) == ("pass", "fail", 5)
    assert ben["tests"][1]["message"].startswith("partly correct, 1.5 of 3.")


def test_a_notebook_that_is_none_is_a_failed_test_with_a_sentence(tmp_path):
    (tmp_path / "one.ipynb").write_text("no notebook")
    classroom_check.main(tmp_path / "one.ipynb", tmp_path / "result.json")
    (test,) = json.loads((tmp_path / "result.json").read_text())["tests"]
    assert test["status"] == "fail"
    assert "does not say which sheet it belongs to" in test["message"]
