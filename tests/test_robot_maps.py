"""Maps of robots: drawn once for a machine, whole on the disk, anew when what draws them changed."""

import os

import pytest
from kinegrade.course.machine.kept import cache_folder
from kinegrade.course.pages import robot_maps
from kinegrade.course.pages.robot_maps import LOST, write_maps
from kinegrade.solutions.robots import ROBOTS
from webpage import Page

PLANAR = ["planar_2r"]


@pytest.fixture
def drawn(monkeypatch, tmp_path):
    """Names of the robots that were drawn; what is kept for this machine is empty."""
    names = []
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(
        "kinegrade.grader.figures.maps.picture", lambda arm, _: names.append(arm.name) or b"png"
    )
    monkeypatch.setattr("kinegrade.grader.figures.maps.describe", lambda arm: f"map of {arm.name}")
    return names


def pngs(folder):
    return sorted(path.name for path in folder.glob("*.png"))


def test_a_map_is_drawn_once_for_all_courses_of_a_machine(tmp_path, drawn):
    for course in ("one", "one", "two"):
        assert write_maps(tmp_path / course, "Tests", PLANAR) == "robots.html"
    assert drawn == PLANAR
    assert pngs(tmp_path / "one") == pngs(tmp_path / "two") == pngs(cache_folder() / "maps")


def test_the_page_shows_and_describes_every_robot(tmp_path, drawn):
    write_maps(tmp_path, "A & B", ["puma560", *PLANAR])
    page = Page((tmp_path / "robots.html").read_text(encoding="utf-8"))
    assert page.tags.count("img") == 2
    assert ("alt", "map of puma560") in page.attributes
    assert "A & B" in page.text
    assert drawn == ["planar_2r", "puma560"]


def test_a_course_without_robots_has_no_page(tmp_path, drawn):
    assert write_maps(tmp_path, "Tests", []) == ""
    assert drawn == []
    assert list(tmp_path.iterdir()) == []


def test_a_map_is_drawn_anew_and_the_old_one_dropped_when_what_draws_it_changed(
    tmp_path, drawn, monkeypatch
):
    write_maps(tmp_path, "Tests", PLANAR)
    (before,) = pngs(tmp_path)
    monkeypatch.setattr(robot_maps, "_drawing_code", lambda: "another")
    write_maps(tmp_path, "Tests", PLANAR)
    assert len(drawn) == 2
    assert pngs(tmp_path) != [before]
    assert len(pngs(tmp_path)) == 1


def test_two_robots_never_share_a_map():
    keys = {name: robot_maps._key(robot) for name, robot in ROBOTS.items()}
    assert len(set(keys.values())) == len(ROBOTS)
    for name, robot in ROBOTS.items():
        robot.symbolic()  # what a robot keeps of itself changes no key
        assert robot_maps._key(robot) == keys[name]


def test_a_map_without_its_description_is_taken_again(tmp_path, drawn):
    write_maps(tmp_path, "Tests", PLANAR)
    for path in tmp_path.glob("*.txt"):
        path.unlink()
    write_maps(tmp_path, "Tests", PLANAR)
    assert [path.read_text() for path in tmp_path.glob("*.txt")] == ["map of planar_2r"]


def test_a_machine_that_keeps_nothing_still_gets_its_maps(tmp_path, drawn, monkeypatch):
    blocked = tmp_path / "file"
    blocked.touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(blocked))
    write_maps(tmp_path / "report", "Tests", PLANAR)
    assert len(pngs(tmp_path / "report")) == 1
    assert drawn == PLANAR


def test_a_map_is_on_the_disk_before_it_takes_the_place_of_another(tmp_path, drawn, monkeypatch):
    done = []
    write_maps(tmp_path / "first", "Tests", PLANAR)
    sync, rename = os.fsync, os.replace
    monkeypatch.setattr(os, "fsync", lambda file: done.append("synced") or sync(file))
    monkeypatch.setattr(
        os, "replace", lambda *paths: done.append(paths[1].suffix) or rename(*paths)
    )
    write_maps(tmp_path / "second", "Tests", PLANAR)
    assert done == ["synced", ".png", "synced", ".txt", "synced", ".html"]


def test_a_map_that_fails_costs_neither_the_others_nor_the_report(
    tmp_path, drawn, monkeypatch, caplog
):
    def picture(arm, _):
        return b"png" if arm.name == "puma560" else 1 / 0

    monkeypatch.setattr("kinegrade.grader.figures.maps.picture", picture)
    assert write_maps(tmp_path, "Tests", ["puma560", *PLANAR]) == "robots.html"
    assert [name.partition("-")[0] for name in pngs(tmp_path)] == ["puma560"]
    page = (tmp_path / "robots.html").read_text(encoding="utf-8")
    assert page.count("<img") == 1
    assert page.count(LOST) == 1
    assert "the map of planar_2r is left out" in caplog.text
