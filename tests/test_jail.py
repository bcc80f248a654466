"""What stands between a notebook and the machine, at each level, and what a lost notebook is."""

import contextlib
import json
import os
import shutil
import signal
import socket
import stat
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from courses import notebook
from jails import LIMITS, WALLED, run_at, skip_without
from kinegrade.grader.collecting.ask import Ask, Limits
from kinegrade.grader.collecting.collect import collect
from kinegrade.grader.inside import scratch
from kinegrade.grader.jail import jail as jail_module
from kinegrade.grader.jail.jail import FOR_ONE, Jail, best_level, missing
from kinegrade.grader.jail.level import ANY, WALLS, JailError, Level, Permission
from kinegrade.grader.jail.packages import importable

ASKS = [Ask("x")]
ROOT = Path(__file__).parents[1]


def says(raw, words):
    assert raw.kind == "error", raw
    assert words in raw.value
    return True


def tried(code):
    """Code that sets x to the name of the error that it stops with, or to "done"."""
    lines = "\n".join(f"    {line}" for line in code.splitlines())
    return f"try:\n{lines}\n    x = 'done'\nexcept BaseException as error:\n    x = type(error).__name__"


@pytest.fixture(params=WALLED)
def level(request):
    skip_without(request.param)
    return request.param


@pytest.fixture
def walled(level):
    with Jail(level=level, preload=FOR_ONE) as jail:
        yield jail


def run(jail, *sources, limits=LIMITS, **more):
    return collect(notebook(*sources), ASKS, limits, jail=jail, **more)["x"]


ENDS = """
import atexit, sys
from kinegrade.grader.jail.jail import Jail
from kinegrade.grader.jail.level import Level
jail = Jail(level=Level(sys.argv[1]), preload=())
zygote = jail._taken(jail._idle, ())
jail._idle.put(zygote)
atexit.register(lambda: print("ended with", zygote.process.poll()))  # called after the next
atexit.register(jail.close)
"""


def test_a_process_that_ends_ends_its_zygotes_in_order(level):
    """Those that are killed leave no account of the time that notebooks took, nor an empty folder."""
    command = [sys.executable, "-c", ENDS, level]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    assert ran.stdout == "ended with 0\n"


def test_a_machine_that_has_the_parts_of_a_level_has_the_level():
    """So that no fault of ours passes for a machine without walls, where tests are skipped."""
    from kinegrade.grader.inside import landlock
    from kinegrade.grader.jail.syscalls import NoFilterError, filter_code

    try:
        parts = bool(filter_code()) and landlock.version() > 0
    except NoFilterError:
        parts = False
    if not parts:
        pytest.skip("this machine has no Landlock or no libseccomp")
    assert missing(Level.MEDIUM) == ""
    plain = ["bwrap", "--unshare-all", "--unshare-user", "--ro-bind", "/", "/", "true"]
    if not shutil.which("bwrap") or subprocess.run(plain, check=False).returncode:
        pytest.skip("this machine has no bubblewrap of its own that makes namespaces")
    assert missing(Level.STRONG) == ""


@pytest.mark.parametrize("each", Level)
def test_every_level_runs_a_notebook(each):
    assert run_at(each, "import numpy as np\nx = np.eye(2)")["x"].value.shape == (2, 2)


@pytest.mark.parametrize(
    "code",
    [
        "import os\nos.fork()",
        "import os\nos.posix_spawn('/bin/true', ['true'], {})",
        "import subprocess\nsubprocess.run(['true'])",
        "import multiprocessing as m\nm.get_context('spawn').Process(target=print).start()",
        "import os\nos.execv('/bin/true', ['true'])",
        "import os\nos.kill(os.getpid(), 9)",
        "import os\nos.kill(os.getppid(), 19)",
        "import fcntl, os\nfcntl.fcntl(0, fcntl.F_SETOWN, os.getppid())",
        "import socket\nsocket.socket()",
        "import socket\nsocket.socket(socket.AF_UNIX)",
        "import os\nos.chmod('.', 0o777)",
        "import os\nos.symlink('/', 'link')",
        "import os\nos.link('/etc/passwd', 'link')",
        "import os\nos.mkfifo('pipe')",
        "import os\nos.setpriority(os.PRIO_PROCESS, 0, -5)",
        "import os\nos.memfd_create('room')",
        "import resource as r\nr.setrlimit(r.RLIMIT_CPU, (r.RLIM_INFINITY, r.RLIM_INFINITY))",
        "import os\nos.open('/dev/null', os.O_RDONLY | os.O_TRUNC)",
    ],
)
def test_no_processes_no_sockets_no_signals_no_rights(walled, code):
    assert run(walled, tried(code)).value in ("PermissionError", "ValueError")  # setrlimit's own


