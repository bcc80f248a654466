# pyright: basic
"""Marking a class: processor time per submission, memory per process, two cores against one.

`python benchmarks/class_run.py` builds classes of two sizes, whose students hand in notebooks of
three exercises with the habits of the demonstration, and marks them with `kinegrade grade`. What a
further submission costs is the slope between the two sizes. Nothing is asserted; trust the ratios.
"""

import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from threading import Event, Thread

from kinegrade.course.commands.demo import fill_in
from kinegrade.course.commands.habits import HABITS, Code, Habit
from kinegrade.course.handing_out.generate import generate
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.machine.files import write_atomically
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import Course, Student, read_course
from kinegrade.exercises.exercise import Exercise, Part, references

SIZES = (60, 240)  # far apart: what a start costs more or less is not taken for students
TIMES = 5
SHEET = "jacobian"
EXERCISES = ("three_axis", "rrt", "puma_velocities")
COMMAND = (sys.executable, "-c", "from kinegrade.course.cli import main; main()")
WAITS = "loop"  # a notebook that waits for its time to be over measures nothing
MB = 1 << 20
TASKSET = shutil.which("taskset") or sys.exit("taskset is not installed (apt install util-linux)")


@dataclass(frozen=True)
class Run:
    """One `kinegrade grade`.

    Attributes:
        wall: On the clock. [s]
        cpu: Of all processes. [s]
        memory: The most that a process of each kind ever had. [MB]
    """

    wall: float
    cpu: float
    memory: Mapping[str, float]


def class_of(folder: Path, size: int) -> Path:
    """A course whose students all handed in."""
    folder.mkdir()
    lines = ["student,name", *(f"s{i:04},Student {i}" for i in range(size))]
    write_atomically(folder / "roster.csv", "\n".join(lines) + "\n")
    write_atomically(folder / "secret", "a class that is measured has no secrets\n", mode=0o600)
    names = ", ".join(f'"{slug}"' for slug in EXERCISES)
    settings = f'title = "A class"\n[[sheet]]\nname = "{SHEET}"\nexercises = [{names}]\n'
    write_atomically(folder / "course.toml", settings)
    course = read_course(folder)
    habits = [habit for habit in HABITS if WAITS not in habit.title]
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        generate(course, gradebook, course.settings.sheet)
        numbers = {(one.student, one.exercise): one.numbers for one in gradebook.records(SHEET)}
    exercises = exercises_of(course, course.settings.sheet[0])
    for i, student in enumerate(course.students):
        hand_in(course, student, exercises, habits[i % len(habits)], numbers)
    return folder


def hand_in(
    course: Course,
    student: Student,
    exercises: list[Exercise],
    habit: Habit,
    numbers: Mapping[tuple[str, str], dict[str, object]],
) -> None:
    cells: dict[str, str] = {}
    for exercise in exercises:
        v = numbers[student.id, exercise.slug]
        answers = habit.spoil(exercise, v, references(exercise, v))
        for part in exercise.asked:
            if part.variable in answers:
                cells[part.variable] = written(part, answers[part.variable])
    released = course.folder / "released" / student.id / f"{SHEET}.ipynb"
    submitted = course.folder / "submitted" / student.id / released.name
    write_atomically(submitted, fill_in(released.read_bytes(), cells))


def written(part: Part, answer: object) -> str:
    if isinstance(answer, Code):
        return answer.text
    return part.answer.code(part.variable, answer).replace("nan", "np.nan")


def graded(folder: Path, cores: int, *, watched: bool = False) -> Run:
    """Marks a copy of a course on so many cores."""
    with tempfile.TemporaryDirectory() as place:
        course = Path(place) / "course"
        shutil.copytree(folder, course)
        words = [*COMMAND, "grade", "-c", str(course), "--accept-medium", "--json"]
        return timed(words, cores, watched=watched)


