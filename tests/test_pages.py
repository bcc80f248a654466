"""Feedback and report: whole pages that need nothing else, escape everything, and never print a reference value."""

import math
import os
import re
from html import escape, unescape
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest
from answers import EXERCISES, part_of, raws, raws_of, telling, variant_of, wrong
from courses import make_course, sheet
from kinegrade.course import pages
from kinegrade.course.config import Student, read_course
from kinegrade.course.gradebook import Mark
from kinegrade.course.grading import Result
from kinegrade.course.marks import answer_id, with_marks
from kinegrade.course.pages import write_feedback, write_report
from kinegrade.exercises.exercise import (
    Choice,
    Conditions,
    Formulas,
    Function,
    Manual,
    Numbers,
    TableOf,
    references,
)
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.verdict import Finding, Verdict, not_graded

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
        course,
        sheet(exercises=(exercise.slug,)),
        [exercise],
        Result(student, "one", tuple(verdicts)),
    )
    assert path == course.folder / "feedback" / student.id / "one.html"
    return path.read_text(encoding="utf-8")


def report(course, exercises, results, monkeypatch):
    monkeypatch.setattr(
        pages, "_figure", lambda _, name: {"file": f"{name}.png", "title": name, "alt": "a map"}
    )
    path = write_report(
        course, [(sheet(exercises=tuple(e.slug for e in exercises)), exercises, results)]
    )
    assert path == course.folder / "report" / "index.html"
    return path.read_text(encoding="utf-8")


def spoiled(exercise, seed=0):
    """A variant, its answers, all of them wrong, and the verdicts on them."""
    v = variant_of(exercise.slug, seed)
    answers = references(exercise, v)
    own = {part.variable: wrong(part, answers[part.variable], v) for part in exercise.asked}
    return v, own, mark(exercise, v, raws_of(exercise, v, own))


def test_a_page_needs_nothing_but_itself(course, exercise):
    *_, verdicts = spoiled(exercise)
    text = feedback(course, exercise, verdicts)
    page = Page(text)
    assert not {"script", "link", "iframe", "object", "img"} & set(page.tags)
    assert [value for name, value in page.attributes if name in ("src", "href")] == []
    assert not re.search(r"url\(|@import", text)


def cells(text):
    """Whether each cell of the matrices on a page is right, and its text."""
    found = re.findall(r'<td class="(right|wrong)(?: typed)?">([^<]*)</td>', text)
    assert len(found) == text.count("<td")
    return [(right == "right", unescape(cell)) for right, cell in found]


def count_of(part, answer):
    """How many cells an answer is shown in: one for every entry, none for what is no table."""
    if isinstance(part.answer, Function | Manual):
        return 0
    if isinstance(part.answer, TableOf):
        return 4 * len(part.answer.kinds)
    return (
        len(answer) if isinstance(part.answer, Conditions) else math.prod(np.shape(answer) or (1,))
    )


def test_the_matrices_show_the_students_own_entries_marked_right_or_wrong(course, exercise):
    v = variant_of(exercise.slug)
    answers = references(exercise, v)
    numeric = [part for part in exercise.asked if isinstance(part.answer, Numbers)]
    for part in exercise.asked:
        if part in numeric:
            answers[part.variable] = answers[part.variable].copy()
            answers[part.variable].flat[0] = 123.4567
        elif isinstance(part.answer, Formulas):
            answers[part.variable] = answers[part.variable].text()  # as typed
    own = {
        **answers,
        **{name: np.array(text) for name, text in answers.items() if isinstance(text, list)},
    }
    verdicts = mark(exercise, v, raws_of(exercise, v, answers))
    shown = cells(feedback(course, exercise, verdicts))
    assert [right for right, cell in shown if cell.startswith("123")] == [False] * len(numeric)
    assert len(shown) == sum(count_of(part, own[part.variable]) for part in exercise.asked)


def test_feedback_never_prints_a_reference_value(course, exercise):
    for seed in range(3):
        v, own, verdicts = spoiled(exercise, seed)
        page = feedback(course, exercise, verdicts)
        text = Page(re.sub(r"<td[^>]*>[^<]*</td>", "", page)).text  # cells hold what was handed in
        answers = references(exercise, v)
        for part in exercise.asked:
            if not isinstance(part.answer, Choice):  # its options stand on the page, all of them
                told = telling(part, answers[part.variable], v) - telling(
                    part, own[part.variable], v
                )
                assert [secret for secret in told if secret in text] == []


