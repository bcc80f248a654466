"""An exercise file is loaded with the modules beside it, which are its own, and a stop names the line."""

import sys
import threading

import pytest
from kinegrade.exercises.exercise import ExerciseError
from kinegrade.exercises.files.finding import exercise_files, find, load
from kinegrade.exercises.files.loading import _package_of, stopped
from kinegrade.exercises.files.neighbours import HOME, read_source
from test_catalogue import GOOD

REACH = (
    GOOD.replace("own", "reach")
    .replace(
        "import numpy as np\n", "import numpy as np\nfrom arms import planar, scale as factor\n"
    )
    .replace('np.array([v["a"] ** 2])', "planar(v)")
)
ARMS = """
import numpy as np
from pathlib import Path
scale = 2
def planar(v):
    return np.array([scale * v["a"]])
"""


def course(folder, reach=REACH, **modules):
    folder.mkdir(exist_ok=True)
    (folder / "reach.py").write_text(reach, encoding="utf-8")
    for name, text in ({"arms": ARMS} | modules).items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    return folder / "reach.py"


def answer(path, a=1.0):
    (part,) = load(path).parts
    return float(part.solve({"a": a}, {})[0])


def test_a_module_beside_the_exercise_is_imported_as_an_editor_would(tmp_path):
    path = course(tmp_path)
    assert answer(path) == 2
    assert [*exercise_files(tmp_path)] == [*exercise_files(), "reach"]
    assert "arms" not in sys.modules
    assert [one.name for one in sorted(tmp_path.iterdir())] == [
        "arms.py",
        "reach.py",
    ]  # no compiled files beside them


def test_modules_of_the_same_name_in_two_courses_never_meet(tmp_path):
    one, two = (
        course(tmp_path / "one"),
        course(tmp_path / "two", arms=ARMS.replace("scale = 2", "scale = 3")),
    )
    assert (answer(one), answer(two), answer(one)) == (2, 3, 2)
    alike = course(tmp_path / "three")
    assert load(alike) is not load(one)  # it may read a file beside it


def test_a_changed_module_is_loaded_again_and_moves_the_hash(tmp_path):
    path = course(tmp_path)
    first, before = load(path), read_source(path).hash
    assert load(path) is first
    course(
        tmp_path, arms=ARMS.replace("scale = 2", "scale = 5")
    )  # as long as before, and in the same second
    assert answer(path) == 5
    assert read_source(path).hash != before
    course(tmp_path)
    assert read_source(path).hash == before
    assert load(path) is first


def test_a_module_that_is_not_imported_does_not_move_the_hash(tmp_path):
    path = course(tmp_path)
    before = read_source(path).hash
    course(tmp_path, notes="x = 1\n", reached="raise RuntimeError\n")
    assert read_source(path).hash == before


def test_without_modules_beside_it_the_hash_is_that_of_the_file(tmp_path):
    from hashlib import sha256

    path = tmp_path / "own.py"
    path.write_text(GOOD, encoding="utf-8")
    assert read_source(path).hash == sha256(GOOD.encode()).hexdigest()


def test_modules_may_import_each_other_also_in_a_circle_and_late(tmp_path):
    arms = "import shapes\nscale = 7\ndef planar(v):\n    from shapes import area\n    return area(v)\n"
    shapes = "import arms\nimport numpy as np\ndef area(v):\n    return np.array([arms.scale * v['a']])\n"
    path = course(tmp_path, arms=arms, shapes=shapes)
    before = read_source(path).hash
    assert answer(path) == 7
    course(tmp_path, arms=arms, shapes=shapes.replace("arms.scale", "-arms.scale"))
    assert answer(path) == -7
    assert read_source(path).hash != before


def test_what_a_function_imports_late_is_what_was_there_when_the_exercise_was_loaded(tmp_path):
    late = "def planar(v):\n    from shapes import area\n    return area(v)\nscale = 1\n"
    shapes = "import numpy as np\ndef area(v):\n    return np.array([3.0])\n"
    path = course(tmp_path, arms=late, shapes=shapes)
    (part,) = load(path).parts
    (tmp_path / "shapes.py").write_text(shapes.replace("3.0", "4.0"), encoding="utf-8")
    assert float(part.solve({"a": 1}, {})[0]) == 3
    assert answer(path) == 4


