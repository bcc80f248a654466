"""Feedback and report: whole pages that need nothing else, escape everything, and never print a reference value."""

import re
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest
from answers import EXERCISES, raws, variant_of
from courses import make_course, sheet
from kinegrade.course import pages
from kinegrade.course.config import Student, read_course
from kinegrade.course.grading import Result
from kinegrade.course.pages import write_feedback, write_report
from kinegrade.exercises.exercise import Numbers, references
from kinegrade.grader.mark import mark
from kinegrade.grader.verdict import Finding, Verdict, not_graded

ADA = Student("ada", "Ada Lovelace")
NASTY = "<script>alert('x')</script>\"><img src=x onerror=y> & {{ 7 * 7 }} \ud800"
VOID = {"meta", "br", "img", "hr", "link", "input"}


class Page(HTMLParser):
    """What stands on a page; an element that is not closed is an error."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.attributes, self.text, self.open = [], [], "", []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += attrs
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data


@pytest.fixture
def course(tmp_path):
    return read_course(make_course(tmp_path))


def feedback(course, exercise, verdicts, student=ADA):
    path = write_feedback(
        course, sheet(exercises=(exercise.slug,)), [exercise], Result(student, "one", tuple(verdicts))
    )
    assert path == course.folder / "feedback" / student.id / "one.html"
    return path.read_text(encoding="utf-8")


def report(course, exercises, results, monkeypatch):
    monkeypatch.setattr(pages, "_figure", lambda _, name: {"file": f"{name}.png", "title": name, "alt": "a map"})
    path = write_report(course, [(sheet(exercises=tuple(e.slug for e in exercises)), exercises, results)])
    assert path == course.folder / "report" / "index.html"
    return path.read_text(encoding="utf-8")


def spoiled(exercise, seed=0):
    v = variant_of(exercise.slug, seed)
    answers = references(exercise, v)
    return v, {k: -1.3 * x if isinstance(x, np.ndarray) else "x" for k, x in answers.items()}


def test_a_page_needs_nothing_but_itself(course, exercise):
    v, answers = spoiled(exercise)
    text = feedback(course, exercise, mark(exercise, v, raws(answers)))
    page = Page(text)
    assert not {"script", "link", "iframe", "object", "img"} & set(page.tags)
    assert [value for name, value in page.attributes if name in ("src", "href")] == []
    assert not re.search(r"url\(|@import", text)


def test_the_matrices_show_the_students_own_entries_marked_right_or_wrong(course, exercise):
    v = variant_of(exercise.slug)
    answers = references(exercise, v)
    for part in exercise.asked:
        if isinstance(part.answer, Numbers):
            answers[part.variable] = answers[part.variable].copy()
            answers[part.variable].flat[0] = 123.4567
    text = feedback(course, exercise, mark(exercise, v, raws(answers)))
    wrong = re.findall(r'<td class="wrong">([^<]*)</td>', text)
    numeric = [part for part in exercise.asked if isinstance(part.answer, Numbers)]
    assert sum(cell.startswith("123.45") for cell in wrong) == len(numeric)
    cells = sum(int(np.prod(part.answer.shape)) for part in numeric)
    cells += sum(4 * len(part.answer.kinds) for part in exercise.asked if part not in numeric)
    assert text.count('<td class="right">') + len(wrong) == cells


def test_feedback_never_prints_a_reference_value(course, exercise):
    for seed in range(3):
        v, answers = spoiled(exercise, seed)
        text = Page(feedback(course, exercise, mark(exercise, v, raws(answers)))).text
        own = " ".join(f"{abs(x):.5f}" for a in answers.values() if isinstance(a, np.ndarray) for x in a.ravel())
        for part in exercise.asked:
            if isinstance(part.answer, Numbers):
                values = np.abs(references(exercise, v)[part.variable]).ravel()
                telling = [f"{x:.4f}"[:-1] for x in values if abs(x - round(x, 2)) > 1e-6]
                assert [text_of for text_of in telling if text_of in text and text_of not in own] == []


def test_names_findings_and_answers_are_escaped(course):
    exercise = EXERCISES["rrt"]
    cells = [[NASTY] * 4] * 3
    verdicts = [
        Verdict("rrt_dh", "incorrect", 0.0, 3, (Finding(NASTY),), NASTY, [[False] * 4] * 3, cells),
        not_graded("rrt_T", 3, NASTY),
    ]
    page = Page(feedback(course, exercise, verdicts, Student("ada", NASTY)))
    assert "script" not in page.tags
    assert "img" not in page.tags
    assert page.text.count(NASTY.replace("\ud800", "?")) == 2 + 2 + 12 + 1


def test_what_is_private_stands_in_the_report_and_not_in_the_feedback(course, monkeypatch):
    exercise = EXERCISES["rrt"]
    verdicts = (Verdict("rrt_dh", "incorrect", 0.0, 3, (Finding("like ben's", private=True), Finding("open"))),)
    assert "like ben's" not in Page(feedback(course, exercise, verdicts)).text
    page = Page(report(course, [exercise], [Result(ADA, "one", verdicts)], monkeypatch))
    assert "For you only: like ben's" in page.text
    assert "rrt_dh: open" in page.text


def test_what_waits_is_said_and_is_no_zero(course):
    exercise = EXERCISES["rrt"]
    verdicts = [Verdict("rrt_dh", "correct", 3.0, 3), not_graded("rrt_T", 3, "Because.")]
    page = Page(feedback(course, exercise, verdicts))
    assert "not graded – part of this sheet waits for your instructor" in page.text
    assert "? not graded yet, – of 3 points" in page.text
    assert "Because." in page.text


def test_the_report_counts_the_class_and_links_its_feedback(course, monkeypatch):
    exercise = EXERCISES["rrt"]
    results = [
        Result(ADA, "one", (Verdict("rrt_dh", "correct", 3.0, 3), Verdict("rrt_T", "missing", 0.0, 3))),
        Result(Student("ben", NASTY), "one", (not_graded("rrt_dh", 3, NASTY),)),
        Result(Student("cyd", "Cyd"), "one", reason="no submission"),
    ]
    page = Page(report(course, [exercise], results, monkeypatch))
    assert "Mode graded: 1 marked, 1 not graded, 1 without a submission." in page.text
    assert "1 correct, 1 not graded yet" in page.text
    links = [value for name, value in page.attributes if name == "href"]
    assert links == ["../feedback/ada/one.html", "../feedback/ben/one.html"]
    assert "script" not in page.tags
    assert [value for name, value in page.attributes if name == "src"] == [f"{exercise.robot}.png"]


def test_a_report_of_exercises_without_a_robot_has_no_figures(course, monkeypatch):
    lever = SimpleNamespace(robot=None, asked=(), slug="lever", title="A lever")
    assert "img" not in Page(report(course, [lever], [], monkeypatch)).tags


def test_a_map_is_drawn_once_per_version(tmp_path, monkeypatch):
    drawn = []

    def save(arm, path):
        drawn.append(arm.name)
        path.write_bytes(b"png")

    monkeypatch.setattr("kinegrade.grader.maps.save", save)
    monkeypatch.setattr("kinegrade.grader.maps.describe", lambda arm: f"map of {arm.name}")
    figures = [pages._figure(tmp_path / "report", "planar_2r") for _ in range(2)]
    assert drawn == ["planar_2r"]
    assert figures[0] == figures[1]
    assert figures[0]["alt"] == "map of planar_2r"
    monkeypatch.setattr(pages, "version", lambda _: "99")
    pages._figure(tmp_path / "report", "planar_2r")
    assert len(drawn) == 2


def test_a_map_without_its_description_is_drawn_again(tmp_path, monkeypatch):
    monkeypatch.setattr(pages, "version", lambda _: "1")
    monkeypatch.setattr("kinegrade.grader.maps.save", lambda _, path: path.write_bytes(b"whole"))
    monkeypatch.setattr("kinegrade.grader.maps.describe", lambda _: "a map")
    (tmp_path / "planar_2r-1.png").write_bytes(b"ha")
    pages._figure(tmp_path, "planar_2r")
    assert (tmp_path / "planar_2r-1.png").read_bytes() == b"whole"
