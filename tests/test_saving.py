"""Grades on their way into the gradebook: at once, or together where they come quickly."""

import pytest
from kinegrade.course.marking import saving
from kinegrade.course.marking.saving import Saving


class Noted:
    """A gradebook that notes what is saved together."""

    def __init__(self):
        self.saved = []

    def save_grades(self, graded):
        if graded:
            self.saved.append([*graded])


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(saving.time, "monotonic", lambda: now[0])
    return now


def test_slow_grades_are_saved_one_by_one(clock):
    gradebook = Noted()
    with Saving(gradebook) as grades:
        for key in "abc":
            clock[0] += 2 * saving.PAUSE
            grades.add(key, [])
        assert gradebook.saved == [["a"], ["b"], ["c"]]
    assert gradebook.saved == [["a"], ["b"], ["c"]]


def test_quick_grades_go_together_and_none_is_left(clock):
    gradebook = Noted()
    with Saving(gradebook) as grades:
        for key in "abc":
            grades.add(key, [])
        assert gradebook.saved == [["a"]]
        clock[0] += 2 * saving.PAUSE
        grades.add("d", [])
        grades.add("e", [])
    assert gradebook.saved == [["a"], ["b", "c", "d"], ["e"]]


def test_many_quick_grades_do_not_wait(clock):
    gradebook = Noted()
    with Saving(gradebook) as grades:
        for key in range(2 * saving.MOST):
            grades.add(key, [])
        assert list(map(len, gradebook.saved)) == [1, saving.MOST]
    assert sum(map(len, gradebook.saved)) == 2 * saving.MOST


def test_ctrl_c_saves_what_was_marked(clock):
    gradebook = Noted()

    def stopped():
        with Saving(gradebook) as grades:
            grades.add("a", [])
            grades.add("b", [])
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        stopped()
    assert gradebook.saved == [["a"], ["b"]]


def test_what_could_not_be_saved_is_not_tried_twice(clock):
    class Broken:
        tries = 0

        def save_grades(self, graded):
            if graded:
                self.tries += 1
                raise ZeroDivisionError

    gradebook = Broken()
    with pytest.raises(ZeroDivisionError), Saving(gradebook) as grades:
        grades.add("a", [])
    assert gradebook.tries == 1
