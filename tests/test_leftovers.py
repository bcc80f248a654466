"""What a killed run leaves is cleared away by the next, unless another kinegrade may still need it."""

import errno
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest
from courses import make_course
from kinegrade.course.machine.leftovers import cleared
from kinegrade.grader.jail.folders import clear_folders, new_folder, remove

OURS = (
    ".grades.csv.x1.part",
    "report/.index.html.x2.part",
    "released/ada/.one.ipynb.x3.part",
    "solutions/ada/.one.ipynb.x4.part",
    "feedback/ada/.one.html.x5.part",
    "submitted/ada/.one.ipynb.x6.part",
    "submitted/.received.csv.x9.part",
    "exchange/.one-moodle.csv.xa.part",
)
OTHERS = (
    "part",
    "a.part",
    ".hidden",
    "submitted/ada/deep/.one.ipynb.x8.part",
    "exercises/.lever.py.x7.part",
    "released/ada/one.part.ipynb",
)
HOLDING = """
import sys
from pathlib import Path
from kinegrade.course.machine.leftovers import cleared
with cleared(Path(sys.argv[1])):
    print("in", flush=True)
    sys.stdin.read()
"""

WAITING = """
import sys
from kinegrade.grader.jail.level import Level
from kinegrade.grader.jail.zygote import Zygote
zygote = Zygote(Level.UNSAFE, (), ())
print(zygote.process.pid, zygote._surroundings.folder, flush=True)
sys.stdin.read()
"""


@pytest.fixture
def folder(tmp_path):
    make_course(tmp_path)
    for name in (*OURS, *OTHERS):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    return tmp_path


def there(folder, names):
    return [name for name in names if (folder / name).exists()]


def test_files_that_were_never_completed_are_cleared_away_and_no_others(folder):
    with cleared(folder):
        assert there(folder, OURS) == []
        assert there(folder, OTHERS) == [*OTHERS]


def test_every_command_that_opens_a_course_clears_it(folder, kinegrade):
    assert kinegrade("generate", "-c", folder).code == 0
    assert there(folder, OURS) == []


@pytest.mark.parametrize("end", ["terminate", "kill"])
def test_nothing_is_cleared_while_another_is_at_work(folder, end):
    with subprocess.Popen(
        [sys.executable, "-c", HOLDING, folder],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    ) as other:  # fmt: skip
        assert other.stdout is not None
        assert other.stdout.readline() == "in\n"
        for name in OURS:
            (folder / name).touch()
        with cleared(folder):
            assert there(folder, OURS) == [*OURS]
        getattr(other, end)()
        other.wait()
    with cleared(folder):
        assert there(folder, OURS) == []


def test_a_folder_that_is_not_there_is_named(tmp_path):
    with pytest.raises(FileNotFoundError) as raised, cleared(tmp_path / "nowhere"):
        pass
    assert os.fspath(raised.value.filename) == str(tmp_path / "nowhere")


def test_where_the_file_system_knows_no_locks_nothing_is_cleared_and_all_goes_on(
    folder, monkeypatch
):
    monkeypatch.setattr("fcntl.flock", no_locks)
    with cleared(folder):
        assert there(folder, OURS) == [*OURS]


def no_locks(*_):
    raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """A temporary folder of the test's own."""
    place = tmp_path / "tmp"
    place.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(place))
    return place


def make_old(path):
    long_ago = time.time() - 3600
    os.utime(path, (long_ago, long_ago))


def test_a_folder_of_notebooks_is_cleared_when_grader_and_zygote_were_killed(tmp_path, temporary):
    """Not before: while the grader lives, the folder is its."""
    make_course(tmp_path / "course")
    with subprocess.Popen(
        [sys.executable, "-c", WAITING],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
        env={**os.environ, "TMPDIR": str(temporary)},
    ) as grader:  # fmt: skip
        assert grader.stdout is not None
        zygote, path = grader.stdout.readline().split()
        make_old(path)
        with cleared(tmp_path / "course"):
            assert (Path(path) / "packages").is_dir()
        grader.send_signal(signal.SIGSTOP)  # it cannot see the zygote go
        os.kill(int(zygote), signal.SIGKILL)
        grader.kill()
    assert Path(path).is_dir()
    with cleared(tmp_path / "course"):
        assert list(temporary.iterdir()) == []


def test_a_new_folder_a_link_and_other_names_are_left(temporary):
    new = temporary / "kinegrade-notebooks-new"
    other = temporary / "kinegrade-sheets"
    link = temporary / "kinegrade-notebooks-link"
    for path in (new, other):
        path.mkdir()
    link.symlink_to(other)
    make_old(other)
    os.utime(link, (0, 0), follow_symlinks=False)
    clear_folders()
    assert {path.name for path in temporary.iterdir()} == {new.name, other.name, link.name}


def test_a_folder_is_held_until_it_is_removed(temporary):
    path = new_folder()
    make_old(path)
    clear_folders()
    assert path.is_dir()
    remove(str(path))
    assert not path.exists()
    remove(str(path))