def test_threads_run_as_in_jupyter(walled):
    code = "import threading\nx = []\nt = threading.Thread(target=x.append, args=(1,))\nt.start()\nt.join()"
    assert run(walled, code).value.tolist() == [1]


@pytest.mark.parametrize(
    "call",
    ["ptrace(0, 1, 0, 0)", "unshare(0x10000000)", "mount(0, 0, 0, 0, 0)", "syscall(425, 1, 0)"],
)
def test_what_only_an_attack_calls_stops_the_process(walled, call):
    found = run(walled, f"import ctypes\nctypes.CDLL(None).{call}")
    assert says(found, "did what no notebook may")
    assert run(walled, "x = 1").value == 1


def test_the_network_is_not_there(level, walled):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        code = f"import socket\nsocket.create_connection(('127.0.0.1', {port}), timeout=2)"
        assert run(walled, tried(code)).value == "PermissionError"


@pytest.mark.parametrize(
    "path", ["/etc/passwd", str(ROOT / "pyproject.toml"), str(Path(__file__)), "/proc/self/environ"]
)
def test_files_of_the_machine_cannot_be_read(walled, path):
    assert run(walled, tried(f"open({path!r}).read(1)")).value in (
        "PermissionError",
        "FileNotFoundError",
    )


def test_folders_of_the_machine_cannot_be_listed(walled, tmp_path):
    for folder in (tmp_path, "/tmp", "/proc", "/var", Path.cwd()):  # noqa: S108 - that is the question
        said = run(walled, tried(f"import os\nos.listdir({str(folder)!r})")).value
        assert said in ("PermissionError", "FileNotFoundError")


def test_at_level_strong_a_path_of_the_machine_does_not_even_exist(tmp_path):
    code = f"import os\nx = [os.path.exists({str(tmp_path)!r}), os.getpid() < 100]"
    assert run_at(Level.STRONG, f"{code}\nx = [int(y) for y in x]")["x"].value.tolist() == [0, 1]


@pytest.mark.parametrize(
    "folder",
    ["/", "..", "/tmp", "/dev/shm", "/usr/lib", "/packages"],  # noqa: S108 - that is the question
)
def test_nothing_can_be_written_but_in_the_own_folder(walled, folder):
    said = run(walled, tried(f"open({folder!r} + '/kinegrade-attempt', 'w')")).value
    assert said in ("PermissionError", "FileNotFoundError", "OSError")
    assert not Path(folder, "kinegrade-attempt").exists()


def test_a_file_of_the_course_cannot_be_emptied_or_removed(walled, tmp_path):
    path = tmp_path / "gradebook.sqlite"
    path.write_text("marks")
    for code in (f"open({str(path)!r}, 'w')", f"import os\nos.truncate({str(path)!r}, 0)",
                 f"import os\nos.unlink({str(path)!r})"):  # fmt: skip
        assert run(walled, tried(code)).value != "done"
    assert path.read_text() == "marks"


@pytest.mark.parametrize(
    "name", ["kinegrade", "sqlalchemy", "pydantic", "pytest", "collect", "inside.no_such"]
)
def test_our_engine_and_what_is_not_allowed_cannot_be_imported(walled, name):
    assert run(walled, tried(f"import importlib\nimportlib.import_module({name!r})")).value == (
        "ModuleNotFoundError"
    )


def test_no_file_of_ours_can_be_found(walled):
    code = (
        "import os, sys\nfound = []\nfor place in sys.path:\n    for folder, _, names in os.walk(place):\n"
        "        found += [name for name in names if 'kinegrade' in name or name == 'jacobian.py']\n"
        "x = len(found)"
    )
    assert run(walled, code).value == 0


