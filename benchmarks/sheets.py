# pyright: basic
"""What a class costs: processor time of one student's sheet, and a whole class by the clock.

`python benchmarks/sheets.py` makes PDFs and notebooks of a sheet of three exercises for a class of
300, or of `--students`; `--alone` leaves the class out. Nothing is asserted about time.
"""

import argparse
import os
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from kinegrade.course.handing_out.generate import generate
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.machine.cores import cores
from kinegrade.course.settings.config import Sheet, Student, read_course
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.notebook import handout_notebook, solution_notebook
from kinegrade.course.typeset.document import Front, handout_data, solution_data
from kinegrade.course.typeset.pdf import pdf
from kinegrade.course.variants.drawn import drawn
from kinegrade.course.variants.variant import fingerprint
from kinegrade.exercises.files.finding import exercise_files, find

EXERCISES = ("three_axis", "rrt", "puma_velocities")
SHEET = Sheet(name="jacobian", title="The manipulator Jacobian", exercises=EXERCISES)
STUDENT = Student("student01", "Student One")
WARM = 2  # students before times count: exercises are loaded and compiled, fonts are read
SECRET = "a benchmark keeps no secrets"  # noqa: S105


class Stopwatch:
    """Processor time by what it was spent on [ms], a list for every student."""

    def __init__(self) -> None:
        self.times: dict[str, list[float]] = {}

    def __call__(self, what: str, work: Callable[[], object]) -> object:
        start = time.process_time()
        done = work()
        self.times.setdefault(what, []).append(1e3 * (time.process_time() - start))
        return done


def one_student(seed: int, stopwatch: Stopwatch) -> None:
    """Makes everything of one student's sheet."""
    files = exercise_files()
    assignments: list[Assignment] = []
    for slug in EXERCISES:
        exercise = find(slug, files)
        assignments.append(Assignment(exercise, drawn(exercise, np.random.default_rng(seed))))
    about = ("Robotics", SHEET, STUDENT, assignments)
    front = Front("Robotics", SHEET, STUDENT, "K7M3-QXB9")

    for one in assignments:
        stopwatch("answers", lambda one=one: fingerprint(one.exercise, one.v))
    stopwatch("figures", lambda: [one.figures for one in assignments])
    stopwatch("figures with all frames", lambda: [one.solved_figures for one in assignments])
    stopwatch("steps of the solution", lambda: [one.solution for one in assignments])
    stopwatch("notebook", lambda: handout_notebook(*about))
    stopwatch("notebook of the solution", lambda: solution_notebook(*about))
    data = stopwatch("formulas of the sheet", lambda: handout_data(front, assignments))
    stopwatch("PDF", lambda: pdf(data))
    data = stopwatch("formulas of the solution", lambda: solution_data(front, assignments))
    stopwatch("PDF of the solution", lambda: pdf(data))


def show_one_student(students: int) -> None:
    """Prints the table of a sheet's processor time."""
    stopwatch = Stopwatch()
    for seed in range(WARM):
        one_student(seed, Stopwatch())
    for seed in range(WARM, WARM + students):
        one_student(seed, stopwatch)

    print("| one student's sheet of three exercises | ms of one core |")
    print("|---|--:|")
    total = 0.0
    for what, times in stopwatch.times.items():
        spent = statistics.median(times) * len(times) / students
        total += spent
        print(f"| {what} | {spent:.0f} |")
    print(f"| **together** | **{total:.0f}** |")


def show_class(students: int, formats: str) -> None:
    """Prints how long `kinegrade generate` takes for a class, by the clock."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        listed = ", ".join(f'"{slug}"' for slug in EXERCISES)
        settings = f'title = "Robotics"\nformats = [{formats}]\n[[sheet]]\nname = "one"\n'
        (folder / "course.toml").write_text(f"{settings}exercises = [{listed}]\n")
        (folder / "secret").write_text(SECRET)
        (folder / "secret").chmod(0o600)
        roster = [f"s{i:03},Student {i}" for i in range(students)]
        (folder / "roster.csv").write_text("\n".join(["student,name", *roster]) + "\n")

        course = read_course(folder)
        start, used = time.perf_counter(), _processor_time()
        with Gradebook(folder / "gradebook.sqlite") as gradebook:
            generate(course, gradebook, course.settings.sheet)
        seconds, spent = time.perf_counter() - start, _processor_time() - used
        files = sum(path.is_file() for path in folder.glob("[rs]*/*/*"))
        print(
            f"{files} files of {students} students, formats {formats}: {seconds:.0f} s by the "
            f"clock, {spent:.0f} s of one core, {spent / cores():.0f} s of all"
        )


def _processor_time() -> float:
    """Of this process and of those that ended [s]."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


def main() -> None:
    """Prints both."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--students", type=int, default=300)
    parser.add_argument("--alone", action="store_true")
    options = parser.parse_args()
    show_one_student(12)
    if not options.alone:
        show_class(options.students, '"pdf"')
        show_class(options.students, '"ipynb", "pdf"')


if __name__ == "__main__":
    main()
