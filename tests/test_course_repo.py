"""The course repository of examples/ does in a fresh environment what its workflow and its README say."""

import os
import re
import shutil
from pathlib import Path

import pytest
from kinegrade.course.commands.new_course import PRIVATE
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import read_course
from wheels import build, fresh_environment, run

EXAMPLE = Path(__file__).parents[1] / "examples" / "course-repo"
WORKFLOW = EXAMPLE / ".github" / "workflows" / "exercises.yml"
RUN = re.compile(r"^ +- run: (.+)$", re.MULTILINE)


@pytest.fixture
def repo(tmp_path):
    return Path(
        shutil.copytree(
            EXAMPLE, tmp_path / "repo", ignore=shutil.ignore_patterns("__pycache__", ".*_cache")
        )
    )


@pytest.mark.slow
def test_the_workflow_proves_the_exercises_in_a_fresh_environment(repo, tmp_path):
    install, *commands = RUN.findall(WORKFLOW.read_text(encoding="utf-8"))
    assert install == "pip install kinegrade"
    assert commands == ["kinegrade validate --draws 100", "pytest"]
    path = fresh_environment(build(tmp_path), tmp_path / "environment")
    clean = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("PYTEST", "KINEGRADE"))
    }
    options = {"cwd": repo, "env": clean | {"PATH": f"{path}{os.pathsep}{clean['PATH']}"}}
    where = run(
        [path / "python", "-c", "import kinegrade.course as c; print(c.__file__)"], **options
    )
    assert where.startswith(str(tmp_path / "environment"))
    validated, tested = (run(["bash", "-ec", command], **options) for command in commands)
    rows = [line.split()[:4] for line in validated.splitlines() if "✓" in line]
    assert [(slug, draws) for slug, _, _, draws in rows] == [
        ("reach", "100"),
        ("cross_products", "100"),
    ]
    assert "✗" not in validated
    assert "1 passed" in tested
    assert "exercises/reach.py" in tested

    for command in ("kinegrade init .", "kinegrade generate"):
        assert command in (repo / "README.md").read_text(encoding="utf-8")
        run(["bash", "-ec", command], **options)
    assert (repo / "secret").stat().st_mode & 0o777 == 0o600
    assert len([*repo.glob("released/*/week*.ipynb")]) == 6


def test_the_repository_holds_nothing_that_is_private(repo):
    names = {str(path.relative_to(repo)) for path in repo.rglob("*") if path.is_file()}
    assert names == {
        ".github/workflows/exercises.yml",
        ".gitignore",
        "README.md",
        "course.toml",
        "exercises/arms.py",
        "exercises/reach.py",
        "roster.csv",
    }
    assert (repo / ".gitignore").read_text(encoding="utf-8").split() == [*PRIVATE]
    course = read_course(repo)
    assert course.settings.secret is None
    assert all(student.name == student.id for student in course.students)


def test_every_exercise_of_its_sheets_is_there(repo):
    course = read_course(repo)
    asked = {
        exercise.slug for sheet in course.settings.sheet for exercise in exercises_of(course, sheet)
    }
    assert asked == {"reach", "cross_products"}