def block(text, variable):
    """The section of one part."""
    start = text.index(f"<code>{variable}</code>")
    return text[start : text.index("</section>", start)]


def one(course, slug, variable, raw, seed=0):
    """The section of one part on the page of a sheet on which nothing else was answered."""
    exercise, v = EXERCISES[slug], variant_of(slug, seed)
    return block(feedback(course, exercise, mark(exercise, v, raws({variable: raw}))), variable)


@pytest.mark.parametrize("right", [True, False])
def test_a_choice_is_shown_with_its_options_the_students_letter_and_whether_it_is_right(
    course, right
):
    exercise, v = EXERCISES["find_the_mistake"], variant_of("find_the_mistake")
    part = part_of(exercise, "find_the_mistake_name")
    reference = references(exercise, v)[part.variable]
    letter = reference if right else wrong(part, reference, v)
    text = one(course, exercise.slug, part.variable, letter)
    listed = Page(text[text.index("<ol") : text.index("</ol>") + len("</ol>")])
    assert listed.tags.count("li") == len(part.answer.options)
    assert cells(text) == [(right, letter)]


def test_conditions_are_shown_one_by_one(course):
    exercise, v = EXERCISES["rrt"], variant_of("rrt")
    part = part_of(exercise, "rrt_singular")
    right = [f"{condition} = 0" for condition in references(exercise, v)[part.variable]]
    text = one(course, "rrt", part.variable, [*right, "q1 - 0.123 = 0"])
    assert [ok for ok, _ in cells(text)] == [True] * len(right) + [False]
    assert cells(text)[-1][1] == "q1 - 0.123 = 0"
    assert "A condition of yours holds at postures that are not asked for." in text


def test_a_formula_that_cannot_be_read_is_shown_with_a_caret_below_the_place(course):
    text = one(course, "rrt", "rrt_det", "sin(q2) * wrong & <b>")
    (typed,) = re.findall(r"<pre>([^<]*)</pre>", text)
    line, caret = unescape(typed).split("\n")
    assert line == "sin(q2) * wrong & <b>"
    assert "^" in caret
    assert caret.index("^") <= len(line)
    assert re.search(r"<li>[^<]+\.<pre>", text)
    assert "could not be read" in text


def test_a_function_is_told_group_by_group(course):
    exercise, v = EXERCISES["implement_it"], variant_of("implement_it")
    part = part_of(exercise, "implement_it_jacobian")
    groups = part.answer.inputs(v)
    reference = references(exercise, v)[part.variable]
    planar, *others = groups
    calls = [Raw("num", reference(*call)) for call in groups[planar]]
    calls += [
        Raw("error", f"call {i}: <b>IndexError</b>")
        for name in others
        for i, _ in enumerate(groups[name])
    ]
    text = one(course, exercise.slug, part.variable, Raw("calls", calls))
    said = [unescape(line) for line in re.findall(r"<li>([^<]*)</li>", text)]
    assert [line.partition(":")[0] for line in said[: len(groups)]] == list(groups)
    assert said[0] == f"{planar}: {len(groups[planar])} of {len(groups[planar])} right."
    for name, line in zip(others, said[1:], strict=False):
        assert line.startswith(
            f"{name}: 0 of {len(groups[name])} right; the first that is not gave: <b>"
        )
        assert "<b>IndexError</b>" in line
    assert "<table" not in text
    assert f"{part.points / len(groups):g} of {part.points:g} points" in text


