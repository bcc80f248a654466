"""`%load_ext kinegrade` gives `%check`, which says what `kinegrade check` says, of the notebook as it was saved."""

import json

import nbformat
import pytest
from courses import CLASS, handed_out, make_course
from kinegrade.course.commands.demo import fill_in
from kinegrade.course.student.magic import check
from nbclient import NotebookClient

WHERE = """
import os
os.environ["JPY_SESSION_NAME"] = os.path.abspath("mine.ipynb")
"""


@pytest.fixture
def sheet(tmp_path, monkeypatch):
    """A practice sheet with one wrong and one missing answer, alone in the current folder."""
    course = handed_out(make_course(tmp_path / "course", students=CLASS[:1], mode="practice"))
    released = course.folder / "released" / "ada" / "one.ipynb"
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "exercises").symlink_to(course.folder / "exercises")
    path = folder / "mine.ipynb"
    path.write_bytes(fill_in(released.read_bytes(), {"lever_p": "lever_p = [9, 9]"}))
    monkeypatch.chdir(folder)
    return path


def lines(text):
    return [line for line in text.splitlines() if line.startswith(("✓", "✗"))]


def test_it_says_what_the_command_says(sheet, kinegrade, capsys):
    ran = kinegrade("check", sheet)
    check("mine.ipynb")
    said = capsys.readouterr().out
    assert lines(said) == lines(ran.out)
    assert len(lines(said)) == 2
    assert "Practice sheet" in said
    assert "mine.ipynb as it was saved at" in said


def test_the_only_sheet_of_a_folder_needs_no_name(sheet, capsys):
    (sheet.parent / "other.ipynb").write_text("{}", encoding="utf-8")
    check("")
    assert len(lines(capsys.readouterr().out)) == 2


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("", "this folder has mine.ipynb, second.ipynb; say which: %check FILE.ipynb"),
        ("nowhere.ipynb", "nowhere.ipynb cannot be read: No such file"),
        ("a b", "%check takes one file, got a b"),
    ],
)
def test_a_sentence_says_what_is_missing(sheet, capsys, line, words):
    (sheet.parent / "second.ipynb").write_bytes(sheet.read_bytes())
    check(line)
    assert words in capsys.readouterr().out


def test_it_is_loaded_by_its_name_in_a_kernel_and_finds_the_notebook_it_stands_in(sheet):
    second = sheet.with_name("second.ipynb")
    second.write_bytes(sheet.read_bytes())
    cells = [nbformat.v4.new_code_cell(text) for text in (WHERE, "%load_ext kinegrade", "%check")]
    notebook = nbformat.v4.new_notebook(cells=cells)
    NotebookClient(notebook, resources={"metadata": {"path": str(sheet.parent)}}).execute()
    said = "".join(output.get("text", "") for output in notebook.cells[2].outputs)
    assert len(lines(said)) == 2
    assert "mine.ipynb as it was saved at" in said


def test_a_sheet_that_calls_it_is_marked_all_the_same(sheet, kinegrade):
    content = json.loads(sheet.read_bytes())
    called = nbformat.v4.new_code_cell("%load_ext kinegrade\n%check\nlever_J = [9, 9]")
    content["cells"].append(called)
    sheet.write_text(json.dumps(content), encoding="utf-8")
    ran = kinegrade("check", sheet)
    assert "In your file" not in ran.out
    assert "not answered" not in ran.out