def test_a_package_that_the_course_allows_is_there(level):
    with Jail(
        packages=["radon-no-such", "typing_extensions"], level=level, preload=FOR_ONE
    ) as jail:
        assert run(jail, "import typing_extensions\nx = 1").value == 1


def test_what_a_package_requires_comes_with_it_and_never_our_own():
    found = set(importable(("kinegrade",)))
    assert {"numpy", "sympy", "mpmath", "matplotlib", "dateutil", "IPython", "traitlets"} <= found
    assert not {"kinegrade", "solutions", "sqlalchemy"} & found


def test_a_database_in_a_file_can_be_written_and_read(walled):
    code = """
import sqlite3
with sqlite3.connect("a.db") as base:
    base.execute("create table q (value)")
    base.execute("insert into q values (3)")
base.close()
(x,) = sqlite3.connect("a.db").execute("select value from q").fetchone()
"""
    assert run(walled, code).value == 3


def test_memory_has_an_end(walled):
    code = "x = 'done'\ntry:\n    y = np.ones(10**9)\nexcept MemoryError:\n    x = 'MemoryError'"
    assert run(walled, code).value == "MemoryError"


def test_a_file_has_an_end_and_so_have_all_together(level, walled):
    write = "open(f'f{i}', 'wb').write(bytes(15 << 20))"
    assert run(walled, tried("open('f', 'wb').write(bytes(17 << 20))")).value == "OSError"
    if level is Level.STRONG:
        assert run(walled, tried(f"for i in range(9):\n    {write}")).value == "OSError"
    else:
        code = f"import time\nfor i in range(30):\n    {write}\ntime.sleep(5)\nx = 1"
        assert says(run(walled, code), "more files than a sheet asks for")


def test_a_loop_that_ignores_its_alarms_is_stopped_by_the_clock(walled):
    code = "from signal import *\nfor bell in (SIGALRM, SIGPROF): signal(bell, SIG_IGN)\nwhile True: pass"
    limits = Limits(cell_seconds=1, notebook_seconds=3)
    found = collect(notebook("x = 1", code, "y = 1"), [Ask("x"), Ask("y")], limits, jail=walled)
    assert found["x"].value == 1
    assert found["y"].kind in ("error", "interrupted")  # the latter on a machine that is busy
    assert "after 3 s" in found["y"].value


def test_a_notebook_that_waited_at_its_time_is_run_again(walled):
    code = "from signal import *\nfor bell in (SIGALRM, SIGPROF): signal(bell, SIG_IGN)\nimport time\ntime.sleep(60)"
    found = run(walled, code, limits=Limits(cell_seconds=1, notebook_seconds=2))
    assert found.kind == "interrupted"
    assert "it waited, or this machine was busy" in found.value


def test_results_of_calls_that_were_not_made_are_asked_again(walled):
    code = (
        "from signal import *\nimport time\nfor bell in (SIGALRM, SIGPROF): signal(bell, SIG_IGN)\n"
        "def x(a):\n    if a > 1: time.sleep(60)\n    return a"
    )
    limits = Limits(cell_seconds=9, notebook_seconds=2)
    found = collect(notebook(code), [Ask("x", ((1.0,), (2.0,)))], limits, jail=walled)["x"]
    assert found.kind == "interrupted"


def test_without_walls_children_of_a_notebook_do_not_outlive_it(tmp_path):
    marker = tmp_path / "alive"
    child = f"import time; time.sleep(1.5); open({str(marker)!r}, 'w')"
    code = f"import subprocess, sys\nsubprocess.Popen([sys.executable, '-c', {child!r}])\nx = 1"
    assert run_at(Level.UNSAFE, code)["x"].value == 1
    time.sleep(2)
    assert not marker.exists()


def later(seconds, action):
    timer = threading.Timer(seconds, action)
    timer.start()
    return timer


@pytest.mark.parametrize("each", Level)
def test_a_notebook_whose_zygote_is_killed_is_run_again_and_the_next_one_runs(each):
    skip_without(each)
    with Jail(level=each, preload=FOR_ONE) as jail:
        assert run(jail, "x = 1").value == 1
        zygote = jail._idle.get()
        jail._idle.put(zygote)
        timer = later(0.5, lambda: os.kill(zygote.process.pid, signal.SIGKILL))
        found = run(jail, "import time\ntime.sleep(9)\nx = 1")
        timer.join()
        assert (found.kind, "stopped from outside" in found.value) == ("interrupted", True)
        assert run(jail, "x = 2").value == 2


