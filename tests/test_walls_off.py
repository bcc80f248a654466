"""Each wall is needed: with it alone taken away, attacks that it stops are no longer stopped.

No attack here forks, signals, fills memory or writes outside its folder.
"""

import struct

import pytest
from hostile_notebooks import as_notebook, hostile_notebooks
from jails import skip_without
from kinegrade.grader.collecting.ask import Limits
from kinegrade.grader.collecting.collect import collect
from kinegrade.grader.jail import walls, zygote
from kinegrade.grader.jail.jail import FOR_MANY, Jail
from kinegrade.grader.jail.level import Level
from test_hostile import ASKS, REACHED, holds, town

__all__ = ["town"]  # the fixture

HOSTILE = {hostile.name: hostile for hostile in hostile_notebooks()}
UNTRIED = (
    "import sys; sys.path.append(sys.argv[2]); "
    "from {package} import alarms, landlock, start, student; "
    "start._tried = lambda *_: ''; OFF; start.main(int(sys.argv[1]))"
)
ALLOW_ALL = struct.pack("HBBI", 6, 0, 0, 0x7FFF0000)  # one instruction: return "allowed"
INSIDE = {
    "Landlock": "landlock.restrict = lambda _: None",
    "rlimits": "student.limit = lambda _: None",
    "alarms": "alarms.listen = lambda: None",
}
LEVELS = {"seccomp": Level.STRONG, "Landlock": Level.MEDIUM, "rlimits": Level.MEDIUM}
STOPPED_BY = {
    "Landlock": [
        "course_climbs_by_dots", "course_opens_without_reading", "course_reads_a_classmate",
        "course_reads_gradebook", "course_reads_record", "course_reads_secret",
        "course_reads_solutions", "escape_lists_processes", "escape_reads_process_files",
        "network_urllib", "python_magics_that_run",
    ],
    "seccomp": [
        "course_watches_folders", "escape_copies_memory_between_processes", "kernel_bpf",
        "kernel_enters_namespace", "kernel_handles_of_files", "kernel_io_uring", "kernel_mount",
        "kernel_open_tree", "kernel_perf", "kernel_pivot_root", "kernel_user_namespace",
        "kernel_userfaultfd", "network_event_loop",
        "network_udp",
    ],
    "rlimits": ["folder_sparse_file"],
    "alarms": [
        "answer_array_protocol_that_loops", "answer_function_that_loops", "limit_loop",
        "limit_regular_expression", "limit_sleep",
    ],
    "the bound of a frame": ["frame_of_a_huge_length"],
}  # fmt: skip


def take_away(monkeypatch, wall):
    """Has the next zygote start without a wall, and nobody try out whether it is there."""
    monkeypatch.setattr(walls, "START", UNTRIED.replace("OFF", INSIDE.get(wall, "pass")))
    if wall == "seccomp":
        monkeypatch.setattr(walls, "filter_code", lambda: ALLOW_ALL)
    if wall == "the bound of a frame":
        monkeypatch.setattr(zygote, "MAX_FRAME", 1 << 64)


def broken(hostile, jail, first):
    """The claims of a notebook that do not hold in this jail."""
    limits = Limits(hostile.cell_seconds, hostile.seconds, memory_mb=1024, file_mb=4)
    raws = collect(
        as_notebook(hostile, first),
        [*ASKS, REACHED],
        limits,
        jail=jail,
        beside={"measured.csv": b"1,2\n"},
    )
    return [claim for claim in hostile.claims if not holds(claim, raws)]


@pytest.mark.slow
@pytest.mark.parametrize("wall", STOPPED_BY)
def test_without_one_wall_its_attacks_are_no_longer_stopped(monkeypatch, town, wall):
    level = LEVELS.get(wall, Level.MEDIUM)
    skip_without(level)
    take_away(monkeypatch, wall)
    with Jail(level=level, preload=FOR_MANY) as jail:
        held = [name for name in STOPPED_BY[wall] if not broken(HOSTILE[name], jail, town.first)]
    assert held == []


def test_at_least_twenty_attacks_are_shown_to_be_stopped_by_one_wall():
    assert sum(map(len, STOPPED_BY.values())) >= 20
