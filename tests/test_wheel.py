"""A wheel of the project, installed elsewhere, does what the checkout does."""

import configparser
import os
import re
import shutil
import subprocess
import sys
import zipfile

import pytest
from courses import LEVER
from wheels import ROOT, SOURCES, build, neighbours, run

WHERE = (
    "import kinegrade.course as c, kinegrade, pathlib; print(pathlib.Path(c.__file__).parents[2])"
)


COURSE = """
title = "Wheel"
[[sheet]]
name = "one"
title = "Sheet one"
matlab = true
exercises = ["rrt", "puma_velocities"]
"""


@pytest.mark.slow
def test_an_installed_wheel_holds_everything_and_marks_a_course(tmp_path):
    """Figures, pages, maps and notebooks come out of the wheel; the worked solution, handed in, earns full marks."""
    wheel = build(tmp_path)
    assert holds(wheel) == checked_out()
    assert "kinegrade/course/pages/templates/report.html" in holds(wheel)
    archive = zipfile.ZipFile(wheel)
    (entry,) = (name for name in archive.namelist() if name.endswith("entry_points.txt"))
    entries = configparser.ConfigParser()
    entries.read_string(archive.read(entry).decode())
    assert entries["console_scripts"]["kinegrade"] == "kinegrade.course.cli:main"
    assert entries["pytest11"]["kinegrade"] == "kinegrade.course.proof.pytest_plugin"
    assert any(name.endswith("licenses/LICENSE") for name in archive.namelist())

    options = {"cwd": tmp_path, "env": install(wheel, tmp_path / "installed")}
    assert run([sys.executable, "-S", "-c", WHERE], **options).strip() == str(
        tmp_path / "installed"
    )
    kinegrade("init", "mycourse", **options)
    course = tmp_path / "mycourse"
    (course / "course.toml").write_text(COURSE, encoding="utf-8")
    (course / "roster.csv").write_text("student,name\nada,Ada Lovelace\n", encoding="utf-8")
    kinegrade("generate", "--course", "mycourse", **options)
    assert "data:image/svg+xml" in (course / "released" / "ada" / "one.ipynb").read_text(
        encoding="utf-8"
    )
    assert (course / "released" / "ada" / "one.m").exists()
    (course / "submitted" / "ada").mkdir(parents=True)
    shutil.copy(
        course / "solutions" / "ada" / "one.ipynb", course / "submitted" / "ada" / "one.ipynb"
    )
    marked = kinegrade("grade", "--course", "mycourse", **options)
    assert re.search(r"ada +✓+ +✓+ +(\d+) / \1\b", marked)
    for name in ("grades.csv", "feedback/ada/one.html", "report/index.html"):
        assert (course / name).stat().st_size > 100
    maps = sorted(path.name.partition("-")[0] for path in (course / "report").glob("*.png"))
    assert maps == ["puma560", "rrt_offset"]
    validates_with_pytest(course, options)


def validates_with_pytest(course, options):
    """The plugin is found through its entry point, with nothing in the course but the exercise."""
    (course / "exercises").mkdir()
    (course / "exercises" / "lever.py").write_text(LEVER, encoding="utf-8")
    (course / "pytest.ini").write_text("[pytest]\nkinegrade_draws = 3\n", encoding="utf-8")
    command = [sys.executable, "-S", "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    ran = subprocess.run(
        command, cwd=course, env=options["env"], capture_output=True, text=True, check=False
    )
    assert "1 passed" in ran.stdout, ran.stdout + ran.stderr


def holds(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    return {name for name in names if not name.split("/")[0].endswith(".dist-info")}


def checked_out():
    return {
        f"kinegrade/{path.relative_to(ROOT).as_posix().removeprefix('kinegrade/')}"
        for package in SOURCES[3:]
        for path in (ROOT / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def install(wheel, folder):
    """An environment in which `kinegrade` comes from the wheel and all else from the running one.

    Under -S the checkout's editable installation is not looked at; its neighbours come back as plain folders.
    """
    run(
        [
            sys.executable,
            "-m",
            "pip",
            "install",
            "--quiet",
            "--no-deps",
            "--no-index",
            "--target",
            folder,
            wheel,
        ]
    )
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(folder), *neighbours()])}


def kinegrade(*arguments, **options):
    code = "import sys; from kinegrade.course.cli import main; sys.argv[0] = 'kinegrade'; main()"
    return run([sys.executable, "-S", "-c", code, *arguments], **options)