@pytest.mark.parametrize(
    ("source", "loaded"), [("x = 1", False), ("import sympy\nx = 1", True), ("%pwd\nx = 1", True)]
)
def test_what_is_loaded_before_a_notebook_runs_follows_from_what_it_mentions(source, loaded):
    code = f"{source}\nimport sys\nx = float('matplot' + 'lib' in sys.modules)"
    skip_without(Level.MEDIUM)
    with Jail(level=Level.MEDIUM) as jail:
        for _ in range(2):
            assert run(jail, code).value == loaded


def test_a_notebook_that_is_killed_by_somebody_else_is_run_again():
    killed = run_at(Level.UNSAFE, "import os\nos.kill(os.getpid(), 9)")["x"]
    assert killed.kind == "interrupted"


@pytest.mark.parametrize(
    "mess",
    [
        "open('left', 'w').write('x')",
        "import os\nos.makedirs('a/b')\nopen('a/b/c', 'w')\nos.mkdir('shut', 0)",
        "import os\nos.mkdir('s', 0o700)\nopen('s/f', 'w')\nos.umask(0o777)\nos.mkdir('s/t')",
        "import os\nfor _ in range(1500):\n    os.mkdir('d')\n    os.chdir('d')",
        "import os\nopen('.hidden', 'w')\nos.mkdir('..data')",
    ],
)
def test_nothing_is_left_for_the_next_student(walled, mess):
    assert run(walled, f"{mess}\nx = 1").value == 1
    look = "import os, sys\nx = [len(os.listdir('.')), len(os.listdir(os.environ['TMPDIR']))]"
    assert run(walled, look).value.tolist() == [0, 0]


def test_modules_and_names_of_one_student_are_not_the_next_ones(walled):
    run(walled, "import numpy as np\nnp.cross = None\nimport builtins\nbuiltins.stolen = 1\nx = 1")
    code = "import builtins\nx = [int(np.cross is None), int(hasattr(builtins, 'stolen'))]"
    assert run(walled, code).value.tolist() == [0, 0]


def processes_of(group):
    """Processes in a session, by their ids."""
    found = []
    for file in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = file.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[3]) == group or int(fields[1]) == group:
            found.append(file.parent.name)
    return found


@pytest.mark.parametrize("each", Level)
def test_no_process_and_no_folder_is_left_when_a_jail_is_closed(each, tmp_path, monkeypatch):
    skip_without(each)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with Jail(level=each, preload=FOR_ONE) as jail:
        run(jail, "open('left', 'w')\nx = 1")
        zygote = jail._idle.get()
        jail._idle.put(zygote)
        assert zygote.process.poll() is None
    assert processes_of(zygote.process.pid) == []
    assert list(tmp_path.iterdir()) == []


DIES = """
import os, sys
sys.path.insert(0, {tests!r})
from courses import notebook
from kinegrade.grader.collecting.ask import Ask, Limits
from kinegrade.grader.collecting.collect import collect
from kinegrade.grader.jail.jail import FOR_ONE, Jail
from kinegrade.grader.jail.level import Level
jail = Jail(level=Level({level!r}), preload=FOR_ONE)
collect(notebook("x = 1"), [Ask("x")], jail=jail)
zygote = jail._idle.get()
jail._idle.put(zygote)
print(zygote.process.pid, flush=True)
collect(notebook("import time\\ntime.sleep(300)"), [Ask("x")], jail=jail)
"""


@pytest.mark.parametrize("each", Level)
def test_a_grader_that_is_killed_leaves_no_notebook_running(each, tmp_path):
    skip_without(each)
    command = [sys.executable, "-c", DIES.format(tests=str(Path(__file__).parent), level=str(each))]
    env = {**os.environ, "TMPDIR": str(tmp_path)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, env=env) as grader:
        assert grader.stdout is not None
        group = int(grader.stdout.readline())
        time.sleep(0.5)
        assert processes_of(group)
        grader.kill()
    end = time.monotonic() + 20
    while processes_of(group) and time.monotonic() < end:
        time.sleep(0.1)
    assert processes_of(group) == []
    assert list(tmp_path.iterdir()) == []


