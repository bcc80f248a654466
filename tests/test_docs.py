"""What README and docs show is run, and what they point to is there."""

import re
import shlex
from pathlib import Path

import downloads
import numpy as np
import pytest
from answers import answer_code, raws
from courses import hand_in, handed_out, make_course, right_answers
from kinegrade.course.commands.demo import fill_in
from kinegrade.course.commands.new_course import write_course
from kinegrade.course.grading.place import Here
from kinegrade.course.handing_out.generate import generate
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.marking.marker import SheetMarker
from kinegrade.course.proof.validate import validate_file
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import read_course
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.mark import mark

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


def test_the_python_of_the_readme_prints_the_twist_of_the_puma(capsys):
    for block in blocks(ROOT / "README.md", "python"):
        exec(block, {})  # noqa: S102 - our own page
    assert capsys.readouterr().out == "[-1.2889  0.0233 -0.1734  0.3338 -3.2993  1.3648]\n"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_link_and_picture_is_there(page):
    targets = re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8"))
    assert [target for target in targets if not (page.parent / target).exists()] == []


@pytest.mark.parametrize("command", ["init", "generate", "grade", "check", "plot", "validate"])
def test_every_command_of_the_readme_exists(command):
    from kinegrade.course import cli

    assert f"kinegrade {command}" in (ROOT / "README.md").read_text(encoding="utf-8")
    assert command in [
        getattr(registered.callback, "__name__", "") for registered in cli.app.registered_commands
    ]


def test_the_exercise_of_the_docs_is_short():
    assert len(blocks(ROOT / "docs" / "add_an_exercise.md", "python")[0].splitlines()) <= 25


def test_the_exercise_of_the_docs_is_validated_released_solved_and_marked(tmp_path, jail):
    page = ROOT / "docs" / "add_an_exercise.md"
    write_course(tmp_path)
    (tmp_path / "exercises").mkdir()
    (tmp_path / "exercises" / "tip_speed.py").write_text(
        blocks(page, "python")[0], encoding="utf-8"
    )
    settings = tmp_path / "course.toml"
    settings.write_text(
        settings.read_text(encoding="utf-8") + blocks(page, "toml")[0], encoding="utf-8"
    )
    course = read_course(tmp_path)
    assert validate_file(tmp_path / "exercises" / "tip_speed.py", 100).failures == ()
    (sheet,) = course.sheets(("extra",))
    (exercise,) = exercises_of(course, sheet)
    with Gradebook(tmp_path / "gradebook.sqlite") as gradebook:
        first, second = generate(course, gradebook, (sheet,))
        records = {record.student: record for record in gradebook.records("extra")}
        for released, wrong in ((first, False), (second, True)):
            answers = references(exercise, records[released.student].numbers)
            if wrong:
                answers["tip_speed_J"] = answers["tip_speed_J"] * [1, -1]
            code = {
                part.variable: answer_code(part, answers[part.variable]) for part in exercise.asked
            }
            submitted = tmp_path / "submitted" / released.student / "extra.ipynb"
            submitted.parent.mkdir(parents=True)
            submitted.write_bytes(fill_in(released.path.read_bytes(), code))
        results = SheetMarker(course, gradebook, sheet, Here(jail)).results()
    assert [result.points for result in results] == [3, 2.5]


def test_the_exercise_of_the_docs_gives_zeros_nothing(tmp_path):
    from kinegrade.exercises.files.finding import load

    path = tmp_path / "tip_speed.py"
    path.write_text(blocks(ROOT / "docs" / "add_an_exercise.md", "python")[0], encoding="utf-8")
    exercise = load(path)
    v = exercise.draw(np.random.default_rng(0))
    zeros = {"tip_speed_J": np.zeros((2, 2)), "tip_speed_xi": np.zeros(2)}
    assert sum(verdict.points or 0 for verdict in mark(exercise, v, raws(zeros))) == 0


def commands(page):
    """The lines of a page that run Kinegrade, without what is said behind them."""
    lines = "\n".join(blocks(page, "sh")).splitlines()
    return [line.partition(" # ")[0].strip() for line in lines if line.startswith("kinegrade ")]


def as_other_systems_wrote_it(folder):
    """Downloads and tables under the names that the page on exchange gives them."""
    downloads.written(folder / "worksheet.csv", downloads.MOODLE)
    downloads.written(folder / "gradebook.csv", downloads.CANVAS)
    downloads.written(folder / "grades.csv", downloads.CLASSROOM)
    ada = downloads.sheet_of("ada", sheet="jacobian")
    downloads.zip_file(
        folder / "export.zip",
        {
            "submission_metadata.yml": downloads.GRADESCOPE.encode(),
            "submission_501/jacobian.ipynb": ada,
        },
    )
    for place in ("nbgrader_course/submitted/ada/jacobian", "repositories/jacobian-lady-ada"):
        (folder / place).mkdir(parents=True)
        (folder / place / "jacobian.ipynb").write_bytes(ada)
        (folder / place / "timestamp.txt").write_text("2026-11-24 10:00:00 UTC")


def test_every_command_of_the_page_on_exchange_does_its_work(kinegrade, tmp_path, monkeypatch):
    settings = make_course(tmp_path / "mycourse") / "course.toml"
    settings.write_text(settings.read_text().replace('name = "one"', 'name = "jacobian"'))
    course = handed_out(tmp_path / "mycourse")
    for student in ("ada", "ben"):
        answers = right_answers(course, student, "jacobian")
        hand_in(course, student, answers, "jacobian.json")
    as_other_systems_wrote_it(tmp_path)
    monkeypatch.chdir(tmp_path)
    done = []
    for command in commands(ROOT / "docs" / "exchange.md"):
        system = "canvas" if "canvas" in command else "moodle"
        downloads.zip_file(tmp_path / "submissions.zip", SUBMISSIONS[system])
        _, *words = shlex.split(command)
        ran = kinegrade(*words)
        assert ran.code == 0, (command, ran.err)
        done.append(words[0])
    assert set(done) == {"collect", "handout", "handback", "export", "grade"}


SUBMISSIONS = {
    "moodle": {
        "Ben Bot_9002_assignsubmission_file/jacobian.json": b"{}",
    },
    "canvas": {"botben_4712_88002_jacobian.json": b"{}"},
}
