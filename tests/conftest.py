"""Fixtures that several test files share."""

import os

import postgres
import pytest
from answers import EXERCISES, SLUGS
from courses import BUNDLED, Kinegrade, handed_out, make_course
from hypothesis import settings
from kinegrade.grader.jail.jail import Jail, missing
from kinegrade.grader.jail.level import ANY, Level, Permission

settings.register_profile(
    "steady", derandomize=True
)  # the same examples every time: red means a change of ours
settings.load_profile("steady")
for variable in ("KINEGRADE_SECRET", "KINEGRADE_GRADEBOOK"):
    os.environ.pop(variable, None)  # whoever runs the tests may have a course


@pytest.fixture(autouse=True, scope="session")
def own_cache(tmp_path_factory):
    """Maps that tests draw are kept for the tests alone."""
    os.environ["XDG_CACHE_HOME"] = str(tmp_path_factory.mktemp("cache"))


@pytest.fixture(params=SLUGS)
def exercise(request):
    """Every exercise file, ours today and those to come."""
    return EXERCISES[request.param]


@pytest.fixture(scope="session")
def bundled_course(tmp_path_factory):
    """One student with a sheet of our own exercises, figures and all; nobody writes to it."""
    folder = tmp_path_factory.mktemp("bundled")
    return handed_out(make_course(folder, exercises=BUNDLED, students=[("ada", "Ada Lovelace")]))


def pytest_report_header():
    """At which level the notebooks of tests run that do not ask for one."""
    why = missing(Level.STRONG)
    return f"notebooks: not at level strong, {why}" if why else "notebooks: level strong"


if missing(Level.STRONG):  # what is not about levels is tested at the best one there is
    PERMITTED = ANY.levels()
    Permission.levels = lambda _: PERMITTED


@pytest.fixture(scope="session")
def jail():
    """The best level that there is, for notebooks of the tests' own."""
    with Jail(ANY) as jail:
        yield jail


@pytest.fixture
def class_of_three(tmp_path):
    """A course of three students with a drawn sheet of the exercise `lever`."""
    return handed_out(make_course(tmp_path / "course"))


@pytest.fixture(scope="session")
def postgres_server():
    """A PostgreSQL server; skips with a sentence where none is installed."""
    with postgres.running() as server:
        yield server


@pytest.fixture(params=["sqlite", "postgresql"])
def place(request, tmp_path):
    """Where a new gradebook may lie, on both databases."""
    if request.param == "sqlite":
        return tmp_path / "gradebook.sqlite"
    return request.getfixturevalue("postgres_server").database()


@pytest.fixture
def kinegrade(monkeypatch, capsys):
    """Runs the command line as `kinegrade("grade", "--course", folder)`; gives code, out and err."""
    return Kinegrade(monkeypatch, capsys)
