"""Building a wheel of the project, and running what is installed from it, for the tests that do so."""

import shutil
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).parents[1]
SOURCES = (
    "pyproject.toml",
    "LICENSE",
    "README.md",
    "course",
    "exercises",
    "grader",
    "solutions",
    "kinegrade",
)
PYTEST = """#!{python}
import sys

from pytest import console_main

if __name__ == "__main__":
    sys.exit(console_main())
"""


def build(folder):
    """Built from a copy, so that the checkout is left clean and nothing of an earlier build gets in."""
    source = folder / "source"
    source.mkdir()
    for name in SOURCES:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, source / name)
    run(
        [sys.executable, "-m", "build", "--wheel", "--outdir", folder / "wheel", source], cwd=source
    )
    (wheel,) = (folder / "wheel").iterdir()
    return wheel


def neighbours():
    """Folders of the running environment in which the dependencies lie."""
    return [entry for entry in sys.path if entry.endswith("-packages")]


def fresh_environment(wheel, folder):
    """The commands of a new virtual environment with the wheel in it; returns the folder they lie in.

    Dependencies are those of the running environment, as plain folders: its editable checkout is not among them.
    """
    venv.create(folder, symlinks=True)
    (packages,) = folder.glob("lib/python*/site-packages")
    (packages / "neighbours.pth").write_text("\n".join(neighbours()) + "\n", encoding="utf-8")
    python = folder / "bin" / "python"
    run(
        [
            sys.executable,
            "-m",
            "pip",
            "--python",
            python,
            "install",
            "--quiet",
            "--no-deps",
            "--no-index",
            wheel,
        ]
    )
    command = python.with_name("pytest")  # as pip would have written it
    command.write_text(PYTEST.format(python=python), encoding="utf-8")
    command.chmod(0o755)
    return python.parent


def run(command, **options):
    ran = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, check=False, **options
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return ran.stdout
