"""The report: what to do next, the class and every sheet, with everything on it escaped."""

import pytest
from answers import EXERCISES
from courses import lever, make_course, sheet
from kinegrade.course.pages.report import write_report
from kinegrade.course.results.grades import SheetResults
from kinegrade.course.results.result import Result
from kinegrade.course.settings.config import Student, read_course
from kinegrade.grader.marking.verdict import Finding, Verdict, not_graded
from webpage import NASTY, Page

ADA, BEN, CYD = Student("ada", "Ada Lovelace"), Student("ben", NASTY), Student("cyd", "Cyd")


@pytest.fixture
def course(tmp_path, monkeypatch):
    monkeypatch.setattr(
        "kinegrade.course.pages.robot_maps._figure",
        lambda _, name: {"file": f"{name}.png", "title": name, "alt": f"map of {name}"},
    )
    return read_course(make_course(tmp_path))


def report(course, exercise, *results):
    marked = SheetResults(sheet(exercises=(exercise.slug,)), [exercise], results)
    path = write_report(course, [marked])
    assert path == course.folder / "report" / "index.html"
    return path.read_text(encoding="utf-8")


def dh(status, points, *findings):
    return Verdict("rrt_dh", status, points, 3, tuple(findings))


def test_what_is_private_stands_in_the_report(course):
    verdict = dh("incorrect", 0.0, Finding("like ben's", private=True), Finding("open"))
    page = Page(report(course, EXERCISES["rrt"], Result(ADA, "one", (verdict,))))
    assert "For you only" in page.text
    assert "ada: like ben's rrt_dh" in " ".join(page.text.split())
    assert "rrt_dh: open" in page.text


def test_the_first_screen_says_what_waits_who_is_missing_and_what_went_wrong(course):
    sign = Finding("Only a sign is wrong: row 1, column 2.")
    other = Finding("Only a sign is wrong: row 3, column 1.")
    results = [
        Result(ADA, "one", (dh("partly", 1.0, sign), not_graded("rrt_T", 3, "By hand."))),
        Result(BEN, "one", (dh("partly", 1.0, other),)),
        Result(CYD, "one", reason="no submission; one.txt is there"),
    ]
    page = Page(report(course, EXERCISES["rrt"], *results))
    first = " ".join(page.text.partition("Sheet one ·")[0].split())
    assert "1 × By hand. rrt_T · ada" in first
    assert "1 × Sheet one: no submission; one.txt is there cyd" in first
    assert "2 × Only a sign is wrong. rrt_dh · ada, ben" in first
    assert "rrt_dh: 33 % of the points" in first
    assert "Mode graded: 1 marked, 1 not graded, 1 without a submission." in page.text


def test_everything_is_escaped_and_the_only_script_is_ours(course):
    verdict = dh("partly", 1.0, Finding(NASTY))
    text = report(
        course, EXERCISES["rrt"], Result(BEN, "one", (verdict, not_graded("rrt_T", 3, NASTY)))
    )
    page = Page(text)
    assert page.tags.count("script") == 1
    assert "img" not in page.tags
    assert [name for name, _ in page.attributes if name.startswith("on")] == []
    assert page.text.count(NASTY.replace("\ud800", "\N{REPLACEMENT CHARACTER}")) >= 3


def test_a_browser_is_told_to_run_nothing_else(course):
    page = Page(report(course, EXERCISES["rrt"]))
    (policy,) = [value for _, value in page.attributes if value and "default-src" in value]
    assert "default-src 'none'" in policy
    assert "script-src 'sha256-" in policy


def test_files_that_are_there_are_linked(course):
    places = (
        "released/ada/one.ipynb",
        "submitted/ada/one.json",
        "feedback/ada/one.html",
        "solutions/ada/one.ipynb",
    )
    results = [Result(ADA, "one", (dh("correct", 3.0),)), Result(BEN, "one", (dh("correct", 3.0),))]
    for place in places:
        path = course.folder / place
        path.parent.mkdir(parents=True)
        path.touch()
    page = Page(report(course, EXERCISES["rrt"], *results))
    links = [value for name, value in page.attributes if name == "href"]
    assert [link for link in links if "/ada/" in link] == [f"../{place}" for place in places]
    assert [link for link in links if "/ben/" in link] == []


def test_maps_stand_on_a_page_of_their_own(course):
    page = Page(report(course, EXERCISES["rrt"]))
    assert "img" not in page.tags
    assert "robots.html" in [value for name, value in page.attributes if name == "href"]
    maps = Page((course.folder / "report" / "robots.html").read_text(encoding="utf-8"))
    robot = EXERCISES["rrt"].robot
    assert ("src", f"{robot}.png") in maps.attributes
    assert ("alt", f"map of {robot}") in maps.attributes


def test_a_course_without_robots_or_marks_has_a_report(course, tmp_path):
    page = Page(report(course, lever(tmp_path), Result(ADA, "one", reason="nothing marked yet")))
    assert "Nobody has a total yet." in page.text
    assert "robots.html" not in str(page.attributes)
