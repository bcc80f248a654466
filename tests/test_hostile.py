"""Hostile notebooks: each does what it tries in vain, and the next one does not notice."""

import ctypes
import os
import re
import select
import signal
import site
import socket
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from courses import SECRET, handed_out, make_course, notebook
from hostile_notebooks import KINDS, PAGE, as_notebook, first_cell, hostile_notebooks, table
from jails import WALLED, skip_without
from kinegrade.grader.collecting.ask import Ask, Limits
from kinegrade.grader.collecting.collect import FORBIDDEN, collect
from kinegrade.grader.jail.jail import FOR_MANY, Jail
from kinegrade.grader.jail.level import Level
from kinegrade.grader.jail.machine import INSIDE

HOSTILE = hostile_notebooks()
ASKS = [Ask("x"), Ask("y"), Ask("f", ((1.0,), (2.0,)))]
UNANSWERED = {"lost": ("error", "missing"), "again": ("interrupted",)}
REACHED = Ask("reached")  # by the attack, at its point
CANARY = "a canary that no notebook may bring back"
MARK = "hostile-was-here"  # the name of every file that is written where none may be
BESIDE = "measured.csv"
REFUSALS = {"PermissionError", "FileNotFoundError", "OSError"}
ADOPT_ORPHANS = 36
NEXT = """
import os, sys, json, gc, time, signal
import numpy as np, sympy as sp
a, b = np.array([1.0, 2, 3]), np.array([4.0, 5, 6])
x = [*np.cross(a, b), np.allclose(a, b), len(os.listdir('.')), len(os.listdir(os.environ['TMPDIR']))]
y = sp.diff(sp.Symbol('q') ** 3)
def f(a): return float(a) / 3
"""


@dataclass(frozen=True)
class Town:
    """What stands around a notebook: a course, and sockets that wait for somebody to knock."""

    course: Path
    sockets: list[socket.socket]
    first: str


@pytest.fixture(scope="module")
def town(tmp_path_factory):
    folder = tmp_path_factory.mktemp("town")
    course = make_course(folder / "course")
    handed_out(course)
    for name in ("solutions/lever.py", "submitted/ben/one.ipynb", "record.json", ".git/config"):
        path = course / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(CANARY, encoding="utf-8")
    (course / "submitted" / "ada").mkdir()
    (course / "submitted" / "ada" / BESIDE).write_text("1,2\n", encoding="utf-8")

    sockets = [socket.create_server(("127.0.0.1", 0)), socket.socket(type=socket.SOCK_DGRAM)]
    sockets[1].bind(("127.0.0.1", 0))
    for address in (str(folder / "door"), f"\0{MARK}-{os.getpid()}"):
        door = socket.socket(socket.AF_UNIX)
        door.bind(address)
        door.listen()
        sockets.append(door)
    first = first_cell(
        COURSE=str(course),
        DOOR=str(folder / "door"),
        ABSTRACT=f"\0{MARK}-{os.getpid()}",
        TCP=sockets[0].getsockname()[1],
        UDP=sockets[1].getsockname()[1],
        GRADER=os.getpid(),
        SITE=site.getsitepackages()[0],
        ENGINE=str(INSIDE),
        MARK=MARK,
    )
    yield Town(course, sockets, first)
    for door in sockets:
        door.close()


@pytest.fixture(scope="module", params=WALLED)
def walled(request):
    """One jail for all notebooks; what loses its parent becomes a child of this process."""
    skip_without(request.param)
    prctl = ctypes.CDLL(None).prctl
    prctl(ADOPT_ORPHANS, 1, 0, 0, 0)
    with Jail(level=request.param, preload=FOR_MANY) as jail:
        yield jail
    prctl(ADOPT_ORPHANS, 0, 0, 0, 0)


def tree(folder):
    """Everything below a folder, with its bytes, rights and dates."""
    found = {}
    for path in sorted(folder.rglob("*")):
        about = path.lstat()
        data = path.read_bytes() if path.is_file() else b""
        found[str(path)] = (data, about.st_mode, about.st_mtime_ns, about.st_nlink)
    return found


def descendants(process):
    """All processes below one, by their ids."""
    children = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            parent = stat.read_text().rpartition(")")[2].split()[1]
        except OSError:
            continue
        children.setdefault(int(parent), []).append(int(stat.parent.name))
    found, waiting = set(), [process]
    while waiting:
        below = children.get(waiting.pop(), [])
        found.update(below)
        waiting += below
    return found


def waits(jail):
    """The processes of the zygote that waits for the next notebook: bubblewrap's and its own."""
    zygote = jail._idle.get()
    jail._idle.put(zygote)
    return {zygote.process.pid, *descendants(zygote.process.pid)}


def places():
    folders = [INSIDE, Path(site.getsitepackages()[0]), Path.cwd(), Path.home()]
    return [*folders, Path("/tmp"), Path("/var/tmp"), Path("/dev/shm"), Path("/")]  # noqa: S108 - that is the question


