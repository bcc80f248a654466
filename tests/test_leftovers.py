"""What a killed run leaves is cleared away by the next, unless another kinegrade may still need it."""

import errno
import os
import subprocess
import sys

import pytest
from courses import make_course
from kinegrade.course.leftovers import cleared

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
from kinegrade.course.leftovers import cleared
with cleared(Path(sys.argv[1])):
    print("in", flush=True)
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
