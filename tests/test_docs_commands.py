"""Every command on a page is run, in the order of the page, in a course of three students."""

import re
import shlex
import shutil
import subprocess
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest
import typer
from answers import answer_code
from courses import right_answers, write_secret
from kinegrade.course.cli import app
from kinegrade.course.commands.demo import fill_in
from kinegrade.course.commands.new_course import course_text
from kinegrade.course.handing_out.generate import generate
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.marking.how import How
from kinegrade.course.marking.written import mark_and_write
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import read_course
from kinegrade.course.settings.toml_tables import Settings
from kinegrade.grader.jail.level import ANY

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
FENCED = re.compile(
    r"(?:^<!-- not run: (?P<reason>[^>]+) -->\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```$",
    re.DOTALL | re.MULTILINE,
)
NEW_COURSE = "kinegrade init mycourse"
RECEIVED = "student,sheet,file,received\n"
MOST_NOT_RUN = 8
"""Of all blocks; who adds one finds a way to run another."""


@dataclass(frozen=True)
class Block:
    """What stands between two fences, and why it is not run, where it is not."""

    language: str
    text: str
    reason: str

    @property
    def lines(self):
        return [line for line in self.text.splitlines() if line.split("#")[0].strip()]

    @property
    def commands(self):
        """The arguments of every `kinegrade` in it."""
        split = [shlex.split(line, comments=True) for line in self.lines]
        return [words[1:] for words in split if words[0] == "kinegrade"]


def blocks_of(page, *languages):
    found = [
        Block(one["language"], one["text"], one["reason"] or "")
        for one in FENCED.finditer(page.read_text(encoding="utf-8"))
    ]
    return [block for block in found if block.language in languages]


WITH_COMMANDS = [page for page in PAGES if blocks_of(page, "sh")]
SETTINGS = [(page, block) for page in PAGES for block in blocks_of(page, "toml")]


@pytest.fixture(scope="session")
def marked_course(tmp_path_factory):
    """A course as `init` writes it, handed out and marked: Ada is right, Ben has a mistake, Cyd hands in nothing."""
    folder = tmp_path_factory.mktemp("pages") / "mycourse"
    folder.mkdir()
    roster = "student,name\nada,Ada Lovelace\nben,Ben Bot\ncyd,Cyd Third\n"
    (folder / "roster.csv").write_text(roster, encoding="utf-8")
    (folder / "course.toml").write_text(course_text("Tests"), encoding="utf-8")
    write_secret(folder)
    course = read_course(folder)
    (sheet,) = course.settings.sheet
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        generate(course, gradebook, [sheet])
        for student in ("ada", "ben"):
            answers = right_answers(course, student, sheet.name)
            if student == "ben":
                answers["rrt_J"] = answers["rrt_J"][[3, 4, 5, 0, 1, 2]]
            code = {
                part.variable: answer_code(part, answers[part.variable])
                for exercise in exercises_of(course, sheet)
                for part in exercise.asked
            }
            path = folder / "submitted" / student / "jacobian.ipynb"
            path.parent.mkdir(parents=True)
            released = folder / "released" / student / "jacobian.ipynb"
            path.write_bytes(fill_in(released.read_bytes(), code))
        mark_and_write(course, gradebook, [sheet], How(permission=ANY))
    return folder


@pytest.fixture
def folder(marked_course, tmp_path, monkeypatch):
    """Where commands are typed: the course lies there, and a student's own notebook."""
    shutil.copytree(marked_course, tmp_path / "mycourse")
    shutil.copy(marked_course / "submitted" / "ada" / "jacobian.ipynb", tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("page", WITH_COMMANDS, ids=lambda page: page.stem)
def test_the_commands_of_a_page_work_in_their_order(page, folder, kinegrade):
    told = page.read_text(encoding="utf-8")
    if NEW_COURSE in told:
        shutil.rmtree(folder / "mycourse")
    for block in blocks_of(page, "sh", "toml", "csv"):
        if block.reason:
            continue
        if block.language == "sh":
            typed(block, folder, kinegrade)
        elif block.text.startswith(RECEIVED):
            (folder / "mycourse" / "submitted" / "received.csv").write_text(block.text)
        elif 'name = "jacobian"' in block.text:
            (folder / "mycourse" / "course.toml").write_text(whole(block.text))


def typed(block, folder, kinegrade):
    """Runs the lines of a block; every one has to end well."""
    for line in block.lines:
        words = shlex.split(line, comments=True)
        if words[0] == "kinegrade":
            ran = kinegrade(*words[1:])
            assert ran.code == 0, f"{line}\n{ran.out}{ran.err}"
        else:
            subprocess.run(line, shell=True, check=True, cwd=folder)  # noqa: S602 - our own pages


@pytest.mark.parametrize("page", WITH_COMMANDS, ids=lambda page: page.stem)
def test_every_command_of_a_page_takes_its_options_also_where_it_is_not_run(page):
    """Click reads the arguments, and nothing is called."""
    group = typer.main.get_command(app)
    for block in blocks_of(page, "sh"):
        for words in block.commands:
            context, command = group.make_context("kinegrade", list(words)), group
            while hasattr(command, "resolve_command"):
                rest = [*context._protected_args, *context.args]
                name, command, rest = command.resolve_command(context, rest)
                context = command.make_context(name, rest, parent=context)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_commands_in_the_text_of_a_page_exist(page):
    text = FENCED.sub("", page.read_text(encoding="utf-8"))
    for line in re.findall(r"`kinegrade ([a-z]+(?: [a-z]+)?)[^`]*`", text):
        first, *second = line.split()
        group = typer.main.get_command(app)
        assert first in group.commands, line
        below = getattr(group.commands[first], "commands", {})
        assert not below or not second or second[0] in below, line


def test_few_blocks_are_not_run_and_each_says_why():
    reasons = [block.reason for page in PAGES for block in blocks_of(page, "sh") if block.reason]
    assert all(len(reason) > 20 for reason in reasons)
    assert len(reasons) <= MOST_NOT_RUN


@pytest.mark.parametrize(
    ("page", "block"), SETTINGS, ids=[f"{page.stem}-{i}" for i, (page, _) in enumerate(SETTINGS)]
)
def test_settings_on_a_page_are_read(page, block):
    Settings.model_validate(tomllib.loads(whole(block.text)))


def whole(text):
    """A course.toml with these lines: a title and a sheet are added where there are none."""
    before = (
        "" if re.search("^title =", text.partition("[[")[0], re.MULTILINE) else 'title = "Tests"\n'
    )
    behind = "" if "[[sheet]]" in text else '\n[[sheet]]\nname = "one"\nexercises = ["rrt"]\n'
    return before + text + behind