def timed(words: list[str], cores: int, *, watched: bool = False) -> Run:
    """Runs a command; `watched`, its memory is looked at, which takes a core from what is timed."""
    allowed = sorted(os.sched_getaffinity(0))[:cores]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    process = subprocess.Popen(
        [TASKSET, "-c", ",".join(map(str, allowed)), *words],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        env={name: text for name, text in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"},
    )
    memory: dict[str, float] = {}
    ended = Event()
    watcher = Thread(target=watch, args=(process.pid, ended, memory))
    if watched:
        watcher.start()
    _, said = process.communicate()
    wall = time.perf_counter() - start
    ended.set()
    if watched:
        watcher.join()
    if process.returncode:
        sys.exit(said.decode())
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Run(wall, cpu, memory)


def watch(pid: int, ended: Event, memory: dict[str, float]) -> None:
    """Notes the most that any process of each kind ever had."""
    while not ended.wait(0.1):
        for process, depth in tree(pid):
            kind = kind_of(process, depth)
            memory[kind] = max(memory.get(kind, 0.0), private_memory(process))


def tree(pid: int, depth: int = 0) -> list[tuple[int, int]]:
    found = [(pid, depth)]
    try:
        for task in Path(f"/proc/{pid}/task").iterdir():
            for child in (task / "children").read_text().split():
                found += tree(int(child), depth + 1)
    except OSError:
        pass
    return found


def kind_of(pid: int, depth: int) -> str:
    try:
        command = Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return "gone"
    if depth == 0:
        return "the command"
    if b"spawn_main" in command:
        return "a worker"
    return "its notebooks"


def private_memory(pid: int) -> float:
    """Memory of a process, in which what several share is divided among them."""
    try:
        for line in Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines():
            if line.startswith("Pss:"):
                return int(line.split()[1]) * 1024 / MB
    except OSError:
        pass
    return 0.0


def main() -> None:
    available = len(os.sched_getaffinity(0))
    with tempfile.TemporaryDirectory() as place:
        os.environ["XDG_CACHE_HOME"] = str(Path(place) / "cache")
        classes = {size: class_of(Path(place) / f"class{size}", size) for size in SIZES}
        runs: dict[tuple[int, int], list[Run]] = {}
        for _ in range(TIMES):  # by turns, as the machine has other things to do
            for size, folder in classes.items():
                for cores in {1, min(2, available)}:
                    runs.setdefault((size, cores), []).append(graded(folder, cores))
        show(runs, {key: graded(classes[key[0]], key[1], watched=True).memory for key in runs})
        folder = classes[SIZES[-1]]
        words = [*COMMAND, "grade", "-c", str(folder), "--accept-medium", "--json"]
        timed(words, available)
        again = min(timed(words, available).cpu for _ in range(TIMES))
        print(f"\nnothing new: {1000 * again / SIZES[-1]:.1f} ms a student, start included")


def show(
    runs: Mapping[tuple[int, int], list[Run]],
    memory: Mapping[tuple[int, int], Mapping[str, float]],
) -> None:
    print(
        f"{'students':>8} {'cores':>5} {'wall s':>7} {'cpu s':>7}   most memory of one process, MB"
    )
    for (size, cores), some in sorted(runs.items()):
        wall = median(run.wall for run in some)
        cpu = median(run.cpu for run in some)
        kinds = ("the command", "a worker", "its notebooks")
        most = [f"{kind} {memory[size, cores].get(kind, 0):.0f}" for kind in kinds]
        print(f"{size:>8} {cores:>5} {wall:7.2f} {cpu:7.2f}   {', '.join(most)}")

    small, large = SIZES
    for cores in sorted({cores for _, cores in runs}):
        cpu = slope(runs, cores, "cpu")
        wall = slope(runs, cores, "wall")
        hours = cpu * 100_000 / 3600
        print(
            f"{cores} core(s): a further submission takes {cpu:.3f} s of the processor and "
            f"{wall:.3f} s on the clock; 100,000 take {hours:.1f} core-hours"
        )
    for size in (small, large):
        pairs = zip(runs[size, 1], runs[size, max(cores for _, cores in runs)], strict=True)
        ratios = ", ".join(f"{one.wall / two.wall:.2f}" for one, two in pairs)
        print(f"{size} students, two cores against one, whole command: {ratios}")


def slope(runs: Mapping[tuple[int, int], list[Run]], cores: int, what: str) -> float:
    small, large = (median(getattr(run, what) for run in runs[size, cores]) for size in SIZES)
    return (large - small) / (SIZES[1] - SIZES[0])


if __name__ == "__main__":
    main()
