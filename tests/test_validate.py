"""Validating exercises: a sound one passes, and every way of being broken is found, named and counted."""

import json

import pytest
from courses import LEVER, make_course
from kinegrade.course.proof import validate as proof
from kinegrade.course.proof.validate import (
    KINDS,
    Validation,
    chosen,
    summary,
    validate,
    validate_file,
)
from kinegrade.exercises.files.finding import exercise_files

CHANGES = {
    "solve": ("x, y = given", "x, y, z = given"),
    "full marks": (
        "def tip(v, _):",
        "def tip(v, _, n=[0]):\n    n[0] += 1\n    v = {**v, 'L': v['L'] + n[0]}",
    ),
    "nonsense": ("return np.array([-y, x])", "return np.array([0.0, 0.0])"),
    "mistakes": (
        'needs=("lever_p",))',
        'needs=("lever_p",), mistakes=(Mistake("The same.", column),))',
    ),
    "printable": ('return v["L"] *', 'return 1e7 * v["L"] *'),
    "render": ('"Its Jacobian"', '"Its Jacobian $J"'),
    "solution": (
        'Part("lever_p",',
        """Part("lever_f", "f", 1, Function("(x)", lambda v: {"g": [(v["L"],)]}), lambda *_: lambda x: x + 1),
        Part("lever_p",""",
    ),
    "variants": ("rng.integers(200, 1300)", "rng.integers(200, 204) + 0 * rng.integers(3)"),
    "guessing": (
        'Part("lever_p",',
        """Part("lever_c", "the same for all", 1, Numbers((), "m"), lambda v, _: 0.25),
        Part("lever_p",""",
    ),
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
        path.write_text(
            path.read_text(encoding="utf-8").replace("rng.integers(40, 121)", "80"),
            encoding="utf-8",
        )
    found = validate_file(path, 25)
    assert kind in {failure.kind for failure in found.failures}
    assert any(line.startswith(kind) for line in summary(found))


@pytest.mark.parametrize(
    ("drawn", "words"),
    [
        ('"tuple": (1, 2), ', "change on their way through JSON: tuple is a tuple; write a list"),
        ('"x": float("nan"), ', "change on their way through JSON: x is not a number"),
        ('"x": {1: 2}, ', "change on their way through JSON: x has the key 1; write text for it"),
        (
            '"x": np.ones(2), ',
            "draw gives what JSON cannot hold: x is a numpy array; write x.tolist()",
        ),
        ('"x": [[rng.integers(9)]], ', "x[0][0] is a numpy int64; write int(x[0][0])"),
        ('"x": np.float32(rng.random()), ', "x is a numpy float32; write float(x)"),
        ('"x": {"a": np.bool_(True)}, ', "x['a'] is a numpy bool; write bool(x['a'])"),
        ('"x": {1, 2}, ', "x is of type set; write numbers, text, lists and dicts"),
        (
            '"x": np.random.rand(), ',
            "draw gives other numbers from an equal generator; take every random number from",
        ),
        (
            '"x": np.random.default_rng().random(), ',
            "take every random number from the rng that it is called with",
        ),
        (
            '"x": 1 / 0, ',
            "draw stopped with ZeroDivisionError: division by zero (line 20 of lever.py)",
        ),
    ],
)
def test_a_draw_that_is_not_plain_numbers_of_its_generator_is_told_what_to_write(
    tmp_path, drawn, words
):
    found = validate_file(lever_file(tmp_path, '"q": [float(', f'{drawn}"q": [float('), 2)
    (line,) = summary(found)
    assert line.startswith("solve, in 2 of 2 draws, first 0: exercise lever: ")
    assert words in line
    assert "\n" not in line


def test_numpy_floats_and_equal_draws_are_plain_enough(tmp_path):
    assert validate_file(lever_file(tmp_path, '"L": float(', '"L": np.float64('), 3).failures == ()


def test_a_draw_that_is_no_dict_is_told_so(tmp_path):
    path = lever_file(tmp_path, "draw=lambda rng: {", "draw=lambda rng: [1] if rng.random() else {")
    assert "draw takes a dict of names and numbers" in next(summary(validate_file(path, 1)))
    assert "got list" in next(summary(validate_file(path, 1)))


@pytest.mark.parametrize("worth", [0, 100])
def test_side_by_side_gives_the_same_as_one_by_one(tmp_path, monkeypatch, worth):
    monkeypatch.setattr(proof, "WORTH", worth)
    path = lever_file(tmp_path, *CHANGES["nonsense"])
    steps = []
    (together,) = validate([path], 45, steps.append)
    alone = validate_file(path, 45)
    assert together.failures == alone.failures
    assert together.draws == alone.draws == 45
    assert sum(steps) == 45


def test_one_exercise_that_is_quick_starts_no_other_process(tmp_path, monkeypatch):
    monkeypatch.setattr(proof, "ProcessPoolExecutor", lambda *_, **__: pytest.fail("started"))
    (found,) = validate([lever_file(tmp_path)], 20)
    assert (found.draws, found.failures) == (20, ())
    monkeypatch.setattr(proof, "WORTH", 0)
    with pytest.raises(pytest.fail.Exception, match="started"):
        validate([lever_file(tmp_path)], 20)


def test_all_cores_get_about_the_same(monkeypatch):
    monkeypatch.setattr(proof, "_cores", lambda: 2)
    shares = []
    monkeypatch.setattr(
        proof, "_side_by_side", lambda chunks: shares.extend(chunks) or map(proof._look_in, chunks)
    )
    monkeypatch.setattr(
        proof, "_look_at", lambda _, seeds: (Validation("x", 1, 1, len(seeds), 0.0, ()), [*seeds])
    )
    monkeypatch.setattr(proof, "WORTH", -1)
    (found,) = validate(["x"], 20)
    assert [(chunk.start, chunk.stop) for _, chunk in shares] == [(4, 12), (12, 20)]
    assert (found.draws, found.failures) == (20, ())


def complaints(ran):
    return [line for line in ran.out.splitlines() if line.startswith("✗")]


def test_the_command_prints_a_table_and_exits_by_what_it_found(tmp_path, kinegrade):
    folder = make_course(tmp_path / "course")
    good = kinegrade("validate", "lever", "--course", folder, "--draws", 3)
    assert (good.code, "1 of 1 exercises are valid" in good.err) == (0, True)
    assert "lever" in good.out
    assert " made for tests" in good.out
    assert "numbers that matter for no part" in good.out
    lever_file(folder / "exercises", *CHANGES["nonsense"])
    bad = kinegrade("validate", "lever", "--course", folder, "--draws", 3)
    assert bad.code == 1
    assert "✗ lever: nonsense, lever_J, in 3 of 3 draws, first 0: zeros earns 3.0 of 3" in bad.out
    before = kinegrade(
        "validate", "lever", "--course", folder, "--seeds", 3
    )  # as the option was called
    assert complaints(before) == complaints(bad) != []
    data = json.loads(
        kinegrade("validate", "lever", "--course", folder, "--draws", 3, "--json").out
    )
    assert data[0]["failures"][0]["kind"] == "nonsense"
    assert data[0]["source"] == "made for tests"


def test_a_file_that_cannot_be_loaded_is_a_failure_and_stops_no_other(tmp_path):
    (tmp_path / "broken.py").write_text("EXERCISE = 1 / 0\n", encoding="utf-8")
    broken, sound = validate([tmp_path / "broken.py", lever_file(tmp_path)], 2)
    assert "stopped with ZeroDivisionError" in broken.failures[0].sentence
    assert sound.failures == ()


def test_a_file_that_cannot_be_loaded_is_told_once_and_without_a_count(tmp_path):
    (tmp_path / "broken.py").write_text("EXERCISE = 1 / 0\n", encoding="utf-8")
    for found in (
        validate([tmp_path / "broken.py"], 50)[0],
        validate([tmp_path / "broken.py"] * 2, 50)[0],
    ):
        (line,) = summary(found)
        assert line.startswith(
            f"solve: {tmp_path / 'broken.py'}: the exercise file stopped with ZeroDivisionError"
        )


CHECK = "def judged(v, given, value):\n    return value['x']\n\n\nEXERCISE = "


def test_an_exception_in_a_check_is_one_line_with_a_count_and_no_traceback(
    tmp_path, kinegrade, monkeypatch
):
    folder = make_course(tmp_path / "course")
    path = lever_file(folder / "exercises", "EXERCISE = ", CHECK)
    text = path.read_text(encoding="utf-8")
    path.write_text(
        text.replace('needs=("lever_p",))', 'needs=("lever_p",), check=judged)'), encoding="utf-8"
    )
    ran = kinegrade("validate", "lever", "--course", folder, "--draws", 20)
    lines = complaints(ran)
    assert ran.code == 1
    assert len(lines) == 1  # and not once more for every kind of proof that it spoils
    place = path.read_text(encoding="utf-8").partition("value['x']")[0].count("\n") + 1
    for line in lines:
        assert "lever_J, in 20 of 20 draws, first 0: marking stopped with IndexError: " in line
        assert line.endswith(f"(line {place} of lever.py)")
    assert "Traceback" not in ran.out + ran.err
    assert [line for line in ran.err.splitlines() if line.strip()] == [
        "0 of 1 exercises are valid."
    ]
    monkeypatch.setenv("KINEGRADE_DEBUG", "1")
    assert "Traceback" in kinegrade("validate", "lever", "--course", folder, "--draws", 1).err


@pytest.mark.parametrize("worth", [0, 100])
def test_nor_does_one_reach_the_terminal_from_another_process(tmp_path, capfd, monkeypatch, worth):
    monkeypatch.setattr(proof, "WORTH", worth)
    path = lever_file(tmp_path, "EXERCISE = ", CHECK)
    path.write_text(
        path.read_text(encoding="utf-8").replace(
            'needs=("lever_p",))', 'needs=("lever_p",), check=judged)'
        ),
        encoding="utf-8",
    )
    validate([path], 24)
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize(
    ("explain", "words"),
    [
        (
            '"Differentiate."',
            "explain of lever_J takes a function that returns steps, such as explain=lambda v, given:",
        ),
        ('lambda v, given: "Differentiate."', "got text"),
        ('lambda v, given: ["Differentiate."]', "got list"),
        ("lambda v, given: 1 / 0", "it stopped with ZeroDivisionError: division by zero (line "),
    ],
)
def test_text_for_explain_is_told_what_to_write(tmp_path, explain, words):
    path = lever_file(tmp_path, 'needs=("lever_p",))', f'needs=("lever_p",), explain={explain})')
    (line,) = summary(validate_file(path, 3))
    assert line.startswith("render, in 3 of 3 draws, first 0: ")
    assert words in line


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        ('"Its Jacobian"', 'r"Its Jacobian $\\foo J$"', "lever_J"),
        ('"A lever."', 'r"A lever $\\foo J$."', ""),
    ],
)
def test_an_unknown_command_of_latex_is_named_with_its_part(tmp_path, old, new, where):
    found = validate_file(lever_file(tmp_path, old, new), 3)
    failures = {(one.kind, one.part, one.sentence) for one in found.failures}
    assert ("render", where, r"the command \foo in $\foo J$ is unknown") in failures


