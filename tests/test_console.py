"""What people see while a long command works."""

import io
import re
import sys

from kinegrade.course.machine.console import progress, say


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