def test_what_is_marked_by_hand_is_shown_with_the_rubric_and_later_with_the_comment(course):
    exercise, v = EXERCISES["implement_it"], variant_of("implement_it")
    part = part_of(exercise, "implement_it_steps")
    answer = "First <b>this</b>.\nThen that."
    verdicts = mark(exercise, v, raws({part.variable: answer}))
    waiting = block(feedback(course, exercise, verdicts), part.variable)
    assert unescape(re.findall(r"<blockquote>([^<]*)</blockquote>", waiting)[0]) == answer
    for points, text in part.answer.rubric:
        assert f"<li>{points:g}: {escape(text)}</li>" in waiting
    assert "It is marked by hand." in waiting
    assert f"– of {part.points:g} points" in waiting
    given = Mark("ada", "one", part.variable, 1.5, "Clear & short.", answer_id(answer))
    known = {one.variable: one for one in exercise.asked}
    done = with_marks(verdicts, "ada", {("ada", part.variable): given}, known)
    text = block(feedback(course, exercise, done), part.variable)
    assert "<li>Clear &amp; short.</li>" in text
    assert "It is marked by hand." not in text
    assert f"1.5 of {part.points:g} points" in text
    assert references(exercise, v)[part.variable][:40] not in unescape(waiting + text)


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
    said = NASTY.replace("\ud800", "\N{REPLACEMENT CHARACTER}")
    assert page.text.count(said) == 2 + 12 + 1 + 2  # name, cells, reading, findings


def test_what_is_private_stands_in_the_report_and_not_in_the_feedback(course, monkeypatch):
    exercise = EXERCISES["rrt"]
    verdicts = (
        Verdict(
            "rrt_dh", "incorrect", 0.0, 3, (Finding("like ben's", private=True), Finding("open"))
        ),
    )
    assert "like ben's" not in Page(feedback(course, exercise, verdicts)).text
    page = Page(report(course, [exercise], [Result(ADA, "one", verdicts)], monkeypatch))
    assert "For you only: like ben's" in page.text
    assert "rrt_dh: open" in page.text


def test_what_waits_is_said_and_is_no_zero(course):
    exercise = EXERCISES["rrt"]
    verdicts = [Verdict("rrt_dh", "correct", 3.0, 3), not_graded("rrt_T", 3, "Because.")]
    page = Page(feedback(course, exercise, verdicts))
    assert "3 + ? / 6 – part of this sheet waits for your instructor" in page.text
    assert "? not graded yet, – of 3 points" in page.text
    assert "Because." in page.text
    nothing_yet = Page(feedback(course, exercise, verdicts[1:]))
    assert "not graded – part of this sheet waits for your instructor" in nothing_yet.text


def test_the_report_counts_the_class_and_links_its_feedback(course, monkeypatch):
    exercise = EXERCISES["rrt"]
    results = [
        Result(
            ADA, "one", (Verdict("rrt_dh", "correct", 3.0, 3), Verdict("rrt_T", "missing", 0.0, 3))
        ),
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

    monkeypatch.setattr(
        "kinegrade.grader.figures.maps.picture", lambda arm, _: drawn.append(arm.name) or b"png"
    )
    monkeypatch.setattr("kinegrade.grader.figures.maps.describe", lambda arm: f"map of {arm.name}")
    figures = [pages._figure(tmp_path / "report", "planar_2r") for _ in range(2)]
    assert drawn == ["planar_2r"]
    assert figures[0] == figures[1]
    assert figures[0]["alt"] == "map of planar_2r"
    monkeypatch.setattr(pages, "version", lambda _: "99")
    pages._figure(tmp_path / "report", "planar_2r")
    assert len(drawn) == 2


def test_a_map_is_on_the_disk_before_it_takes_the_place_of_another(tmp_path, monkeypatch):
    done = []
    monkeypatch.setattr("kinegrade.grader.figures.maps.picture", lambda *_: b"png")
    monkeypatch.setattr("kinegrade.grader.figures.maps.describe", lambda _: "a map")
    sync, rename = os.fsync, os.replace
    monkeypatch.setattr(os, "fsync", lambda file: done.append("synced") or sync(file))
    monkeypatch.setattr(
        os, "replace", lambda *paths: done.append(paths[1].suffix) or rename(*paths)
    )
    pages._figure(tmp_path / "report", "planar_2r")
    assert done == ["synced", ".png", "synced", ".txt"]


def test_a_map_without_its_description_is_drawn_again(tmp_path, monkeypatch):
    monkeypatch.setattr(pages, "version", lambda _: "1")
    monkeypatch.setattr("kinegrade.grader.figures.maps.picture", lambda *_: b"whole")
    monkeypatch.setattr("kinegrade.grader.figures.maps.describe", lambda _: "a map")
    (tmp_path / "planar_2r-1.png").write_bytes(b"ha")
    pages._figure(tmp_path, "planar_2r")
    assert (tmp_path / "planar_2r-1.png").read_bytes() == b"whole"