def test_a_module_named_like_one_of_the_library_is_found_beside_and_disturbs_nobody(tmp_path):
    import statistics

    text = REACH.replace("from arms import", "from statistics import")
    path = course(tmp_path, reach=text, statistics=ARMS)
    assert answer(path) == 2
    assert sys.modules["statistics"] is statistics


def test_many_threads_get_one_module(tmp_path):
    path = course(tmp_path, arms="import time\ntime.sleep(0.05)\n" + ARMS)
    found = []
    threads = [threading.Thread(target=lambda: found.append(load(path))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len({id(exercise) for exercise in found}) == 1
    assert len(found) == 4


@pytest.mark.parametrize(
    ("reach", "modules", "words"),
    [
        (REACH.replace("from arms", "from .arms"), {}, "a file beside it is imported without a dot: from arms import"),
        (REACH.replace("from arms", "from amrs"), {}, "'amrs' (line 3 of reach.py); did you mean 'arms'"),
        (REACH, {"arms": "EXERCISE = 1\n"}, "arms.py is an exercise, and what exercises share takes a file without"),
        (REACH, {"arms": "\n\n1 / 0\n"}, "stopped with ZeroDivisionError: division by zero (line 3 of arms.py)"),
        (REACH, {"arms": "def planar(:\n"}, "stopped with SyntaxError: invalid syntax (line 1 of arms.py)"),
        (REACH, {"arms": "scale = 1\n"}, "cannot import name 'planar'"),
        ("\nimport sys\nsys.exit(3)\nEXERCISE = 1\n", {}, "stopped with SystemExit: 3 (line 3 of reach.py)"),
        ("EXERCISE = (1,\n 2\n", {}, "stopped with SyntaxError: '(' was never closed (line 1 of reach.py)"),
        (REACH.replace("reach_area", "area"), {}, "starts with reach_, got 'area' (line "),
        (REACH.replace("EXERCISE =", "mine ="), {}, "EXERCISE = exercise(...); it calls its exercise 'mine'"),
        (REACH.rstrip() + ",\n", {}, "its EXERCISE is of type tuple"),
    ],
)  # fmt: skip
def test_a_file_that_cannot_be_used_says_why_and_in_which_line(tmp_path, reach, modules, words):
    path = course(tmp_path, reach, **modules)
    for _ in range(2):  # a failed load leaves nothing behind
        with pytest.raises(ExerciseError) as caught:
            load(path)
        assert words in str(caught.value)
        assert str(caught.value).startswith(f"{path}: ")
        assert "\n" not in str(caught.value)


def test_a_file_that_defines_no_exercise_is_named_where_a_sheet_asks_for_it(tmp_path):
    path = course(tmp_path)
    with pytest.raises(
        ExerciseError,
        match=r"arms.py defines no exercise: an exercise file takes a top-level EXERCISE",
    ):
        find("arms", exercise_files(tmp_path), path.parent)


def test_an_exception_is_one_line_with_its_place(tmp_path):
    path = course(
        tmp_path,
        arms=ARMS.replace("return", 'raise ValueError("two\\nlines" + 500 * "x")\n    return'),
    )
    with pytest.raises(ValueError, match="two") as caught:
        answer(path)
    said = stopped(caught.value)
    assert said.startswith("ValueError: two lines")
    assert said.endswith("x (line 6 of arms.py)")
    assert len(said) < 400
    assert stopped(KeyError()) == "KeyError"


def test_files_of_ours_keep_their_relative_imports_in_whatever_folder(tmp_path):
    assert _package_of(HOME / "rrt.py") == "kinegrade.exercises"
    assert _package_of(HOME / "catalogue" / "rrt.py") == "kinegrade.exercises.catalogue"
    assert _package_of(tmp_path / "rrt.py") == "kinegrade.exercises.catalogue"