def without(monkeypatch, *levels):
    monkeypatch.setattr(
        jail_module, "missing", lambda level: "it is switched off" if level in levels else ""
    )


def permitting(monkeypatch, permission):
    """The levels as a command has them, also where tests may go further down."""
    order = [Level.STRONG, Level.MEDIUM, Level.UNSAFE]
    count = 3 if permission.unsafe else 1 + permission.accept_medium
    monkeypatch.setattr(Permission, "levels", lambda _: order[:count])
    return permission


def test_the_best_permitted_level_is_taken(monkeypatch):
    without(monkeypatch)
    assert best_level(permitting(monkeypatch, ANY)) is Level.STRONG
    without(monkeypatch, Level.STRONG)
    assert best_level(permitting(monkeypatch, Permission(accept_medium=True))) is Level.MEDIUM
    without(monkeypatch, Level.STRONG, Level.MEDIUM)
    assert best_level(permitting(monkeypatch, Permission(unsafe=True))) is Level.UNSAFE


def test_below_what_is_permitted_notebooks_are_refused_with_the_way_out(monkeypatch):
    without(monkeypatch, Level.STRONG)
    with pytest.raises(JailError) as stop:
        best_level(permitting(monkeypatch, Permission()))
    for words in ("strong is not to be had: it is switched off", "apt install bubblewrap",
                  "--accept-medium", "--unsafe"):  # fmt: skip
        assert words in str(stop.value)
    without(monkeypatch, Level.STRONG, Level.MEDIUM)
    with pytest.raises(JailError) as stop:
        best_level(permitting(monkeypatch, Permission(accept_medium=True)))
    assert "--accept-medium" not in str(stop.value)


@pytest.mark.parametrize("each", Level)
def test_every_level_says_what_it_is_made_of(each):
    assert WALLS[each]


def test_a_wall_that_does_not_hold_is_found_out(level, monkeypatch, tmp_path):
    open_to_all = tmp_path / "open"
    open_to_all.write_text("x")
    place = Path("/dev/null") if level is Level.STRONG else open_to_all
    monkeypatch.setattr("kinegrade.grader.jail.walls.OUTSIDE", str(place))
    if level is Level.MEDIUM:
        trees = (*jail_module_trees(), tmp_path)
        monkeypatch.setattr("kinegrade.grader.jail.walls.readable_without_hidden", lambda: trees)
    with Jail(level=level, preload=()) as jail, pytest.raises(JailError, match="could read"):
        run(jail, "x = 1")


def jail_module_trees():
    from kinegrade.grader.jail.machine import readable_without_hidden

    return readable_without_hidden()


def test_a_course_is_refused_where_no_level_is_permitted(class_of_three, kinegrade, monkeypatch):
    put_notebook(class_of_three)
    without(monkeypatch, Level.STRONG, Level.MEDIUM)
    permitting(monkeypatch, Permission())
    ran = kinegrade("grade", "--course", class_of_three.folder)
    assert ran.code == 1
    assert "level strong is not to be had" in ran.err
    assert "Traceback" not in ran.err


def put_notebook(course):
    path = course.folder / "submitted" / "ada" / "one.ipynb"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(notebook("lever_p = [1, 2]"))


def test_a_run_without_walls_stamps_report_and_grades_until_it_is_run_behind_some(
    class_of_three, kinegrade, monkeypatch
):
    put_notebook(class_of_three)
    folder = class_of_three.folder
    with monkeypatch.context() as patch:
        without(patch, Level.STRONG, Level.MEDIUM)
        permitting(patch, Permission(unsafe=True))
        ran = kinegrade("grade", "--course", folder, "--unsafe")
    assert "at level unsafe" in ran.err
    kinegrade("report", "--course", folder)  # it does not forget
    report = (folder / "report" / "index.html").read_text()
    assert "1 of these notebooks ran at level unsafe" in report
    assert '"level"' in (folder / "grades.csv").read_text()
    assert "level unsafe" not in (folder / "feedback" / "ada" / "one.html").read_text()

    ran = kinegrade("grade", "--course", folder, "--accept-medium")
    assert "at level unsafe" not in ran.err
    assert "Notebooks were run at level" in ran.err
    assert "level unsafe" not in (folder / "report" / "index.html").read_text()
    assert '"level"' not in (folder / "grades.csv").read_text()


