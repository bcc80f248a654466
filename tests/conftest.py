"""Fixtures that several test files share."""

import os

import pytest
from answers import EXERCISES, SLUGS
from courses import BUNDLED, Kinegrade, handed_out, make_course
from hypothesis import settings

settings.register_profile(
    "steady", derandomize=True
)  # the same examples every time: red means a change of ours
settings.load_profile("steady")
os.environ.pop("KINEGRADE_SECRET", None)  # whoever runs the tests may have a course


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


@pytest.fixture
def class_of_three(tmp_path):
    """A course of three students with a drawn sheet of the exercise `lever`."""
    return handed_out(make_course(tmp_path / "course"))


@pytest.fixture
def kinegrade(monkeypatch, capsys):
    """Runs the command line as `kinegrade("grade", "--course", folder)`; gives code, out and err."""
    return Kinegrade(monkeypatch, capsys)
