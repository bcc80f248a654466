"""A wheel of the project, installed elsewhere, does what the checkout does."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
SOURCES = ("pyproject.toml", "LICENSE", "README.md", "course", "exercises", "grader", "solutions")
WHERE = "import kinegrade.course as c, kinegrade, pathlib; print(pathlib.Path(c.__file__).parents[2])"


def test_an_installed_wheel_holds_everything_and_runs_the_demo(tmp_path):
    wheel = build(tmp_path)
    assert holds(wheel) == checked_out()
    assert "kinegrade/course/templates/report.html" in holds(wheel)
    archive = zipfile.ZipFile(wheel)
    (entry,) = (name for name in archive.namelist() if name.endswith("entry_points.txt"))
    assert "kinegrade = kinegrade.course.cli:main" in archive.read(entry).decode()
    assert any(name.endswith("licenses/LICENSE") for name in archive.namelist())

    options = {"cwd": tmp_path, "env": install(wheel, tmp_path / "installed")}
    assert run([sys.executable, "-S", "-c", WHERE], **options).strip() == str(tmp_path / "installed")
    assert re.search(r"student01 +✓+ +✓+ +✓+ +(\d+) / \1\b", kinegrade("demo", "course", **options))
    for name in ("grades.csv", "feedback/student03/jacobian.html", "report/index.html"):
        assert (tmp_path / "course" / name).exists()


def build(folder):
    """Built from a copy, so that the checkout is left clean and nothing of an earlier build gets in."""
    source = folder / "source"
    source.mkdir()
    for name in SOURCES:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, source / name)
    run([sys.executable, "-m", "build", "--wheel", "--outdir", folder / "wheel", source], cwd=source)
    (wheel,) = (folder / "wheel").iterdir()
    return wheel


def holds(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    return {name for name in names if not name.split("/")[0].endswith(".dist-info")}


def checked_out():
    return {
        f"kinegrade/{path.relative_to(ROOT).as_posix()}"
        for package in SOURCES[3:]
        for path in (ROOT / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def install(wheel, folder):
    """An environment in which `kinegrade` comes from the wheel and all else from the running one.

    Under -S the checkout's editable installation is not looked at; its neighbours come back as plain folders.
    """
    run([sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", folder, wheel])
    neighbours = [entry for entry in sys.path if entry.endswith("-packages")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(folder), *neighbours])}


def kinegrade(*arguments, **options):
    code = "import sys; from kinegrade.course.cli import main; sys.argv[0] = 'kinegrade'; main()"
    return run([sys.executable, "-S", "-c", code, *arguments], **options)


def run(command, **options):
    ran = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout
