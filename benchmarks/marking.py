# pyright: basic
"""What marking costs beside nbgrader and otter-grader: `python benchmarks/marking.py`.

The peers are installed into environments of their own, once. Every marker gets classes that hand in
the same five matrices, of which some are wrong, and they take turns. What is counted is the
processor time of all processes that a command starts; the cost of a further submission is the slope
between a small class and a larger one, so that what starts once does not count. Nothing is asserted
about time.
"""

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

import markers
from markers import Marker

ROOT = Path(__file__).resolve().parent.parent
PEERS = {"nbgrader": ("nbgrader", "numpy"), "otter": ("otter-grader", "ipykernel", "numpy")}
OURS = "Kinegrade, `grade`"
SHEET = "Kinegrade, `grade`, a sheet of three exercises of the catalogue"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--venvs", type=Path, default=ROOT / "build" / "marking-peers", help="where the peers live"
    )
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--alone", action="store_true", help="without the peers")
    options = parser.parse_args()
    places: dict[str, Path | None] = {}
    if not options.alone:
        places = {name: prepared(options.venvs / name, PEERS[name]) for name in PEERS}

    compared = contenders(places)
    for marker in compared:
        cost(marker, marker.sizes[0])  # what is kept on the disk between commands is there then
    slopes: dict[str, list[float]] = {marker.name: [] for marker in compared}
    for number in range(options.rounds):
        for marker in compared:
            slopes[marker.name].append(slope(marker))
            said = f"round {number + 1}: {marker.name} {slopes[marker.name][-1]:.4f} s"
            print(said, file=sys.stderr)
    missing = [name for name, place in places.items() if place is None]
    print(table(slopes, missing))


def prepared(folder: Path, packages: tuple[str, ...]) -> Path | None:
    """The programs of an environment with these packages; None where they cannot be installed."""
    done = folder / "installed"
    if not done.exists():
        print(f"installing {', '.join(packages)} into {folder}", file=sys.stderr)
        venv.create(folder, with_pip=True, clear=True)
        pip = [str(folder / "bin" / "pip"), "install", "--quiet", "--disable-pip-version-check"]
        if subprocess.run([*pip, *packages], check=False).returncode:
            return None
        done.touch()
    return folder / "bin"


def contenders(places: dict[str, Path | None]) -> list[Marker]:
    """Ours, and those peers that are here."""
    five = markers.ours((markers.SLUG,), markers.five_matrices)
    three = markers.ours(markers.THREE, markers.usual)
    found = [
        Marker(OURS, (40, 200), five, markers.full_marks_of_ours),
        Marker(SHEET, (24, 72), three),
    ]
    here = places.get("nbgrader")
    if here:
        marker = Marker(
            "nbgrader, `autograde`", (2, 8), markers.nbgrader(here), markers.full_marks_of_nbgrader
        )
        found.append(marker)
    here = places.get("otter")
    if here:
        full = markers.full_marks_of_otter
        run = Marker("otter-grader, `otter run`", (1, 4), markers.otter_run(here), full)
        api = Marker("otter-grader, a loop around its API", (2, 6), markers.otter_api(here), full)
        found += [run, api]
    return found


def slope(marker: Marker) -> float:
    """Processor time of a further submission [s]."""
    small, large = marker.sizes
    return (cost(marker, large) - cost(marker, small)) / (large - small)


def cost(marker: Marker, count: int) -> float:
    """Processor time [s] of marking a class, by all processes."""
    with tempfile.TemporaryDirectory(prefix="benchmark-marking-") as name:
        folder = Path(name)
        commands = marker.prepare(folder, count)
        spent = sum(cpu_seconds(command, folder) for command in commands)
        wanted = sum(map(markers.is_right, range(count)))
        if marker.full and marker.full(folder) != wanted:
            found = marker.full(folder)
            sys.exit(f"{marker.name} gives full marks to {found} of {count} students, not {wanted}")
    return spent


def cpu_seconds(command: list[str], folder: Path) -> float:
    """What a command and all that it waits for take of the processor."""
    with (folder / "said.log").open("ab") as log:
        process = subprocess.Popen(
            command,
            cwd=folder,
            stdout=log,
            stderr=log,
            env=markers.environment(Path(command[0]).parent),
        )
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if status:
        said = (folder / "said.log").read_text(encoding="utf-8", errors="replace")
        sys.exit(f"{' '.join(command)[:200]} ended with {process.returncode}:\n{said[-2000:]}")
    return usage.ru_utime + usage.ru_stime


def table(slopes: dict[str, list[float]], missing: list[str]) -> str:
    """Medians with range, and how many times as much as ours."""
    lines = ["| one more submission | CPU seconds (range) | times ours |", "|---|--:|--:|"]
    own = slopes[OURS]
    for name, found in slopes.items():
        ratio = statistics.median(a / b for a, b in zip(found, own, strict=True))
        middle = f"{statistics.median(found):.3f} ({min(found):.3f}–{max(found):.3f})"
        lines.append(f"| {name} | {middle} | {ratio:.3g} |")
    lines += [f"| {name} | could not be installed here | – |" for name in missing]
    return "\n".join(lines)


if __name__ == "__main__":
    main()
