"""Validating exercises: a sound one passes, and every way of being broken is found, named and counted."""

import json
import subprocess
import sys

import pytest
from courses import LEVER, make_course
from kinegrade.course.validate import KINDS, summary, validate, validate_file

CHANGES = {
    "solve": ("x, y = given", "x, y, z = given"),
    "full marks": ("def tip(v, _):", "def tip(v, _, n=[0]):\n    n[0] += 1\n    v = {**v, 'L': v['L'] + n[0]}"),
    "nonsense": ("return np.array([-y, x])", "return np.array([0.0, 0.0])"),
    "mistakes": ('needs=("lever_p",))', 'needs=("lever_p",), mistakes=(Mistake("The same.", column),))'),
    "printable": ('return v["L"] *', 'return 1e7 * v["L"] *'),
    "render": ('"Its Jacobian"', '"Its Jacobian $J"'),
    "solution": (
        'Part("lever_p",',
        """Part("lever_f", "f", 1, Function("(x)", lambda v: {"g": [(v["L"],)]}), lambda *_: lambda x: x + 1),
        Part("lever_p",""",
    ),
    "variants": ("rng.integers(200, 1300)", "rng.integers(200, 204) + 0 * rng.integers(3)"),
}


def lever_file(folder, old="", new=""):
    text = LEVER.replace("Exercise, Numbers, Part", "Exercise, Function, Mistake, Numbers, Part")
    assert old in text
    path = folder / "lever.py"
    path.write_text(text.replace(old, new) if old else text, encoding="utf-8")
    return path


def test_a_sound_exercise_passes(tmp_path):
    found = validate_file(lever_file(tmp_path), 20)
    assert found.failures == ()
    assert (found.slug, found.parts, found.points, found.draws) == ("lever", 2, 5, 20)


@pytest.mark.parametrize("kind", KINDS)
def test_every_way_of_being_broken_is_found(tmp_path, kind):
    path = lever_file(tmp_path, *CHANGES[kind])
    if kind == "variants":
        path.write_text(path.read_text(encoding="utf-8").replace("rng.integers(40, 121)", "80"), encoding="utf-8")
    found = validate_file(path, 25)
    assert kind in {failure.kind for failure in found.failures}
    assert any(line.startswith(kind) for line in summary(found))


def test_a_draw_that_json_changes_is_found(tmp_path):
    found = validate_file(lever_file(tmp_path, '"q": [float(', '"tuple": (1, 2), "q": [float('), 2)
    assert "change on their way through JSON" in next(summary(found))


def test_side_by_side_gives_the_same_as_one_by_one(tmp_path):
    path = lever_file(tmp_path, *CHANGES["nonsense"])
    (together,) = validate([path], 45)
    alone = validate_file(path, 45)
    assert together.failures == alone.failures
    assert together.draws == alone.draws == 45


def test_the_command_prints_a_table_and_exits_by_what_it_found(tmp_path, kinegrade):
    folder = make_course(tmp_path / "course")
    good = kinegrade("validate", "lever", "--course", folder, "--seeds", 3)
    assert (good.code, "1 of 1 exercises are valid" in good.err) == (0, True)
    assert "lever" in good.out
    lever_file(folder / "exercises", *CHANGES["nonsense"])
    bad = kinegrade("validate", "lever", "--course", folder, "--seeds", 3)
    assert bad.code == 1
    assert "✗ lever: nonsense, lever_J, in 3 of 3 draws, first 0: zeros earns 3.0 of 3" in bad.out
    data = json.loads(kinegrade("validate", "lever", "--course", folder, "--seeds", 3, "--json").out)
    assert data[0]["failures"][0]["kind"] == "nonsense"


def test_a_file_that_cannot_be_loaded_is_a_failure_and_stops_no_other(tmp_path):
    (tmp_path / "broken.py").write_text("EXERCISE = 1 / 0\n", encoding="utf-8")
    broken, sound = validate([tmp_path / "broken.py", lever_file(tmp_path)], 2)
    assert "stopped with ZeroDivisionError" in broken.failures[0].sentence
    assert sound.failures == ()


def test_an_unknown_exercise_is_named(tmp_path, kinegrade):
    ran = kinegrade("validate", "levr", "--course", make_course(tmp_path / "course"))
    assert ran.code == 1
    assert "did you mean 'lever'" in ran.err


def test_a_file_may_be_named_wherever_it_lies(tmp_path, kinegrade):
    assert kinegrade("validate", lever_file(tmp_path), "--seeds", 2).code == 0


def test_plain_pytest_validates_the_exercises_of_a_course(tmp_path):
    folder = make_course(tmp_path / "course")
    (folder / "pytest.ini").write_text("[pytest]\nkinegrade_seeds = 3\n", encoding="utf-8")
    (folder / "exercises" / "notes.py").write_text("raise RuntimeError('no exercise is here')\n", encoding="utf-8")

    def run():
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "no:xdist"]
        return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)

    good = run()
    assert (good.returncode, "1 passed" in good.stdout) == (0, True), good.stdout
    lever_file(folder / "exercises", *CHANGES["nonsense"])
    bad = run()
    assert bad.returncode == 1
    assert "nonsense, lever_J, in 3 of 3 draws, first 0: zeros earns 3.0 of 3" in bad.stdout
    assert "Traceback" not in bad.stdout