def test_an_interrupted_notebook_is_not_graded_and_marked_at_the_next_grade(
    class_of_three, kinegrade, monkeypatch
):
    put_notebook(class_of_three)
    folder = class_of_three.folder
    with monkeypatch.context() as patch:
        patch.setattr(Jail, "run", lambda *_: None)
        kinegrade("grade", "--course", folder)
    assert '"ada","Ada Lovelace","","5","","not_graded"' in (folder / "grades.csv").read_text()
    kinegrade("grade", "--course", folder)
    assert '"5","graded"' in (folder / "grades.csv").read_text()


def test_a_package_that_is_absent_is_named_to_the_instructor(class_of_three, kinegrade):
    put_notebook(class_of_three)
    path = class_of_three.folder / "submitted" / "ada" / "one.ipynb"
    path.write_bytes(notebook("import no_such\nlever_p = no_such.f()"))
    ran = kinegrade("grade", "--course", class_of_three.folder)
    assert "notebooks ask for no_such, which is not there (ada)" in ran.err


def test_limits_below_those_that_a_sheet_was_handed_out_with_are_named(class_of_three, kinegrade):
    put_notebook(class_of_three)
    settings = class_of_three.folder / "course.toml"
    before = settings.read_text()
    for seconds, said in ((2, True), (30, False), (60, False)):
        settings.write_text(before + f"\n[limits]\ncell_seconds = {seconds}\n")
        ran = kinegrade("grade", "--course", class_of_three.folder)
        sentence = (
            "Sheet one was handed out with cell_seconds = 30, and course.toml says 2: students"
        )
        assert (sentence in ran.err) == said
        assert ("was handed out with" in ran.err) == said


@pytest.mark.parametrize("name", ["numpy.no_such", "json", "\x1b[2Knot there"])
def test_what_is_there_and_what_is_no_name_is_not_called_absent(class_of_three, kinegrade, name):
    put_notebook(class_of_three)
    path = class_of_three.folder / "submitted" / "ada" / "one.ipynb"
    path.write_bytes(notebook(f"raise ModuleNotFoundError(name={name!r})\nlever_p = 1"))
    ran = kinegrade("grade", "--course", class_of_three.folder)
    assert "notebooks need" not in ran.err


def test_the_limits_of_a_sheet_travel_with_it_to_the_check(class_of_three):
    from kinegrade.course.sheet.handout import read_handout

    path = class_of_three.folder / "released" / "ada" / "one.ipynb"
    assert read_handout(path).limits == Limits()
    content = json.loads(path.read_bytes())
    content["metadata"]["kinegrade"]["limits"]["cell_seconds"] = 55
    path.write_text(json.dumps(content))
    assert read_handout(path).limits.cell_seconds == 55
    first = "".join(content["cells"][0]["source"])
    assert "a cell may compute for 30 s, and all cells together may take 180 s" in first


@pytest.mark.skipif(sys.platform != "linux", reason="notebooks run on Linux")
def test_who_looks_into_a_hidden_folder_opens_none_elsewhere(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda *_: False)  # as it is for who is not root
    elsewhere, folder = tmp_path / "elsewhere", tmp_path / "scratch"
    (elsewhere / "inner").mkdir(parents=True)
    (folder / "hidden").mkdir(parents=True)
    modes = {elsewhere: 0o750, elsewhere / "inner": 0o755, folder / "hidden": 0o300}
    for path, mode in modes.items():
        path.chmod(mode)
    assert not scratch.is_too_full(str(folder))
    assert stat.S_IMODE((folder / "hidden").stat().st_mode) == 0o700

    (folder / "link").symlink_to(elsewhere)
    for swapped in ("link", "link/inner"):
        with contextlib.suppress(NotADirectoryError):
            scratch._looked_at(str(folder / swapped), str(folder))
    for path in (elsewhere, elsewhere / "inner"):
        assert stat.S_IMODE(path.stat().st_mode) == modes[path]
