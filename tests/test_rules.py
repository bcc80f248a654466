"""The hash of what marks follow from moves with all that marking imports, and nothing else."""

import ast
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from courses import LEVER
from kinegrade.course.grading import rules
from kinegrade.exercises import files as exercise_folder
from kinegrade.exercises.files import finding, loading, neighbours
from kinegrade.exercises.files.finding import exercise_files
from wheels import ROOT
from wheels import neighbours as dependencies

FILES = [path for package in rules.FOLLOWED for path in sorted((ROOT / package).rglob("*.py"))]
LOADED = """
import json, sys
import numpy as np
from answers import EXERCISES, right_raws, variant_of
from kinegrade.grader.marking.mark import mark
for slug, exercise in EXERCISES.items():
    mark(exercise, variant_of(slug), right_raws(exercise, variant_of(slug)))
print(json.dumps({name: module.__file__ for name, module in sys.modules.items() if name.startswith("kinegrade.")}))
"""
MOVED = """
import json, sys
from pathlib import Path
from kinegrade.course.grading.rules import ROOT, rules_hash
from kinegrade.exercises.files.finding import exercise_files
assert ROOT == Path(sys.argv[1]) / "kinegrade", ROOT
files = {"rrt": exercise_files()["rrt"], "lever": Path("lever.py"), "sharing": Path("sharing.py")}
found = {}
for name in sys.argv[2:]:
    before = {slug: rules_hash(path) for slug, path in files.items()}
    file = Path(name) if Path(name).exists() else ROOT / name
    file.write_bytes(file.read_bytes() + b"# changed\\n")
    found[name] = [slug for slug, path in files.items() if rules_hash(path) != before[slug]]
print(json.dumps(found))
"""
EVERYTHING = ["rrt", "lever", "sharing"]
MOVES = {
    "grader/marking/mark.py": EVERYTHING,
    "grader/marking/compare.py": EVERYTHING,
    "grader/inside/values.py": EVERYTHING,
    "grader/jail/walls.py": EVERYTHING,
    "grader/collecting/named_matrices.py": EVERYTHING,
    "course/sheet/submissions.py": EVERYTHING,
    "solutions/__init__.py": EVERYTHING,
    "exercises/kinds/numbers.py": EVERYTHING,
    "solutions/singularity.py": ["rrt", "sharing"],
    "exercises/catalogue/rrt.py": ["rrt"],
    "exercises/catalogue/planar_2r.py": [],
    "grader/figures/maps.py": [],
    "grader/figures/scene.py": [],
    "course/pages/page.py": [],
    "lever.py": ["lever"],
    "arms.py": ["sharing"],
    "alone.py": [],
}


def output(code, *arguments, **options):
    command = [sys.executable, *options.pop("flags", ()), "-c", code, *map(str, arguments)]
    return json.loads(
        subprocess.run(command, capture_output=True, text=True, check=True, **options).stdout
    )


def test_what_a_file_imports_moves_its_hash_wherever_package_and_course_lie(tmp_path):
    """As installed: the four packages in a folder kinegrade, and nothing of the checkout in sight."""
    course = tmp_path / "course"
    course.mkdir()
    for package in (*rules.FOLLOWED, "course"):
        shutil.copytree(ROOT / package, tmp_path / "kinegrade" / package)
    (course / "lever.py").write_text(LEVER, encoding="utf-8")
    (course / "sharing.py").write_text(
        LEVER.replace("import numpy", "import arms\nimport numpy"), encoding="utf-8"
    )
    (course / "arms.py").write_text(
        "from kinegrade.solutions import singularity\n", encoding="utf-8"
    )
    (course / "alone.py").write_text("", encoding="utf-8")
    path = os.pathsep.join([str(tmp_path), *dependencies()])
    options = {"cwd": course, "env": {**os.environ, "PYTHONPATH": path}, "flags": ("-S",)}
    assert output(MOVED, tmp_path, *MOVES, **options) == MOVES


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_every_import_of_a_module_of_ours_is_found(path):
    package = ["kinegrade", *path.relative_to(ROOT).parent.parts]
    found = {*rules.imports(path.read_bytes(), ".".join(package))}
    for node in ast.walk(ast.parse(path.read_bytes())):
        if isinstance(node, ast.Import):
            assert {alias.name for alias in node.names if "." in alias.name} <= found
        elif isinstance(node, ast.ImportFrom):
            start = package[: len(package) + 1 - node.level] if node.level else []
            inner = [*start, *(node.module or "").split(".")]
            name = ".".join(part for part in inner if part)
            assert {f"{name}.{alias.name}" for alias in node.names} <= found


@pytest.mark.parametrize(
    ("text", "names"),
    [
        (
            "from . import a, b",
            ["kinegrade.x", "kinegrade.x.y", "kinegrade.x.y.a", "kinegrade.x.y.b"],
        ),
        ("from ..z import (  # why\n    a as b,\n)\n", ["kinegrade.x.z.a"]),
        ("from ..z import \\\n    a", ["kinegrade.x.z.a"]),
        ("if True: import kinegrade.x.a; from .b import c", ["kinegrade.x.a", "kinegrade.x.y.b.c"]),
        (
            "def late():\r\n    import kinegrade.x.a as b, kinegrade.w\r\n",
            ["kinegrade.x.a", "kinegrade.w"],
        ),
        ("# a text in no encoding \xff\nimport kinegrade.x".encode("latin-1"), ["kinegrade.x"]),
    ],
)
def test_imports_are_found_however_they_are_written(text, names):
    assert {*names} <= {
        *rules.imports(text if isinstance(text, bytes) else text.encode(), "kinegrade.x.y")
    }


def reached():
    """Files in the hash of any exercise of ours."""
    names = [*map(rules._name, rules.MARKING)]
    for path in exercise_files().values():
        names += rules.imports(path.read_bytes(), "kinegrade.exercises.catalogue")
    known = rules._modules()
    return {known[name].relative_to(ROOT) for name in rules.reached(names)}


def test_all_that_is_loaded_to_mark_our_exercises_is_in_their_hashes():
    options = {
        "cwd": Path(__file__).parent,
        "env": {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    }
    files = [Path(file).resolve() for file in output(LOADED, **options).values() if file]
    loaded = {file.relative_to(ROOT) for file in files if file.is_relative_to(ROOT)}
    looking = {
        Path(module.__file__).resolve().relative_to(ROOT)
        for module in (exercise_folder, finding, loading, neighbours)
    }
    exercises = {path.relative_to(ROOT) for path in exercise_files().values()}
    others = loaded - reached() - looking - exercises
    assert sorted(str(file) for file in others if file.parts[0] != "course") == []


def test_figures_and_pages_are_in_no_hash():
    stems = {path.stem for path in reached()}
    assert stems & {"maps", "scene", "panels", "raster", "depth", "pages", "notebook"} == set()
    assert {"mark", "submissions", "start", "confine", "jacobian"} <= stems
