"""A real Dask scheduler with two workers on the loopback: the marks are those of one machine, whoever is killed."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager

import pytest
from courses import LEVER, hand_in, handed_out, make_course, notebook, right_answers
from kinegrade.course.grading import cluster as module
from kinegrade.course.grading.cluster import Cluster, ClusterError
from kinegrade.course.grading.task import MARK
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.grader.jail.level import JailError, Level, Permission
from test_grading import graded, recorded, said

MANY = [(f"s{i:02}", f"Student {i}") for i in range(14)]
COMMAND = (sys.executable, "-c", "from kinegrade.course.cli import main; main()")
ON_LOOPBACK = ("--host", "127.0.0.1", "--no-dashboard")
SECONDS = 60
DIES = """
import os


def tip(v, _):
    if os.environ.get("DIES") and v["L"] == LENGTH:
        os.kill(os.getpid(), 9)
"""


def environment(**more):
    path = os.pathsep.join(entry for entry in sys.path if entry)
    return {**os.environ, "PYTHONPATH": path, "COLUMNS": "100", **more}


@contextmanager
def started(words, folder, **more):
    """A process that is ended with the test, whatever it does."""
    with (folder / "log.txt").open("ab") as log:
        process = subprocess.Popen(
            words, cwd=folder, env=environment(**more), stdout=log, stderr=log
        )
    try:
        yield process
    finally:
        process.kill()
        process.wait()


@contextmanager
def running(folder, workers=2, **more):
    """A scheduler's address, and its workers."""
    folder.mkdir()
    with ExitStack() as stack:
        place = folder / "scheduler.json"
        words = [sys.executable, "-m", "dask", "scheduler", "--port", "0", *ON_LOOPBACK]
        words += ["--scheduler-file", str(place)]
        scheduler = stack.enter_context(started(words, folder, **more))
        address = json.loads(waited_for(lambda: place.exists() and place.read_text()))["address"]
        words = [sys.executable, "-m", "dask", "worker", address, *ON_LOOPBACK]
        words += ["--nthreads", "1", "--no-nanny", "--local-directory", str(folder)]
        found = [stack.enter_context(started(words, folder, **more)) for _ in range(workers)]
        waited_for(lambda: count(address) == workers)
        yield address, scheduler, found


def count(address):
    from distributed import Client

    with Client(address, timeout=SECONDS, set_as_default=False) as client:
        return len(client.scheduler_info(n_workers=-1)["workers"])


def waited_for(look):
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        found = look()
        if found:
            return found
        time.sleep(0.05)
    return pytest.fail("it never came")


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """One cluster for all tests that kill nobody."""
    with running(tmp_path_factory.mktemp("cluster") / "dask") as (address, _, _):
        yield address


@pytest.fixture(scope="module")
def handed_in(tmp_path_factory):
    """Fourteen submissions, right and wrong, two with the same wrong numbers, half of them notebooks."""
    folder = make_course(tmp_path_factory.mktemp("class") / "course", students=MANY)
    course = handed_out(folder)
    for i, (student, _) in enumerate(MANY):
        right = right_answers(course, student)
        if i % 4 == 3:
            right["lever_J"] = -right["lever_J"]
        if i % 2:
            values = {name: right[name].tolist() for name in ("lever_p", "lever_J")}
            cells = [f"{name} = {value}" for name, value in values.items()]
            hand_in(course, student, notebook(*cells, "import time; time.sleep(0.3)"), "one.ipynb")
        else:
            hand_in(course, student, right)
    return folder


@pytest.fixture
def folder(handed_in, tmp_path):
    shutil.copytree(handed_in, tmp_path / "course")
    return tmp_path / "course"


@pytest.fixture(scope="module")
def marks(handed_in, tmp_path_factory):
    """What one machine gives."""
    folder = tmp_path_factory.mktemp("alone") / "course"
    shutil.copytree(handed_in, folder)
    return graded(folder)


def command(folder, address, *more):
    return [
        *COMMAND,
        "grade",
        "-c",
        str(folder),
        "--cluster",
        address,
        "--accept-medium",
        "--unsafe",
        *more,
    ]


def run(folder, address, *more):
    return subprocess.run(
        command(folder, address, *more),
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )


def rows(folder, table):
    with (
        Gradebook(folder / "gradebook.sqlite") as gradebook,
        gradebook.database.reading() as connection,
    ):
        return connection.exec_driver_sql(f"SELECT count(*) FROM {table}").scalar()  # noqa: S608


def test_a_cluster_gives_the_marks_of_one_machine_and_says_the_levels(cluster, folder, marks):
    ran = run(folder, cluster)
    assert ran.returncode == 0, ran.stderr
    assert re.search(r"Workers: 2 at level (strong|medium|unsafe)\.", ran.stderr)
    assert recorded(folder) == marks
    assert rows(folder, "grade") == len(MANY)
    assert (folder / "report" / "index.html").exists()
    again = run(folder, cluster)
    assert again.returncode == 0
    assert rows(folder, "grade") == len(MANY)


