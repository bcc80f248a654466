"""What people see while a long command works."""

import io
import re
import sys

import pytest
from courses import hand_in, handed_out, make_course, right_answers
from kinegrade.course.machine.console import ASCII, progress, say, shown
from kinegrade.course.results.tables import MARKS, legend
from kinegrade.course.student.check import remark_lines
from kinegrade.grader.marking.own_work import Remark


def test_no_terminal_obeys_what_is_said(capsys):
    say("ada: \x1b[1A\x1b[2Kall right\x07\nben \N{RIGHT-TO-LEFT OVERRIDE}")
    assert capsys.readouterr().err == "ada: \ufffd[1A\ufffd[2Kall right\ufffd\nben \ufffd\n"


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_bar_says_how_much_is_done_and_how_long_the_rest_takes(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    for name, value in {"TERM": "xterm", "COLUMNS": "80"}.items():
        monkeypatch.setenv(name, value)
    with progress("Marking", 4) as step:
        step()
        step(2)
    said = terminal.getvalue()
    assert "Marking" in said
    assert "3/4" in said
    assert re.search(r"\d:\d\d:\d\d|-:--:--", said)


def test_into_a_file_there_is_no_bar(monkeypatch):
    file = io.StringIO()
    monkeypatch.setattr(sys, "stderr", file)
    with progress("Marking", 4) as step:
        step()
    assert file.getvalue() == ""


def console_of(encoding):
    return io.TextIOWrapper(io.BytesIO(), encoding=encoding)


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "cp850", "utf-8"])
def test_marks_differ_on_every_console_and_the_legend_has_them(monkeypatch, encoding):
    monkeypatch.setattr(sys, "stdout", console_of(encoding))
    marks = [shown(mark) for mark in MARKS.values()]
    assert len(set(marks)) == len(MARKS)
    for mark, told in zip(marks, legend().split("   "), strict=True):
        mark.encode(encoding)
        assert told.startswith(f"{mark} ")


def test_only_a_console_without_the_marks_shows_others(monkeypatch):
    monkeypatch.setattr(sys, "stdout", console_of("utf-8"))
    assert [*map(shown, ASCII)] == [*ASCII]


def test_right_and_wrong_look_different_on_an_ascii_console(tmp_path, kinegrade, monkeypatch):
    made = handed_out(make_course(tmp_path))
    hand_in(made, "ada", right_answers(made, "ada") | {"lever_J": [9, 9]})
    out = console_of("ascii")
    monkeypatch.setattr(sys, "stdout", out)
    ran = kinegrade("grade", "--course", tmp_path)
    out.seek(0)
    table = out.read()
    assert re.search(r"ada +\| \+x +\| +2 / 5", table)
    assert re.search(r"ben +\| +\| +- \| no submission", table)
    assert "+ correct" in ran.err
    assert "x incorrect" in ran.err


@pytest.mark.parametrize(("encoding", "signs"), [("ascii", "+x"), ("utf-8", "✓✗")])
def test_a_check_tells_right_from_wrong_on_every_console(monkeypatch, encoding, signs):
    monkeypatch.setattr(sys, "stdout", console_of(encoding))
    found = [Remark("rrt_J", ok=True, text="so"), Remark("rrt_J", ok=False, text="not so")]
    assert [line[0] for line in remark_lines(found)] == [*signs]
