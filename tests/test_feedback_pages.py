"""A class's pages: written on all cores, and only where they would show something new."""

import pytest
from courses import CLASS, files_of, hand_in, handed_out, make_course, right_answers
from kinegrade.course.grading import processes
from kinegrade.course.pages import feedback, feedback_pages
from kinegrade.course.settings.config import read_course


@pytest.fixture
def folder(class_of_three, kinegrade):
    """Everybody handed in what is right, and has a page."""
    for student, _ in CLASS:
        hand_in(class_of_three, student, right_answers(class_of_three, student))
    assert kinegrade("grade", "-c", class_of_three.folder).code == 0
    return class_of_three.folder


@pytest.fixture
def written(monkeypatch):
    """Students whose page is rendered from now on."""
    students, real = [], feedback.write_feedback

    def counting(course, sheet, exercises, result, records):
        students.append(result.student.id)
        return real(course, sheet, exercises, result, records)

    monkeypatch.setattr(feedback, "write_feedback", counting)
    return students


def page(folder, student):
    return folder / "feedback" / student / "one.html"


def test_pages_that_would_show_the_same_are_not_made_again(folder, kinegrade, written):
    before = files_of(folder / "feedback")
    for command in ("grade", "report"):
        assert kinegrade(command, "-c", folder).code == 0
    assert written == []
    assert files_of(folder / "feedback") == before


def lost(folder, _):
    page(folder, "ben").unlink()


def edited(folder, _):
    page(folder, "ben").write_text("5 of 5!", encoding="utf-8")


def handed_in_again(folder, _):
    hand_in(read_course(folder), "ben", {"lever_p": [1.0, 2.0]})


def another_sheet_in_hand(folder, _):
    released = folder / "released" / "ben" / "one.ipynb"
    released.write_bytes(released.read_bytes() + b"\n")


@pytest.mark.parametrize("change", [lost, edited, handed_in_again, another_sheet_in_hand])
def test_a_page_that_changed_or_is_gone_is_made_again_and_no_other(
    folder, kinegrade, written, change
):
    change(folder, kinegrade)
    assert kinegrade("grade", "-c", folder).code == 0
    assert written == ["ben"]
    assert "Ben Bot" in page(folder, "ben").read_text(encoding="utf-8")
    kinegrade("grade", "-c", folder)
    assert written == ["ben"]


def test_other_code_or_settings_make_all_pages_again(folder, kinegrade, written, monkeypatch):
    settings = folder / "course.toml"
    text = settings.read_text(encoding="utf-8")
    settings.write_text(text.replace("Sheet one", "Sheet 1"), encoding="utf-8")
    kinegrade("grade", "-c", folder)
    assert sorted(written) == [student for student, _ in CLASS]
    monkeypatch.setattr(feedback_pages, "code_hash", lambda: "another")
    kinegrade("grade", "-c", folder)
    assert len(written) == 2 * len(CLASS)


def test_worker_processes_write_the_pages_that_one_process_writes(
    folder, kinegrade, written, monkeypatch
):
    before = files_of(folder / "feedback")
    for path in (folder / "feedback").rglob("*.html"):
        path.unlink()
    monkeypatch.setattr(processes, "WORTH", 2)
    monkeypatch.setattr(processes, "cores", lambda: 2)
    assert kinegrade("report", "-c", folder).code == 0
    assert written == []  # not here
    assert files_of(folder / "feedback") == before


def test_a_page_that_cannot_be_written_is_named(folder, kinegrade):
    path = page(folder, "ben")
    path.unlink()
    path.mkdir()
    ran = kinegrade("report", "-c", folder)
    assert ran.code == 1
    assert "one.html" in ran.err


def test_the_pages_of_a_course_say_nothing_of_another(tmp_path, kinegrade, written):
    for name in ("a", "b"):
        course = handed_out(make_course(tmp_path / name))
        hand_in(course, "ada", right_answers(course, "ada"))
        kinegrade("grade", "-c", course.folder)
    assert written == ["ada", "ada"]
