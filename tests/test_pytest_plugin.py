"""Plain pytest validates every file of an exercises/ folder that defines an exercise, and none of the package's own."""

import subprocess
import sys
from pathlib import Path

import pytest
from courses import LEVER

ROOT = Path(__file__).parents[1]
BROKEN = LEVER.replace("return np.array([-y, x])", "return np.array([0.0, 0.0])")


@pytest.fixture
def folder(tmp_path):
    """A folder with one exercise, a module beside it, and no course.toml."""
    (tmp_path / "exercises").mkdir()
    (tmp_path / "exercises" / "lever.py").write_text(LEVER, encoding="utf-8")
    (tmp_path / "exercises" / "notes.py").write_text(
        "raise RuntimeError('no exercise is here')\n", encoding="utf-8"
    )
    return tmp_path


def run(folder, *arguments):
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-p",
        "no:cacheprovider",
        "-p",
        "no:xdist",
        *map(str, arguments),
    ]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_an_exercises_folder_needs_no_course_and_no_set_up(folder):
    good = run(folder, "--kinegrade-draws", 3)
    assert (good.returncode, "1 passed" in good.stdout) == (0, True), good.stdout
    (folder / "exercises" / "lever.py").write_text(BROKEN, encoding="utf-8")
    bad = run(folder, "--kinegrade-draws", 3)
    assert bad.returncode == 1
    assert "nonsense, lever_J, in 3 of 3 draws, first 0: zeros earns 3.0 of 3" in bad.stdout
    assert "Traceback" not in bad.stdout


@pytest.mark.parametrize(
    ("ini", "arguments", "draws"),
    [
        ("", (), 20),
        ("kinegrade_draws = 3", (), 3),
        ("kinegrade_seeds = 4", (), 4),
        ("kinegrade_seeds = 4\nkinegrade_draws = 3", (), 3),
        ("kinegrade_draws = 3", ("--kinegrade-draws", "2"), 2),
    ],
)
def test_draws_are_those_of_the_option_or_the_ini_file_or_20(folder, ini, arguments, draws):
    (folder / "pytest.ini").write_text(f"[pytest]\n{ini}\n", encoding="utf-8")
    (folder / "exercises" / "lever.py").write_text(BROKEN, encoding="utf-8")
    assert f"in {draws} of {draws} draws" in run(folder, *arguments).stdout


@pytest.mark.parametrize("given", ["many", "0", "-3", "2.5", "²"])
def test_a_number_of_draws_that_is_none_is_one_sentence(folder, given):
    by_option = run(folder, f"--kinegrade-draws={given}")
    (folder / "pytest.ini").write_text(f"[pytest]\nkinegrade_draws = {given}\n", encoding="utf-8")
    by_ini = run(folder)
    for ran, name in ((by_option, "--kinegrade-draws"), (by_ini, "kinegrade_draws")):
        assert ran.returncode == 4
        assert f"ERROR: {name} takes a positive whole number, got {given!r}" in ran.stderr
        assert "Traceback" not in ran.stderr


@pytest.mark.parametrize("path", ["exercises", "exercises/rrt.py", "typings/kinegrade/exercises"])
def test_the_exercises_of_the_package_are_not_collected(path):
    ran = run(ROOT, path, "--collect-only", "-q")
    assert "no tests collected" in ran.stdout, ran.stdout + ran.stderr
    assert "is_valid" not in ran.stdout


def test_a_file_that_cannot_be_loaded_fails_with_its_line(folder):
    (folder / "exercises" / "lever.py").write_text("\nEXERCISE = 1 / 0\n", encoding="utf-8")
    ran = run(folder)
    assert ran.returncode == 1
    assert "stopped with ZeroDivisionError: division by zero (line 2 of lever.py)" in ran.stdout
    assert "Traceback" not in ran.stdout