@pytest.mark.slow
def test_a_worker_that_is_killed_half_way_costs_no_mark(tmp_path, folder, marks):
    with (
        running(tmp_path / "dask") as (address, _, (first, _)),
        started(command(folder, address), tmp_path) as grading,
    ):
        waited_for(lambda: rows(folder, "grade") >= 3)
        assert grading.poll() is None
        first.send_signal(signal.SIGKILL)
        assert grading.wait(SECONDS) == 0, (tmp_path / "log.txt").read_text()
    assert first.returncode == -signal.SIGKILL
    assert recorded(folder) == marks
    assert rows(folder, "grade") == len(MANY)


@pytest.mark.slow
def test_what_kills_its_workers_waits_with_the_reason_and_is_marked_by_the_next_run(tmp_path):
    folder = make_course(tmp_path / "course")
    course = handed_out(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        lengths = {one.student: one.numbers["L"] for one in gradebook.records("one")}
    text = LEVER.replace("\ndef tip(v, _):\n", DIES.replace("LENGTH", str(lengths["ben"])))
    (folder / "exercises" / "lever.py").write_text(text, encoding="utf-8")
    graded(folder)  # nobody handed in yet; it is known that the answers have not moved
    for student in ("ada", "ben", "cyd"):
        hand_in(course, student, right_answers(course, student))
    few = {"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "0", "DIES": "1"}
    with running(tmp_path / "dask", workers=4, **few) as (address, _, _):
        ran = run(folder, address)
    assert ran.returncode == 0, ran.stderr
    found = recorded(folder)
    assert [result.points for result in found.values()] == [5, None, 5]
    assert "were killed, one after the other; the submission is kept" in said(found["ben"])
    assert graded(folder)["ben"].points == 5


@pytest.mark.slow
def test_where_the_scheduler_goes_what_was_marked_is_kept(tmp_path, folder, marks):
    with (
        running(tmp_path / "dask") as (address, scheduler, _),
        started(command(folder, address), tmp_path) as grading,
    ):
        waited_for(lambda: rows(folder, "grade") >= 3)
        scheduler.kill()
        assert grading.wait(2 * SECONDS) == 1
    log = (tmp_path / "log.txt").read_text(encoding="utf-8")
    assert "is gone; what was marked is kept" in log
    assert "Traceback" not in log
    kept = rows(folder, "grade")
    assert 3 <= kept < len(MANY)
    assert graded(folder) == marks
    assert rows(folder, "grade") == len(MANY)


def test_where_no_scheduler_answers_there_is_a_sentence(folder, monkeypatch, kinegrade):
    monkeypatch.setattr(module, "ANSWER_SECONDS", 1)
    ran = kinegrade("grade", "-c", folder, "--cluster", "tcp://127.0.0.1:9")
    assert ran.code == 1
    assert "no Dask scheduler answers at tcp://127.0.0.1:9; `dask scheduler` starts one" in ran.err


def test_what_is_no_address_gets_the_same_sentence(folder, kinegrade):
    ran = kinegrade("grade", "-c", folder, "--cluster", "nonsense://x")
    assert ran.code == 1
    assert "no Dask scheduler answers at nonsense://x" in ran.err


def test_without_dask_the_extra_is_named(folder, monkeypatch, kinegrade):
    monkeypatch.setitem(sys.modules, "distributed", None)
    ran = kinegrade("grade", "-c", folder, "--cluster", "tcp://127.0.0.1:9")
    assert ran.code == 1
    assert "pip install 'kinegrade[cluster]'" in ran.err


def test_a_scheduler_without_workers_is_named(tmp_path):
    with (
        running(tmp_path / "dask", workers=0) as (address, _, _),
        pytest.raises(ClusterError, match="has no workers yet; start some with `dask worker"),
    ):
        Cluster(address, Permission())


@pytest.mark.parametrize(
    ("own", "said"),
    [
        (("0.0.1", "x"), "and here is 0.0.1; every worker takes the same"),
        ((module.about()[0], "x"), "some of its files differ; every worker takes the same"),
    ],
)
def test_a_worker_with_another_kinegrade_is_refused(cluster, monkeypatch, own, said):
    real = module.about
    monkeypatch.setattr(Cluster, "_asked", lambda *_, **__: {"tcp://w": real()})
    monkeypatch.setattr(module, "about", lambda: own)
    with pytest.raises(ClusterError, match=said):
        Cluster(cluster, Permission())


def test_work_of_another_kinegrade_is_not_done():
    with pytest.raises(ClusterError, match="a worker that came later has another kinegrade"):
        module.there_by("another", MARK, b"{}")


def test_the_weakest_level_counts_and_a_worker_below_what_is_permitted_is_named(capsys):
    levels = {"a": ("strong", ""), "b": ("medium", ""), "c": ("strong", "")}
    assert module._weakest(levels) is Level.MEDIUM
    assert "Workers: 2 at level strong, 1 at level medium." in capsys.readouterr().err
    with pytest.raises(JailError, match="the worker d runs no notebooks: no bubblewrap"):
        module._weakest(levels | {"d": ("", "no bubblewrap")})


def test_a_machine_without_a_permitted_level_says_why(monkeypatch):
    def refuse(permission):
        raise JailError(f"nothing for {permission.unsafe}")

    monkeypatch.setattr(module, "best_level", refuse)
    assert module.level_there(accept_medium=False, unsafe=True) == ("", "nothing for True")
