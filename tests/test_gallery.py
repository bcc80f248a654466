"""The gallery: a chapter for every robot, every picture there and described, no sentence twice."""

import re

import pytest
from kinegrade.course.commands.gallery import WIDTHS, main, write_gallery
from kinegrade.grader.figures.robot_figure import KINDS
from kinegrade.solutions.robots import ROBOTS
from markdown_it import MarkdownIt

TWO = [ROBOTS["planar_2r"], ROBOTS["rrt_offset"]]


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    steps = []
    path = write_gallery(tmp_path_factory.mktemp("docs") / "gallery", TWO, lambda: steps.append(1))
    assert len(steps) == 2
    return path


def test_every_kind_of_every_robot_is_shown(page):
    html = MarkdownIt().render(page.read_text(encoding="utf-8"))
    sources = re.findall(r'<img src="([^"]+)" alt="[^"]{20,}"', html)
    assert len(sources) == len(set(sources)) == 2 * (len(KINDS) + 1)
    assert all((page.parent / source).read_bytes().startswith(b"\x89PNG") for source in sources)
    assert html.count("<h2>") == 2


def test_nothing_is_told_twice(page):
    html = MarkdownIt().render(page.read_text(encoding="utf-8"))
    said = [text for text in re.findall(r"<p>([^<]+)</p>", html) if " = " in text]
    assert len(said) == 4
    assert len(set(said)) == 4
    assert not any(one in other for one in said for other in said if one is not other)


def test_all_kinds_are_in_it():
    assert set(WIDTHS) == {"", *KINDS}


def test_a_run_without_a_folder_is_wrong_usage(monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["gallery"])
    with pytest.raises(SystemExit) as stopped:
        main()
    assert stopped.value.code == 2
    assert "takes one folder" in capsys.readouterr().err