def next_one(jail):
    """Whether an honest notebook gets what it computed, in an empty folder."""
    raws = collect(notebook(NEXT), ASKS, Limits(), jail=jail)
    assert raws["x"].value.tolist() == [-3, 6, -3, 0, 0, 0], raws["x"]
    assert raws["y"].value == "3*q**2", raws["y"]
    assert [float(raw.value) for raw in raws["f"].value] == [1 / 3, 2 / 3]


def says(pattern, sentence):
    """Whether a sentence is this one, from its first letter to its last; * is any text."""
    pieces = [re.escape(piece) for piece in pattern.split("*")]
    return re.fullmatch(".*".join(pieces), sentence, re.DOTALL) is not None


def holds(claim, raws):
    """Whether one claim is true of what came back."""
    if claim.name == "process":
        return any(raw.value == FORBIDDEN for raw in raws.values())
    raw = raws[claim.name]
    if claim.verb == "refused":
        allowed = REFUSALS | set(filter(None, claim.value.split(", ")))
        return raw.kind == "text" and set(np.ravel(raw.value)) <= allowed
    if claim.verb in UNANSWERED:
        return raw.kind in UNANSWERED[claim.verb] and says(claim.value, raw.value)
    return values_of(raw) == claim.value


def values_of(raw):
    """Plain numbers and text of a raw value."""
    if raw.kind == "calls":
        return [values_of(result) for result in raw.value]
    return raw.value.tolist() if isinstance(raw.value, np.ndarray) else raw.value


@pytest.mark.parametrize("hostile", HOSTILE, ids=lambda hostile: hostile.name)
def test_a_hostile_notebook_gets_nothing_and_leaves_nothing(request, walled, town, hostile):
    why = hostile.through.get(str(walled.level))
    if why:
        request.applymarker(pytest.mark.xfail(reason=why, strict=True))
    next_one(walled)
    before, others = tree(town.course), descendants(os.getpid()) - waits(walled)
    signals = [signal.getsignal(number) for number in signal.valid_signals()]

    data = as_notebook(hostile, town.first)
    limits = Limits(hostile.cell_seconds, hostile.seconds, memory_mb=1024, file_mb=4)
    beside = {BESIDE: (town.course / "submitted" / "ada" / BESIDE).read_bytes()}
    raws = collect(data, [*ASKS, REACHED], limits, jail=walled, beside=beside)

    assert [claim for claim in hostile.claims if not holds(claim, raws)] == [], raws
    assert CANARY not in str(raws)
    assert SECRET not in str(raws)
    next_one(walled)
    assert tree(town.course) == before
    assert [folder for folder in places() if (folder / MARK).exists()] == []
    assert select.select(town.sockets, [], [], 0)[0] == []
    assert descendants(os.getpid()) - waits(walled) <= others
    assert len(waits(walled)) <= 2
    assert [signal.getsignal(number) for number in signal.valid_signals()] == signals


@pytest.mark.slow
def test_a_notebook_that_stops_at_its_first_line_is_found_out(town):
    skip_without(Level.MEDIUM)
    limits = Limits(cell_seconds=1, notebook_seconds=20)
    unnoticed = []
    with Jail(level=Level.MEDIUM, preload=FOR_MANY) as jail:
        for hostile in HOSTILE:
            cells = tuple(f"no_such_name\n{cell}" for cell in hostile.cells)
            data = as_notebook(replace(hostile, cells=cells), town.first)
            raws = collect(data, [*ASKS, REACHED], limits, jail=jail)
            if all(holds(claim, raws) for claim in hostile.claims):
                unnoticed.append(hostile.name)
    assert unnoticed == []


@pytest.mark.parametrize("must", ["x lost", "x again", "x is", "x stopped", "z is 1", "x lost "])
def test_a_claim_that_says_too_little_is_refused(must):
    hostile = replace(HOSTILE[0], must=must)
    with pytest.raises((ValueError, SyntaxError)):
        _ = hostile.claims


@pytest.mark.parametrize(
    ("pattern", "sentence", "said"),
    [
        ("cell 2 stopped", "cell 2 stopped", True),
        ("cell 2 stopped", "cell 2 stopped with NameError", False),
        ("stopped", "cell 2 stopped", False),
        ("cell 2 * (a)", "cell 2 is (a)", True),
        ("cell 2 * (a)", "cell 2 is a", False),
    ],
)
def test_a_sentence_is_compared_from_its_first_letter_to_its_last(pattern, sentence, said):
    assert says(pattern, sentence) == said


def test_there_are_a_hundred_notebooks_of_every_kind():
    assert len(HOSTILE) >= 100
    kinds = {hostile.name.partition("_")[0] for hostile in HOSTILE}
    assert kinds == set(KINDS)
    assert len({hostile.tries for hostile in HOSTILE}) == len(HOSTILE)


def test_the_table_on_the_page_is_that_of_the_notebooks():
    assert PAGE.read_text(encoding="utf-8") == table(), "run: python tests/hostile_notebooks.py"
