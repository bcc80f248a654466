# pyright: basic
"""Markers of notebooks, each with a class that hands in the same five matrices.

Started by marking.py.
"""

import csv
import json
import os
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from kinegrade.course.commands.demo import fill_in
from kinegrade.course.commands.habits import HABITS
from kinegrade.course.handing_out.generate import generate
from kinegrade.course.ledger.gradebook import gradebook_of
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import read_course
from kinegrade.exercises.exercise import Exercise, references

EXERCISE = Path(__file__).with_name("five_matrices.py")
SLUG = EXERCISE.stem
ANSWERS = ("R", "T", "J", "G", "W")
CODE = {
    "R": "a, b = {q}\nc, s = np.cos(a + b), np.sin(a + b)\n"
    "{R} = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])",
    "T": "x, y = {l1} * np.cos(a) + {l2} * c, {l1} * np.sin(a) + {l2} * s\n"
    "{T} = np.eye(4)\n{T}[:3, :3], {T}[:2, 3] = {R}, (x, y)",
    "J": "{J} = np.zeros((6, 2))\n{J}[:2] = [[{sign}y, {sign}{l2} * s], [x, {l2} * c]]\n{J}[5] = 1",
    "G": "{G} = {J}[:3].T @ {J}[:3]",
    "W": "{W} = {J}[:3] @ {J}[:3].T",
}
"""What a student types, by the matrix; every second one forgets the minus in J."""
PEERS_NUMBERS = {"l1": 0.4, "l2": 0.3, "q": [0.5, 0.8]}  # theirs are the same for everybody
THREE = ("three_axis", "rrt", "puma_velocities")
USUAL = ("right", "rounded to 3 decimals", "one sign wrong", "rows swapped", "transposed", "empty")
KERNEL = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
API = """
import json, sys
from pathlib import Path
from otter.api import grade_submission
zipped, *notebooks = sys.argv[1:]
for notebook in notebooks:
    results = grade_submission(notebook, zipped, quiet=True)
    Path(notebook).with_suffix(".json").write_text(json.dumps({"score": results.total}))
"""
ONE_CORE = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
Cells = Callable[[Exercise, dict[str, Any], int], dict[str, str]]
"""From an exercise, the drawn numbers and the number of a student to code by the variable."""


@dataclass(frozen=True)
class Marker:
    """One way to mark a class.

    Attributes:
        name: As the table has it.
        sizes: A small class and a larger one, between which the slope is taken.
        prepare: Makes a class of some size in a folder; returns the commands that mark it.
        full: How many students of the folder have full marks afterwards.
    """

    name: str
    sizes: tuple[int, int]
    prepare: Callable[[Path, int], list[list[str]]]
    full: Callable[[Path], int] | None = None


def environment(bin_: Path) -> dict[str, str]:
    """Ours with the programs of an environment first, and one thread for linear algebra."""
    return {**os.environ, **ONE_CORE, "PATH": f"{bin_}{os.pathsep}{os.environ['PATH']}"}


def five_matrices(_: Any, v: dict[str, Any], student: int) -> dict[str, str]:
    """The cells of a student who works with these numbers."""
    names = {answer: f"{SLUG}_{answer}" for answer in ANSWERS}
    sign = "-" if is_right(student) else ""
    return {names[answer]: CODE[answer].format(**names, **v, sign=sign) for answer in ANSWERS}


def is_right(student: int) -> bool:
    return student % 2 == 0


def usual(exercise: Exercise, v: dict[str, Any], student: int) -> dict[str, str]:
    """The cells of a student with one of the habits of the demonstration."""
    habits = {habit.title: habit for habit in HABITS}
    title = USUAL[student % len(USUAL)]
    answers = habits[title].spoil(exercise, v, references(exercise, v))
    cells: dict[str, str] = {}
    for part in exercise.asked:
        if part.variable in answers:
            cells[part.variable] = part.answer.code(part.variable, answers[part.variable])
    return cells


