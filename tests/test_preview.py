"""What an instructor starts from: a new exercise that runs, and one page that shows all of an exercise."""

import re
from pathlib import Path

import pytest
from answers import EXERCISES, SLUGS
from kinegrade.course.proof.preview import preview_page
from kinegrade.course.proof.validate import validate_file
from kinegrade.course.text.markdown import markdown_html
from kinegrade.exercises.exercise import Manual
from kinegrade.exercises.files.finding import exercise_files


def test_a_new_exercise_is_valid_as_it_stands(kinegrade, tmp_path):
    ran = kinegrade("new", "tip_speed", "--course", tmp_path)
    assert ran.code == 0
    path = Path(ran.out.strip())
    assert path == tmp_path / "exercises" / "tip_speed.py"
    assert "kinegrade preview tip_speed" in ran.err
    assert validate_file(path, 5).failures == ()
    assert len(path.read_text(encoding="utf-8").splitlines()) <= 30


def test_new_never_overwrites_and_keeps_names_apart(kinegrade, tmp_path):
    kinegrade("new", "tip_speed", "--course", tmp_path)
    again = kinegrade("new", "tip_speed", "--course", tmp_path)
    ours = kinegrade("new", "rrt", "--course", tmp_path)
    bad = kinegrade("new", "../x", "--course", tmp_path)
    assert (again.code, ours.code, bad.code) == (1, 1, 1)
    assert "never overwrites" in again.err
    assert "comes with the package" in ours.err
    assert "takes a name of small letters" in bad.err
    assert not (tmp_path / "exercises" / "rrt.py").exists()


@pytest.mark.parametrize("command", [("new", "tip_speed"), ("preview", "rrt"), ("grade",)])
def test_what_is_no_folder_is_refused_and_not_made(kinegrade, tmp_path, command):
    file = tmp_path / "course.toml"
    file.touch()
    for place in (tmp_path / "nowhere", file):
        ran = kinegrade(*command, "--course", place)
        assert ran.code == 1
        assert f"{place} is no folder; --course takes the one with the course.toml" in ran.err
    assert [*tmp_path.iterdir()] == [file]


@pytest.mark.parametrize("slug", SLUGS)
def test_a_preview_shows_sheet_solution_and_every_known_mistake(slug):
    exercise = EXERCISES[slug]
    html = preview_page(exercise, 1)
    assert f"after {exercise.source}. It holds answers" in html
    assert html.count("<summary>Worked solution</summary>") == len(exercise.asked)
    assert not re.search(
        r"\$|@[a-z]+@|<[a-z_]+_[a-z]+>", re.sub(r"<pre[^>]*>.*?</pre>", "", html, flags=re.DOTALL)
    )
    for part in exercise.asked:
        assert f"<code>{part.variable}</code>" in html
    shown = html.count('<section class="part incorrect">') + html.count(
        '<section class="part partly">'
    )
    shown += html.count('<section class="part failed">') + html.count(
        '<section class="part correct">'
    )
    assert shown == sum(
        len(part.mistakes) for part in exercise.asked if not isinstance(part.answer, Manual)
    )
    assert '<section class="part correct">' not in html
    assert "://" not in re.sub(r"http://www.w3.org/\S+", "", html)


def test_a_new_exercise_is_previewed_where_it_was_written(kinegrade, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    kinegrade("new", "tip_speed")
    ran = kinegrade("preview", "tip_speed", "--seed", 2)
    assert (ran.code, ran.out.strip()) == (0, "tip_speed-preview.html")
    assert "tip_speed_xi" in (tmp_path / "tip_speed-preview.html").read_text(encoding="utf-8")
    assert kinegrade("preview", "statics", "--course", tmp_path).code == 0


def test_the_command_writes_the_page_of_that_draw(kinegrade, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = tmp_path / "page.html"
    ran = kinegrade("preview", "three_axis", "--seed", 3, "--output", page)
    assert (ran.code, ran.out.strip()) == (0, str(page))
    assert page.read_text(encoding="utf-8") == preview_page(EXERCISES["three_axis"], 3)
    other = kinegrade("preview", exercise_files()["three_axis"], "--output", page)
    assert other.code == 0
    assert page.read_text(encoding="utf-8") == preview_page(EXERCISES["three_axis"], 0)
    unknown = kinegrade("preview", "three_axes", "--output", tmp_path / "none.html")
    assert unknown.code == 1
    assert "did you mean 'three_axis'?" in unknown.err
    assert not (tmp_path / "none.html").exists()


def test_markdown_keeps_formulas_tables_and_code_apart():
    html = markdown_html("| $a_1$ | `x$y` |\n|:-:|:-:|\n| $$\\frac{1}{2}$$ | b |")
    assert html.count("<math") == 2
    assert 'display="block"' in html
    assert "<code>x$y</code>" in html
    assert "<table>" in html
