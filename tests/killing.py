"""Commands killed at any moment, in forks of one warm process: a start takes milliseconds, so hundreds can be killed.

Run as a program, as a fork wants a process without threads: folder with the course, kills, seed.
"""

import contextlib
import os
import random
import shutil
import signal
import sys
import time
from pathlib import Path

from kinegrade.course import cli

COMMANDS = ("generate", "grade")
IN_A_ROW = 5
"""Kills of one command on one course; what was done counts the next time."""


def command_line(command, folder):
    """Runs a command here; its exit code."""
    sys.argv = ["kinegrade", command, "-c", str(folder)]
    try:
        cli.main()
    except SystemExit as stop:
        return int(stop.code or 0)


def run(command, folder, delay=None):
    """Runs a command in a fork, and kills it after some seconds; its exit code."""
    child = os.fork()
    if child == 0:
        log = os.open(folder / "output.txt", os.O_CREAT | os.O_APPEND | os.O_WRONLY)
        os.dup2(log, 1)
        os.dup2(log, 2)
        code = 99
        try:
            code = command_line(command, folder)
        finally:
            os._exit(code)
    if delay is not None:
        time.sleep(delay)
        os.kill(child, signal.SIGKILL)
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status)


def warm(blank):
    """Loads all that the commands load, so that no fork spends its time on that."""
    folder = blank.with_name("warm")
    shutil.copytree(blank, folder)
    with contextlib.redirect_stdout(sys.stderr):
        for command in COMMANDS:
            assert command_line(command, folder) == 0


def undisturbed(blank):
    """How long each command takes on a course without interruption. [s]"""
    folder = blank.with_name("timed")
    shutil.copytree(blank, folder)
    seconds = {}
    for command in COMMANDS:
        start = time.monotonic()
        assert run(command, folder) == 0, (folder / "output.txt").read_text(encoding="utf-8")
        seconds[command] = time.monotonic() - start
    return seconds


def main(blank, kills, seed):
    """Takes copies of a course through all commands until each was killed half of the times; prints how often."""
    warm(blank)
    rng, seconds = random.Random(seed), undisturbed(blank)  # noqa: S311 - the same delays every time
    killed = dict.fromkeys(COMMANDS, 0)
    courses = 0
    while min(killed.values()) < kills // 2:
        folder = blank.with_name(f"killed{courses}")
        shutil.copytree(blank, folder)
        courses += 1
        for command in COMMANDS:
            for _ in range(IN_A_ROW):
                code = run(command, folder, rng.uniform(0, seconds[command]))
                if code == 0:
                    break
                assert code == -signal.SIGKILL, (folder / "output.txt").read_text(encoding="utf-8")
                killed[command] += 1
            assert run(command, folder) == 0, (folder / "output.txt").read_text(encoding="utf-8")
    sys.stdout.write(" ".join(map(str, killed.values())))


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
