"""Pages in a real browser: axe-core finds nothing serious, a phone shows all of them, and the report sorts and finds."""

import json
import re
from html import unescape

import pytest
from answers import EXERCISES, raws_of, variant_of, wrong
from browser import browser, dom, looked_at
from courses import make_course, sheet
from kinegrade.course.pages.feedback import write_feedback
from kinegrade.course.pages.report import write_report
from kinegrade.course.proof.preview import preview_page
from kinegrade.course.results.grades import SheetResults
from kinegrade.course.results.result import Result
from kinegrade.course.settings.config import Student, read_course
from kinegrade.course.variants.variant import Record, fingerprint
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.verdict import Finding, Verdict, not_graded

SLUGS = ("three_axis", "rrt", "puma_velocities", "implement_it")
WIDTHS = (1280, 390)
DARK = ("--blink-settings=preferredColorScheme=0",)
HARMLESS = ("minor", "moderate")
SEARCHED = """
const table = document.querySelector("#students ~ div table");
const first = () => [...table.tBodies[0].rows].map((row) => row.cells[0].textContent.trim().split(" ")[0]);
const press = (i) => table.tHead.rows[0].cells[i].querySelector("button").click();
const told = { before: first() };
press(1); told.rising = first(); told.sort = table.tHead.rows[0].cells[1].getAttribute("aria-sort");
press(1); told.falling = first();
const search = document.querySelector("input.search");
told.seen = search.checkVisibility();
search.value = "BEN"; search.dispatchEvent(new Event("input"));
told.found = [...table.tBodies[0].rows].filter((row) => row.checkVisibility()).map((row) => row.cells[0].textContent.trim());
document.body.innerHTML = "";
document.body.append(Object.assign(document.createElement("pre"), { id: "told", textContent: JSON.stringify(told) }));
"""


def feedback(course, slug, *, solved):
    """The page of somebody with everything wrong."""
    exercise, v = EXERCISES[slug], variant_of(slug)
    answers = references(exercise, v)
    own = {part.variable: wrong(part, answers[part.variable], v) for part in exercise.asked}
    verdicts = mark(exercise, v, raws_of(exercise, v, own))
    record = Record("ada", "one", slug, 0, v, fingerprint(exercise, v))
    one = sheet(exercises=(slug,)).model_copy(update={"show_solutions": solved})
    result = Result(Student("ada", "Ada Lovelace"), "one", tuple(verdicts))
    path = write_feedback(course, one, [exercise], result, {slug: record})
    return path.read_text(encoding="utf-8")


def report(course, monkeypatch):
    monkeypatch.setattr(
        "kinegrade.course.pages.robot_maps._figure",
        lambda _, name: {"file": f"{name}.png", "title": name, "alt": "a map"},
    )
    sign = Finding("Only a sign is wrong: row 1, column 2.")
    results = [
        Result(Student("ada", "Ada"), "one", (Verdict("rrt_dh", "partly", points, 3, (sign,)),))
        for points in (2.5, 10.0)
    ]
    results[1] = Result(Student("ben", "Ben"), "one", results[1].verdicts)
    waits = not_graded("rrt_T", 3, "By hand.")
    results.append(Result(Student("cyd", "Cyd"), "one", (waits,)))
    results.append(Result(Student("dan", "Dan"), "one", reason="no submission"))
    marked = SheetResults(sheet(exercises=("rrt",)), [EXERCISES["rrt"]], results)
    return write_report(course, [marked])


@pytest.mark.slow
@pytest.mark.parametrize("options", [(), DARK], ids=["light", "dark"])
def test_axe_finds_nothing_serious_on_any_page_on_a_desk_and_on_a_phone(
    tmp_path, monkeypatch, options
):
    course = read_course(make_course(tmp_path))
    pages = {slug: feedback(course, slug, solved=slug == "rrt") for slug in SLUGS}
    index = report(course, monkeypatch)
    pages["report"] = index.read_text(encoding="utf-8")
    pages["robots"] = index.with_name("robots.html").read_text(encoding="utf-8")
    pages["preview"] = preview_page(EXERCISES["statics"], 1)

    found = looked_at(tmp_path, pages, WIDTHS, *options)
    assert len(found) == len(pages) * len(WIDTHS)
    for name, seen in found.items():
        assert [one for one in seen["violations"] if one[0] not in HARMLESS] == [], name
        assert seen["wide"] == [], name


def test_the_report_sorts_by_any_column_and_finds_students(tmp_path, monkeypatch):
    command = browser()
    index = report(read_course(make_course(tmp_path)), monkeypatch)
    text = index.read_text(encoding="utf-8").replace("Content-Security-Policy", "X-Policy")
    page = tmp_path / "page.html"
    page.write_text(text.replace("</body>", f"<script>{SEARCHED}</script></body>"))
    (told,) = re.findall('<pre id="told">(.*?)</pre>', dom(command, tmp_path, page), re.DOTALL)
    said = json.loads(unescape(told))
    assert [name[:3] for name in said["before"]] == ["ada", "ben", "cyd", "dan"]
    assert [name[:3] for name in said["rising"]] == ["cyd", "dan", "ada", "ben"]
    assert [name[:3] for name in said["falling"]] == ["ben", "ada", "cyd", "dan"]
    assert said["sort"] == "ascending"
    assert said["seen"]
    assert [name[:3] for name in said["found"]] == ["ben"]


def test_the_policy_of_the_report_lets_its_own_script_run_and_no_other(tmp_path, monkeypatch):
    command = browser()
    index = report(read_course(make_course(tmp_path)), monkeypatch)
    text = index.read_text(encoding="utf-8")
    index.write_text(
        text.replace("</main>", "<script>document.title = 'another ran'</script></main>")
    )
    shown = dom(command, tmp_path, index)
    assert "another ran</title>" not in shown
    assert '<button type="button">student</button>' in shown