def test_markup_that_cannot_be_set_is_found(tmp_path):
    found = validate_file(lever_file(tmp_path, '"A lever."', '"# A lever"'), 3)
    assert any("no paragraph, list or table" in one.sentence for one in found.failures)


def test_without_names_a_course_validates_what_it_uses_and_elsewhere_all_there_is(tmp_path):
    folder = make_course(tmp_path / "course", exercises=("lever", "planar_2r"))
    (folder / "exercises" / "spare.py").write_text(
        LEVER.replace("lever", "spare"), encoding="utf-8"
    )
    (folder / "exercises" / "arms.py").write_text("scale = 1\n", encoding="utf-8")
    assert [path.stem for path in chosen((), folder)] == ["lever", "planar_2r", "spare"]
    assert len(chosen((), tmp_path)) == len(exercise_files())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ("gone.py",),
            "gone.py is not there; validate takes names of exercises, and files that end in .py",
        ),
        (
            ("lever", "-c", "nowhere"),
            "nowhere is no folder; --course takes the one with the course.toml",
        ),
    ],
)
def test_what_is_not_there_is_one_sentence(kinegrade, arguments, words):
    ran = kinegrade("validate", *arguments)
    assert (ran.code, ran.err) == (1, f"kinegrade: {words}\n")


def test_an_exercise_that_is_named_twice_is_validated_once(tmp_path):
    folder = make_course(tmp_path)
    assert [path.stem for path in chosen(("lever", "lever"), folder)] == ["lever"]


