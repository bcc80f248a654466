"""Recorded answers are computed again only when a file, a library or a version changed."""

import os

import pytest
from courses import CLASS, LEVER, handed_out, make_course
from kinegrade.course.grading import holding as module
from kinegrade.course.grading.holding import Holding
from kinegrade.course.grading.place import Here
from kinegrade.course.grading.task import CHECK
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.machine.kept import cache_folder, keep, kept


class Counting(Here):
    """Counts the records that are looked at."""

    def __init__(self):
        super().__init__(None)
        self.looked = 0

    def run(self, task, pieces, expected):
        assert task is CHECK
        taken = list(pieces)
        self.looked += sum(len(check.records) for _, check in taken)
        return super().run(task, taken, expected)


def look(course):
    """What moved, and how many records were looked at."""
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        records = gradebook.records("one")
    place = Counting()
    return Holding(course, "one", ("lever",)).moved(records, place), place.looked


@pytest.fixture
def course(tmp_path):
    return handed_out(make_course(tmp_path / "course"))


def lose(course):
    for path in (cache_folder() / module.HOLDING).glob("*"):
        path.unlink()


def test_what_was_drawn_here_is_not_computed_again(course):
    assert look(course) == ({}, 0)


def test_a_lost_or_broken_cache_costs_a_look_and_no_more(course):
    lose(course)
    assert look(course) == ({}, len(CLASS))
    assert look(course) == ({}, 0)
    for path in (cache_folder() / module.HOLDING).glob("*"):
        path.write_text("[", encoding="utf-8")
    assert look(course) == ({}, len(CLASS))


def changed_exercise(course, monkeypatch):
    path = course.folder / "exercises" / "lever.py"
    path.write_text(LEVER + "# another text\n", encoding="utf-8")


def changed_data(course, monkeypatch):
    (course.folder / "exercises" / "lengths.csv").write_text("1,2\n", encoding="utf-8")


def changed_library(course, monkeypatch):
    monkeypatch.setattr(module, "installed", lambda _: "another")


@pytest.mark.parametrize("change", [changed_exercise, changed_data, changed_library])
def test_after_a_change_everything_is_looked_at_once(course, change, monkeypatch):
    change(course, monkeypatch)
    assert look(course) == ({}, len(CLASS))
    assert look(course) == ({}, 0)


def test_what_moved_is_looked_at_every_time(course):
    path = course.folder / "exercises" / "lever.py"
    path.write_text(LEVER.replace("[-y, x]", "[y, x]"), encoding="utf-8")
    moved = {(student, "lever"): ("lever_J",) for student, _ in CLASS}
    assert look(course) == (moved, len(CLASS))
    assert look(course) == (moved, len(CLASS))


def test_a_cache_that_cannot_be_written_is_none(tmp_path, monkeypatch):
    place = tmp_path / "file"
    place.touch()
    monkeypatch.setenv("XDG_CACHE_HOME", os.fspath(place))
    keep("x", tmp_path, "one", {"a": 1})
    assert kept("x", tmp_path, "one") == {}


def test_courses_in_different_folders_know_nothing_of_each_other(tmp_path):
    keep("x", tmp_path / "a", "one", {"a": 1})
    assert kept("x", tmp_path / "a", "one") == {"a": 1}
    assert kept("x", tmp_path / "b", "one") == {}
