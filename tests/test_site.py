"""The documentation site: built without a warning, complete, and in need of no other place."""

import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from importlib.util import find_spec
from pathlib import Path

import pytest
from answers import EXERCISES, SLUGS, variant_of
from browser import browser, dom
from kinegrade.course.settings.toml_tables import Settings

ROOT = Path(__file__).parents[1]
NO_MKDOCS = "MkDocs is not installed (make docs): the site was not built"
ELSEWHERE = re.compile(r"^(https?:)?//")
HANDWRITTEN = [path.stem for path in sorted((ROOT / "docs").glob("*.md"))]


class Page(HTMLParser):
    """What a page brings along, and its text."""

    def __init__(self, text):
        super().__init__()
        self.brought, self.text = [], ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        if tag in ("script", "img", "iframe", "source"):
            self.brought.append(given.get("src") or "")
        elif tag == "link" and given.get("rel") != "canonical":
            self.brought.append(given.get("href") or "")

    def handle_data(self, data):
        self.text += data


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The site, built as `make docs` builds it."""
    if find_spec("mkdocs") is None or find_spec("mkdocstrings") is None:
        pytest.skip(NO_MKDOCS)
    folder = tmp_path_factory.mktemp("site")
    ran = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", folder],
        cwd=ROOT,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (ran.returncode, ran.stderr) == (0, "")
    return folder


def page_of(site, name):
    return Page((site / f"{name}.html").read_text(encoding="utf-8"))


def test_every_page_is_in_the_navigation(site):
    home = (site / "index.html").read_text(encoding="utf-8")
    linked = set(re.findall(r'href="([\w/.]+)\.html"', home))
    exercises = {f"exercises/{slug}" for slug in SLUGS}
    assert {*HANDWRITTEN, *exercises, "api/index", "api/exercises.part"} - {"index"} <= linked


def test_nothing_comes_from_elsewhere(site):
    found = []
    for path in sorted(site.rglob("*.html")):
        brought = Page(path.read_text(encoding="utf-8")).brought
        found += [f"{path.name}: {one}" for one in brought if ELSEWHERE.match(one)]
    for path in sorted(site.rglob("*.css")):
        text = path.read_text(encoding="utf-8")
        found += re.findall(r"url\([\"']?(?:https?:)?//[^)]+", text)
    assert found == []


@pytest.mark.parametrize("slug", SLUGS)
def test_an_exercise_has_a_page_with_pictures_parts_and_known_mistakes(site, slug):
    exercise = EXERCISES[slug]
    page = page_of(site, f"exercises/{slug}")
    for part in exercise.asked:
        assert part.variable in page.text
        for mistake in part.mistakes:
            first_words = re.split(r"[$`]", mistake.sentence)[0].strip()
            assert first_words in " ".join(page.text.split())
    pictures = [one for one in page.brought if one.startswith(f"{slug}-")]
    assert all((site / "exercises" / picture).stat().st_size > 1000 for picture in pictures)
    assert (f"{slug}-map.png" in pictures) == (exercise.robot is not None)
    assert f"{slug}-1.svg" in pictures or not exercise.drawings(variant_of(slug))


def keys_of(model):
    """Keys of a settings table and of all tables in it."""
    schema = model.model_json_schema()
    tables = [schema, *schema["$defs"].values()]
    return {name for table in tables for name in table["properties"]}


def test_every_key_of_course_toml_is_in_the_table_with_words(site):
    html = (site / "settings.html").read_text(encoding="utf-8")
    rows = re.findall(r"<tr>(.*?)</tr>", html, re.DOTALL)
    cells = [re.findall(r"<td[^>]*>(.*?)</td>", row, re.DOTALL) for row in rows]
    named = {re.sub("<[^>]+>", "", row[0]).strip("[]").split(".")[-1]: row for row in cells if row}
    missing = keys_of(Settings) - set(named) - {"secret", "exercise", "NAME"}
    assert missing == set()
    assert [row for row in cells if row and not row[-1]] == []


def test_formulas_are_set_without_scripts(site):
    home = (site / "index.html").read_text(encoding="utf-8")
    assert '<math xmlns="http://www.w3.org/1998/Math/MathML" display="block">' in home
    assert "\\begin{bmatrix}" not in home
    assert not any("\ue000" in path.read_text(encoding="utf-8") for path in site.rglob("*.html"))


def test_links_to_the_repository_lead_to_pages_that_show_it(site):
    assert "source/exercises/part.py.html" in (site / "add_an_exercise.html").read_text()
    assert "The contract of an exercise file" in page_of(site, "source/exercises/part.py").text
    assert "jacobian.py" in page_of(site, "source/solutions").text


def test_the_api_says_what_docstrings_say(site):
    text = page_of(site, "api/solutions.jacobian").text
    assert "The geometric Jacobian of a chain." in text
    assert "linear rows above angular" in text


LOOK = """
<!doctype html><meta charset="utf-8"><body><script>
window.addEventListener("load", () => setTimeout(() => {
  const told = [...document.querySelectorAll("iframe")].map((frame) => {
    const root = frame.contentDocument.documentElement;
    const broken = [...frame.contentDocument.images].filter((one) => one.complete && !one.naturalWidth);
    return frame.name + ": " + Math.max(0, root.scrollWidth - frame.clientWidth) + " " + broken.length;
  });
  document.body.innerHTML = "<pre>" + told.join("\\n") + "</pre>";
}, 3000));
</script>
"""


def test_pages_fit_a_phone_and_a_screen_and_show_their_pictures(site, tmp_path):
    command = browser()
    names = ["index", "term", "settings", "exercises/rrt", "exercises/puma_velocities", "hostile"]
    frames = [
        f'<iframe name="{name} {width}" width="{width}" height="800" src="{name}.html"></iframe>'
        for name in names
        for width in (390, 1280)
    ]
    harness = site / "look.html"
    harness.write_text(LOOK + "".join(frames), encoding="utf-8")
    told = dom(command, tmp_path, harness, "--allow-file-access-from-files")
    (found,) = re.findall(r"<body><pre>(.*?)</pre>", told, re.DOTALL)
    lines = found.splitlines()
    assert sorted(lines) == sorted(
        f"{name} {width}: 0 0" for name in names for width in (390, 1280)
    )