def test_a_file_that_is_no_python_is_told_so(tmp_path, kinegrade):
    path = tmp_path / "course.toml"
    path.touch()
    assert "course.toml: an exercise file takes the ending .py" in kinegrade("validate", path).out


def test_a_file_without_an_exercise_is_told_so(tmp_path, kinegrade):
    folder = make_course(tmp_path / "course")
    (folder / "exercises" / "arms.py").write_text("scale = 1\n", encoding="utf-8")
    assert "arms.py defines no exercise" in kinegrade("validate", "arms", "--course", folder).err
    ran = kinegrade("validate", folder / "exercises" / "arms.py")
    assert "arms.py: an exercise file takes a top-level EXERCISE" in ran.out


def test_an_unknown_exercise_is_named(tmp_path, kinegrade):
    ran = kinegrade("validate", "levr", "--course", make_course(tmp_path / "course"))
    assert ran.code == 1
    assert "did you mean 'lever'" in ran.err


def test_a_file_may_be_named_wherever_it_lies(tmp_path, kinegrade):
    assert kinegrade("validate", lever_file(tmp_path), "--seeds", 2).code == 0


def test_a_name_that_no_draw_has_is_told(tmp_path):
    path = tmp_path / "named.py"
    path.write_text(
        '''"""A name in units that is never drawn."""
from kinegrade.exercises import questions as ask
from kinegrade.exercises.draws import posture
from kinegrade.exercises.part import exercise
from kinegrade.solutions.robots import ROBOTS

ARM = ROBOTS["planar_2r"]
EXERCISE = exercise(
    "named",
    title="T",
    source="S",
    robot=ARM,
    draw=lambda rng: posture(ARM, rng),
    units={"qdto": ["rad/s"] * 2},
    parts=[ask.jacobian(rows="task")],
)
''',
        encoding="utf-8",
    )
    (failure,) = validate_file(path, 12).failures
    assert (failure.kind, failure.sentence.split(",")[0]) == ("variants", "no draw has qdto")
    assert validate_file(path, 3).failures == ()