def ours(slugs: tuple[str, ...], cells: Cells) -> Callable[[Path, int], list[list[str]]]:
    """A course with one sheet of these exercises, handed in with these cells."""

    def prepare(folder: Path, count: int) -> list[list[str]]:
        (folder / "exercises").mkdir(parents=True)
        shutil.copy(EXERCISE, folder / "exercises")
        lines = ["student,name", *(f"s{number:03},S {number}" for number in range(count))]
        (folder / "roster.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        (folder / "secret").write_text("a benchmark keeps no secrets\n", encoding="utf-8")
        (folder / "secret").chmod(0o600)
        sheet = f'[[sheet]]\nname = "one"\ntitle = "One"\nexercises = {json.dumps(slugs)}\n'
        (folder / "course.toml").write_text(f'title = "A course"\n{sheet}', encoding="utf-8")

        course = read_course(folder)
        with gradebook_of(course) as gradebook:
            generate(course, gradebook, course.settings.sheet)
            exercises = {one.slug: one for one in exercises_of(course, course.settings.sheet[0])}
            for record in gradebook.records("one"):
                student = int(record.student[1:])
                filled = cells(exercises[record.exercise], record.numbers, student)
                _hand_in(folder, record.student, filled)
        program = str(Path(sys.executable).with_name("kinegrade"))
        return [[program, "grade", "--accept-medium", "--course", str(folder)]]

    return prepare


def _hand_in(folder: Path, student: str, cells: dict[str, str]) -> None:
    """Fills the answers of one exercise in, beside those of the exercises before it."""
    submitted = folder / "submitted" / student / "one.ipynb"
    source = folder / "released" / student / "one.ipynb"
    if submitted.exists():
        source = submitted
    submitted.parent.mkdir(parents=True, exist_ok=True)
    submitted.write_bytes(fill_in(source.read_bytes(), cells))


def full_marks_of_ours(folder: Path) -> int:
    with (folder / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
        return sum(row["points"] == str(len(ANSWERS)) for row in csv.DictReader(file))


def nbgrader(bin_: Path) -> Callable[[Path, int], list[list[str]]]:
    """An assignment whose tests compare each matrix; `nbgrader autograde` marks all students."""

    def prepare(folder: Path, count: int) -> list[list[str]]:
        cells = five_matrices(None, PEERS_NUMBERS, 0)
        _write(folder / "source" / "ps1" / "ps1.ipynb", _nbgrader_cells(dict.fromkeys(cells, "")))
        (folder / "nbgrader_config.py").write_text(
            f'c = get_config()\nc.CourseDirectory.root = "{folder}"\n', encoding="utf-8"
        )
        program = [str(bin_ / "nbgrader")]
        assign = [*program, "generate_assignment", "ps1", f"--course={folder}"]
        subprocess.run(assign, check=True, capture_output=True, cwd=folder, env=environment(bin_))
        released = json.loads((folder / "release" / "ps1" / "ps1.ipynb").read_text("utf-8"))
        for student in range(count):
            handed_in = json.loads(json.dumps(released))
            for cell in handed_in["cells"]:
                name = cell["metadata"].get("nbgrader", {}).get("grade_id", "")
                typed = five_matrices(None, PEERS_NUMBERS, student)
                if name in typed:
                    cell["source"] = typed[name]
            path = folder / "submitted" / f"s{student:03}" / "ps1" / "ps1.ipynb"
            path.parent.mkdir(parents=True)
            path.write_text(json.dumps(handed_in), encoding="utf-8")
        return [[*program, "autograde", "ps1", f"--course={folder}"]]

    return prepare


def _nbgrader_cells(cells: dict[str, str]) -> list[dict[str, Any]]:
    made = [_cell("import numpy as np")]
    for name in cells:
        about = {"schema_version": 3, "grade": False, "solution": True, "locked": False}
        made.append(_cell("### BEGIN SOLUTION\n### END SOLUTION", grade_id=name, **about))
        about = {"schema_version": 3, "grade": True, "solution": False, "locked": True}
        test = f"assert {_agrees(name)}"
        made.append(_cell(test, grade_id=f"test_{name}", points=1, **about))
    return made


def full_marks_of_nbgrader(folder: Path) -> int:
    query = """select count(*) from (select sum(g.auto_score) as score from grade g
        join submitted_notebook n on g.notebook_id = n.id group by n.id) where score = 5"""
    with sqlite3.connect(folder / "gradebook.db") as database:
        return database.execute(query).fetchone()[0]


def otter_run(bin_: Path) -> Callable[[Path, int], list[list[str]]]:
    """`otter run`, which marks one notebook."""

    def prepare(folder: Path, count: int) -> list[list[str]]:
        notebooks = _otter(bin_, folder, count)
        run = [str(bin_ / "otter"), "run", "--no-logo", "-a", str(folder / "autograder.zip")]
        return [[*run, "-o", str(path.parent), str(path)] for path in notebooks]

    return prepare


def otter_api(bin_: Path) -> Callable[[Path, int], list[list[str]]]:
    """A loop around `otter.api.grade_submission` in one process."""

    def prepare(folder: Path, count: int) -> list[list[str]]:
        notebooks = map(str, _otter(bin_, folder, count))
        return [[str(bin_ / "python"), "-c", API, str(folder / "autograder.zip"), *notebooks]]

    return prepare


def _otter(bin_: Path, folder: Path, count: int) -> list[Path]:
    """The autograder of five tests, and the notebooks of a class."""
    (folder / "tests").mkdir(parents=True)
    for name in five_matrices(None, PEERS_NUMBERS, 0):
        case = {"code": f">>> bool({_agrees(name)})\nTrue", "hidden": False, "locked": False}
        suite = {"cases": [case], "scored": True, "setup": "", "teardown": "", "type": "doctest"}
        test = {"name": name, "points": 1, "suites": [suite]}
        (folder / "tests" / f"{name}.py").write_text(f"OK_FORMAT = True\ntest = {test!r}\n")
    generate_ = [str(bin_ / "otter"), "generate", "-t", str(folder / "tests"), "--no-config"]
    generate_ += ["--no-requirements", "--no-environment", "-o", str(folder / "autograder.zip")]
    subprocess.run(generate_, check=True, capture_output=True, cwd=folder, env=environment(bin_))

    notebooks: list[Path] = []
    for student in range(count):
        typed = five_matrices(None, PEERS_NUMBERS, student)
        path = folder / f"s{student:03}" / "ps1.ipynb"
        _write(path, [_cell(code) for code in ("import numpy as np", *typed.values())])
        notebooks.append(path)
    return notebooks


def full_marks_of_otter(folder: Path) -> int:
    found = 0
    for path in folder.glob("s*/*.json"):
        result = json.loads(path.read_text(encoding="utf-8"))
        score = result.get("score")
        if score is None:
            score = sum(test.get("score", 0) for test in result["tests"])
        found += score == len(ANSWERS)
    return found


def _agrees(name: str) -> str:
    """A test of one matrix, in Python."""
    scope: dict[str, Any] = {"np": np}
    for code in five_matrices(None, PEERS_NUMBERS, 0).values():
        exec(code, scope)  # noqa: S102 - our own cells
    return f"np.allclose({name}, np.array({scope[name].tolist()}), atol=1e-4)"


def _cell(source: str, **about: Any) -> dict[str, Any]:
    metadata = {"nbgrader": about | {"cell_type": "code"}} if about else {}
    return {
        "cell_type": "code",
        "metadata": metadata,
        "source": source,
        "outputs": [],
        "execution_count": None,
    }


def _write(path: Path, cells: list[dict[str, Any]]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    content = {"cells": cells, "metadata": KERNEL, "nbformat": 4, "nbformat_minor": 4}
    path.write_text(json.dumps(content), encoding="utf-8")
