"""Courses, submissions and runs of the command line that several test files share."""

import json
import sys
from dataclasses import dataclass

import pytest
from answers import SLUGS
from kinegrade.course.cli import main
from kinegrade.course.handing_out.generate import generate
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.marking.how import this_machine
from kinegrade.course.marking.marker import SheetMarker
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import Sheet, read_course
from kinegrade.exercises.exercise import Exercise, references
from kinegrade.exercises.files.finding import load

SECRET = "a secret for tests, long enough"  # noqa: S105
CLASS = (("ada", "Ada Lovelace"), ("ben", "Ben Bot"), ("cyd", 'Cyd, the "third"'))
BUNDLED = tuple(SLUGS)
LEVER = '''
"""An exercise without figures, so that a class is drawn and marked in no time."""
import numpy as np
from kinegrade.exercises.exercise import Exercise, Numbers, Part


def tip(v, _):
    return v["L"] * np.array([np.cos(v["q"][0]), np.sin(v["q"][0])])


def column(_, given):
    x, y = given["lever_p"]
    return np.array([-y, x])


EXERCISE = Exercise(
    slug="lever",
    title="A lever",
    source="made for tests",
    draw=lambda rng: {"L": float(rng.integers(40, 121)) / 100, "q": [float(rng.integers(200, 1300)) / 1000]},
    parts=(
        Part("lever_p", "The tip", 2, Numbers((2,), "m"), tip),
        Part("lever_J", "Its Jacobian", 3, Numbers((2,), "m/rad"), column, needs=("lever_p",)),
    ),
    statement=lambda v: "A lever.",
    units={"L": "m", "q": ["rad"]},
    scale=lambda v: v["L"],
)
'''


def make_course(
    folder, *, exercises=("lever",), students=CLASS, secret=SECRET, mode="graded", more=""
):
    """A course folder with one sheet `one`; `lever` is the course's own exercise."""
    (folder / "exercises").mkdir(parents=True, exist_ok=True)
    (folder / "exercises" / "lever.py").write_text(LEVER, encoding="utf-8")
    listed = ", ".join(f'"{slug}"' for slug in exercises)
    sheet = (
        f'[[sheet]]\nname = "one"\ntitle = "Sheet one"\nmode = "{mode}"\nexercises = [{listed}]\n'
    )
    (folder / "course.toml").write_text(f'title = "Tests"\n{sheet}{more}', encoding="utf-8")
    write_secret(folder, secret)
    enrol(folder, students)
    return folder


def write_secret(folder, secret=SECRET, mode=0o600):
    path = folder / "secret"
    path.write_text(f"{secret}\n", encoding="utf-8")
    path.chmod(mode)
    return path


def enrol(folder, students):
    lines = [
        "student,name",
        *(f'{student},"{name.replace(chr(34), chr(34) * 2)}"' for student, name in students),
    ]
    (folder / "roster.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


def handed_out(folder):
    """The course of a folder, with every sheet drawn and written."""
    course = read_course(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        generate(course, gradebook, course.settings.sheet)
    return course


def marked(course, gradebook, sheet=None, *, step=lambda: None, **how):
    """The results of a sheet, of the first where none is named, marked on this machine."""
    with this_machine(course) as machine:
        marker = SheetMarker(course, gradebook, sheet or course.settings.sheet[0], machine, **how)
        return marker.results(step)


def right_answers(course, student, sheet="one"):
    """Reference answers of one student's sheet, by variable."""
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        records = [record for record in gradebook.records(sheet) if record.student == student]
    named = {sheet.name: sheet for sheet in course.settings.sheet}
    known = {exercise.slug: exercise for exercise in exercises_of(course, named[sheet])}
    return {
        k: x
        for record in records
        for k, x in references(known[record.exercise], record.numbers).items()
    }


def hand_in(course, student, answers, name="one.json"):
    """Puts answers, or the bytes of any file, where submissions are looked for."""
    path = course.folder / "submitted" / student / name
    path.parent.mkdir(parents=True, exist_ok=True)
    if not isinstance(answers, bytes):
        answers = json.dumps(
            {k: x.tolist() if hasattr(x, "tolist") else x for k, x in answers.items()}
        ).encode()
    path.write_bytes(answers)
    return path


def notebook(*sources, about=None):
    """The bytes of a notebook with these code cells."""
    cells = [
        {
            "cell_type": "code",
            "id": f"c{i}",
            "metadata": {},
            "outputs": [],
            "execution_count": None,
            "source": source,
        }
        for i, source in enumerate(sources)
    ]
    metadata = {"kinegrade": about} if about else {}
    return json.dumps(
        {"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}
    ).encode()


def lever(folder):
    """The exercise `lever`, of a file in a folder."""
    path = folder / "lever.py"
    path.write_text(LEVER, encoding="utf-8")
    return load(path)


def exercise_of(*parts, draw=lambda rng: {"x": float(rng.uniform(0.1, 0.9))}, **more):
    """An exercise `t` made of these parts."""
    plain = {
        "title": "t",
        "source": "tests",
        "statement": lambda _: "t",
        "units": {"x": "1"},
        "scale": lambda _: 1.0,
    }
    return Exercise(slug="t", draw=draw, parts=parts, **(plain | more))


def sheet(mode="graded", exercises=BUNDLED):
    return Sheet(name="one", title="Sheet one", mode=mode, exercises=exercises)


def files_of(folder):
    """Path to bytes of every file below a folder."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


@dataclass(frozen=True)
class Ran:
    """What one run of the command line left."""

    code: int
    out: str
    err: str


class Kinegrade:
    """The command line, run in this process."""

    def __init__(self, monkeypatch, capsys):
        self.monkeypatch, self.capsys = monkeypatch, capsys

    def __call__(self, *arguments):
        self.monkeypatch.setattr(sys, "argv", ["kinegrade", *map(str, arguments)])
        self.capsys.readouterr()
        with pytest.raises(SystemExit) as stop:
            main()
        captured = self.capsys.readouterr()
        return Ran(int(stop.value.code or 0), captured.out, captured.err)
