"""A student's own check tells what the sheet's mode allows, and never a reference value."""

import json
import re
import shutil
from collections import defaultdict

import numpy as np
import pytest
from answers import EXERCISES, SLUGS, answer_code, flat, part_of, telling, variant_of, wrong_code
from courses import BUNDLED, handed_out, make_course, notebook
from kinegrade.course.commands.demo import fill_in
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.settings.config import CourseError
from kinegrade.course.sheet.given import printed
from kinegrade.course.sheet.handout import read_handout
from kinegrade.course.student.check import _told, check_file
from kinegrade.course.student.not_printed import unseen_parts, with_samples
from kinegrade.exercises.exercise import Choice, ExerciseError, Function, references
from kinegrade.grader.marking.own_work import Remark
from kinegrade.grader.marking.verdict import Finding, Verdict, not_graded

MODES = ("practice", "graded", "exam")


SEED = 5  # other numbers than those that stand in for hidden ones


def about(mode, *slugs):
    numbers = {slug: printed(EXERCISES[slug], variant_of(slug, SEED)) for slug in slugs or ("rrt",)}
    return {
        "sheet": "one",
        "student": "ada",
        "mode": mode,
        "exercises": list(numbers),
        "numbers": numbers,
    }


def solved(
    mode,
    spoil=lambda _, answer: answer,
    slugs=("rrt",),
    code=lambda part, answer, _: answer_code(part, answer),
):
    """The bytes of a notebook that answers everything; `spoil` changes answers, `code` writes them."""
    cells = []
    for slug in slugs:
        exercise, v = EXERCISES[slug], variant_of(slug, SEED)
        answers = references(exercise, v)
        cells += [
            code(part, spoil(part.variable, answers[part.variable]), v) for part in exercise.asked
        ]
    return notebook("import numpy as np", *cells, about=about(mode, *slugs))


def checked(tmp_path, data, **options):
    path = tmp_path / options.pop("name", "one.ipynb")
    path.write_bytes(data)
    return check_file(path, **options)


def negated(name):
    """A spoiler of one answer."""
    return lambda variable, answer: -answer if variable == name else answer


@pytest.mark.parametrize("mode", MODES)
def test_right_answers_are_fine_in_every_mode(tmp_path, mode):
    handout, found = checked(tmp_path, solved(mode, slugs=BUNDLED))
    assert (handout.sheet, handout.mode) == ("one", mode)
    assert [remark.part for remark in found] == [
        part.variable for slug in BUNDLED for part in EXERCISES[slug].asked
    ]
    assert all(remark.ok for remark in found)


@pytest.mark.parametrize(
    ("mode", "ok", "words"),
    [
        ("practice", False, "partly correct: Every sign is reversed."),
        ("graded", False, "can be read, but does not follow from your own"),
        ("exam", True, "can be read"),
    ],
)
def test_a_wrong_answer_is_told_as_the_mode_allows(tmp_path, mode, ok, words):
    found = {remark.part: remark for remark in checked(tmp_path, solved(mode, negated("rrt_J")))[1]}
    wrong = found.pop("rrt_J")
    assert wrong.ok is ok
    assert words in wrong.text
    assert all(remark.ok for remark in found.values())


def test_a_graded_sheet_does_not_tell_whether_answers_are_right(tmp_path):
    """All of it is wrong, and each follows from the one before."""
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis", SEED)
    given = {
        "three_axis_p": references(exercise, v)["three_axis_p"] + 0.25,
        "three_axis_z": -np.eye(3),
    }
    for part in exercise.parts:
        if part.variable not in given:
            given[part.variable] = part.solve(v, given)
    cells = [answer_code(part, given[part.variable]) for part in exercise.asked]
    _, found = checked(
        tmp_path, notebook("import numpy as np", *cells, about=about("graded", "three_axis"))
    )
    assert all(remark.ok for remark in found)
    assert all(
        re.fullmatch(r"can be read( and follows from your own .*)?", remark.text)
        for remark in found
    )


@pytest.mark.parametrize("mode", MODES)
def test_no_reference_value_is_ever_told(tmp_path, mode):
    """On one sheet of everything, every answer of which is wrong."""
    _, found = checked(tmp_path, solved(mode, slugs=SLUGS, code=wrong_code))
    texts = {remark.part: remark.text for remark in found}
    told = []
    for exercise in EXERCISES.values():
        v = variant_of(exercise.slug, SEED)
        answers = references(exercise, v)
        for part in exercise.asked:
            said, secrets = texts[part.variable], telling(part, answers[part.variable], v)
            assert said
            told += [(part.variable, text) for text in secrets if text in said]
    assert told == []


def test_what_is_private_is_not_told_either():
    verdict = Verdict(
        "rrt_J", "partly", 1.0, 4, (Finding("open"), Finding("like ben's", private=True)), "as read"
    )
    told = _told(verdict)
    assert (told.ok, told.text) == (False, "partly correct: as read open")
    assert _told(not_graded("rrt_J", 4, "It waits.")) == Remark(
        "rrt_J", ok=True, text="not graded yet: It waits."
    )


@pytest.mark.parametrize("mode", MODES)
def test_what_cannot_be_read_is_told_in_every_mode(tmp_path, mode):
    words = {
        "rrt_dh = [['q1']]": "rows of theta, d, a, alpha",
        "rrt_T = 'x'": "got text: x",
        "rrt_J = {1: 2}": "a dict",
        "rrt_det = 'sin(q2'": "\n",  # the line that was typed, with a caret
        "rrt_singular = [1, 2]": "akes a list of conditions",
        "inverse_velocities_solutions = 'no idea'": "akes one of the letters",
        "inverse_velocities_elbow = 'x'": "akes",
        "implement_it_jacobian = 'x'": "akes a function",
    }
    _, found = checked(
        tmp_path, notebook(*words, about=about(mode, "rrt", "inverse_velocities", "implement_it"))
    )
    told = {remark.part: remark for remark in found}
    for cell, text in words.items():
        remark = told[cell.split()[0]]
        assert not remark.ok
        assert text in remark.text


@pytest.mark.parametrize("mode", MODES)
def test_an_empty_sheet_is_told_so(tmp_path, mode):
    _, found = checked(tmp_path, notebook("rrt_J = ...", about=about(mode)))
    assert [(remark.part, remark.ok, remark.text) for remark in found] == [
        (part.variable, False, "not answered") for part in EXERCISES["rrt"].asked
    ]


def test_a_file_of_matrices_is_checked_with_the_sheet_as_it_was_handed_out(tmp_path):
    sheet = tmp_path / "sheet.ipynb"
    sheet.write_bytes(notebook(about=about("practice")))
    answers = references(EXERCISES["rrt"], variant_of("rrt", SEED))
    data = {"rrt_J": answers["rrt_J"].tolist(), "rrt_T": answers["rrt_T"].tolist()}
    _, found = checked(tmp_path, json.dumps(data).encode(), name="mine.json", sheet=sheet)
    assert {remark.part for remark in found if remark.ok} == set(data)


HIDING = [exercise for exercise in EXERCISES.values() if exercise.hidden]


def hiding_function():
    """An exercise whose function is called on hidden numbers, its part, and a variant."""
    exercise = EXERCISES["implement_it"]
    return exercise, part_of(exercise, "implement_it_jacobian"), variant_of("implement_it", SEED)


def test_numbers_that_stand_in_for_hidden_ones_are_those_of_another_draw():
    exercise, _, v = hiding_function()
    completed = with_samples(exercise, printed(exercise, v))
    assert set(completed) == set(v)
    for name in v:
        assert (completed[name] == v[name]) is (name not in exercise.hidden)
    assert with_samples(exercise, v) == v  # what a sheet says comes first
    plain = EXERCISES["rrt"]
    assert with_samples(plain, {"d1": 1.0}) == {"d1": 1.0}


@pytest.mark.parametrize("exercise", HIDING, ids=lambda exercise: exercise.slug)
def test_hidden_numbers_stand_nowhere_in_what_is_handed_out(tmp_path, exercise):
    course = handed_out(
        make_course(
            tmp_path, exercises=[exercise.slug], students=[("ada", "Ada")], more="matlab = true\n"
        )
    )
    released = course.folder / "released" / "ada"
    handout = read_handout(released / "one.ipynb")
    texts = [
        re.sub(r"data:image/[^\"]+", "", path.read_text(encoding="utf-8"))
        for path in sorted(released.iterdir())
    ]
    assert len(texts) == 2  # the notebook and the script
    v = drawn(course, exercise.slug)
    hidden = {repr(abs(x)) for name in exercise.hidden for x in flat(v[name])}
    open_ = {repr(abs(x)) for x in flat(printed(exercise, v))}
    telling = {text for text in hidden - open_ if len(text) > 4}
    assert len(telling) >= TELLING[exercise.slug]
    assert not set(handout.numbers[exercise.slug]) & set(exercise.hidden)
    for text in texts:
        assert not open_ or set(re.findall(r"\d+\.\d+", text)) & open_
        assert not set(re.findall(r"\d+\.\d+", text)) & telling


TELLING = {
    "implement_it": 20, "pseudoinverse": 3, "prismatic_columns": 0, "articulated_derivatives": 0,
}  # fmt: skip


def test_every_number_of_the_metadata_is_printed(bundled_course):
    """In the cells that set the numbers, or in the line that says the form."""
    path = bundled_course.folder / "released" / "ada" / "one.ipynb"
    notebook = json.loads(path.read_text(encoding="utf-8"))
    text = "".join("".join(cell["source"]) for cell in notebook["cells"])
    shown = re.sub(r"data:image/[^\"]+", "", text)
    numbers = notebook["metadata"]["kinegrade"]["numbers"]
    assert set(numbers) == set(BUNDLED)
    for slug, values in numbers.items():
        for name, value in values.items():
            if name in EXERCISES[slug].structure:
                plain = re.sub(r"[\[\]']", "", str(value))
                assert f"`{name} {plain}`" in shown
                continue
            assert f"{slug}_{name} = " in shown
            for x in flat(value):
                assert repr(x) in shown


def test_no_choice_follows_from_the_number_of_a_form(exercise):
    """Draws of one form differ in the answer, unless all draws have the same."""
    draws = [variant_of(exercise.slug, seed) for seed in range(40)]
    for part in exercise.asked:
        if not isinstance(part.answer, Choice):
            continue
        letters = [references(exercise, v)[part.variable] for v in draws]
        for name in exercise.structure:
            if isinstance(draws[0][name], list) or len(set(letters)) == 1:
                continue
            by_form = defaultdict(set)
            for v, letter in zip(draws, letters, strict=True):
                by_form[v[name]].add(letter)
            assert any(len(found) > 1 for found in by_form.values())


UNSEEN = {
    "articulated_derivatives": {"articulated_derivatives_point"},
    "prismatic_columns": {"prismatic_columns_why", "prismatic_columns_units"},
}


def test_a_part_that_hangs_on_words_of_the_sheet_is_not_judged_by_others(exercise):
    v = variant_of(exercise.slug)
    assert unseen_parts(exercise, printed(exercise, v)) == UNSEEN.get(exercise.slug, set())
    assert unseen_parts(exercise, v) == set()  # an older sheet has them all


@pytest.mark.parametrize("letter", "abcd")
@pytest.mark.parametrize("mode", MODES)
def test_such_a_part_is_read_and_no_more(tmp_path, mode, letter):
    data = solved(
        mode,
        lambda name, answer: letter if name == "prismatic_columns_why" else answer,
        slugs=("prismatic_columns",),
    )
    remarks = {remark.part: remark for remark in checked(tmp_path, data)[1]}
    remark = remarks["prismatic_columns_why"]
    assert (remark.ok, remark.text.startswith("can be read; whether it is right hangs on")) == (
        True,
        True,
    )


def drawn(course, slug):
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        (record,) = (record for record in gradebook.records("one") if record.exercise == slug)
    return record.numbers


@pytest.mark.parametrize(
    ("mode", "said"), [*zip(MODES, ("correct", "can be read", "can be read"), strict=True)]
)
def test_a_function_is_checked_without_the_hidden_numbers(tmp_path, mode, said):
    exercise, part, _ = hiding_function()
    right, by_hand = checked(tmp_path, solved(mode, slugs=(exercise.slug,)))[1]
    assert (right.part, right.ok) == (part.variable, True)
    assert right.text.startswith(said)
    assert by_hand.ok
    assert "marked by hand" in by_hand.text
    nothing = part.answer.blank(part.variable)
    found, *_ = checked(
        tmp_path, notebook("import numpy as np", nothing, about=about(mode, exercise.slug))
    )[1]
    assert (found.ok, "not answered" in found.text) == (False, True)


def test_a_wrong_function_is_told_in_practice_group_by_group(tmp_path):
    exercise, *_ = hiding_function()
    found, *_ = checked(tmp_path, solved("practice", slugs=(exercise.slug,), code=wrong_code))[1]
    assert not found.ok
    assert all(f"{name}: 0 of " in found.text for name in exercise.hidden)


def test_published_results_are_checked_with_the_sheets_own_numbers(tmp_path):
    exercise, part, v = hiding_function()
    assert isinstance(part.answer, Function)
    assert part.answer.published
    sheet = tmp_path / "sheet.ipynb"
    sheet.write_bytes(notebook(about=about("practice", exercise.slug)))
    function = references(exercise, v)[part.variable]
    results = [
        function(*call).tolist() for group in part.answer.published(v).values() for call in group
    ]
    for changed, ok in ((results, True), (results[::-1], False)):
        data = json.dumps({part.variable: changed}).encode()
        found, *_ = checked(tmp_path, data, name="mine.json", sheet=sheet)[1]
        assert (found.part, found.ok) == (part.variable, ok)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"[]",
        b"\xff\xfe",
        b"{",
        notebook("x = 1"),
        notebook(about={"mode": "graded"}),
        b'{"metadata": 5}',
        b"[" * 100_000,
    ],
)
def test_a_file_that_does_not_say_its_sheet_gets_told_what_to_do(tmp_path, data):
    with pytest.raises(
        CourseError, match=r"does not say which sheet it belongs to .* --sheet HANDED_OUT.ipynb"
    ):
        checked(tmp_path, data)


@pytest.mark.parametrize(
    "change",
    [{"mode": "open"}, {"numbers": [1]}, {"numbers": {"rrt": 1}}, {"exercises": 3}, {"mode": []}],
)
def test_damaged_metadata_are_refused(tmp_path, change):
    with pytest.raises(CourseError, match="does not say which sheet"):
        checked(tmp_path, notebook("x = 1", about=about("graded") | change))


@pytest.mark.parametrize("v", [{}, {"q": []}, {"q": "x"}, {"q": [0.1, 0.2, 0.3]}, {"q": None}])
def test_damaged_numbers_are_named(tmp_path, v):
    data = json.loads(solved("practice"))
    data["metadata"]["kinegrade"]["numbers"]["rrt"] = v
    with pytest.raises(
        CourseError, match=r"one.ipynb: the numbers of rrt in this sheet are damaged"
    ):
        checked(tmp_path, json.dumps(data).encode())


def test_an_exercise_that_is_not_installed_is_named(tmp_path):
    data = json.loads(solved("practice"))
    about = data["metadata"]["kinegrade"]
    about |= {"exercises": ["rtt", *about["exercises"]], "numbers": {"rtt": {}, **about["numbers"]}}
    _, (first, *others) = checked(tmp_path, json.dumps(data).encode())
    assert (first.part, first.ok) == ("rtt", True)
    assert "not installed here" in first.text
    assert others
    about |= {"exercises": ["rtt"]}
    with pytest.raises(CourseError, match="none of its exercises is installed here: rtt"):
        checked(tmp_path, json.dumps(data).encode())


@pytest.fixture
def practice(tmp_path, monkeypatch):
    """A released practice sheet with the course's own exercise, in a folder of the student's, and the exercise file."""
    course = handed_out(make_course(tmp_path / "course", mode="practice"))
    home = tmp_path / "home"
    home.mkdir()
    monkeypatch.chdir(home)
    content = fill_in(
        (course.folder / "released" / "ada" / "one.ipynb").read_bytes(),
        {"lever_p": "lever_p = [9, 9]"},
    )
    (home / "one.ipynb").write_bytes(content)
    return home / "one.ipynb", course.folder / "exercises"


def told(found):
    return [(remark.part, remark.text.partition(":")[0]) for remark in found]


LEVER_TOLD = [("lever_p", "incorrect"), ("lever_J", "not answered")]


@pytest.mark.parametrize("where", ["beside the notebook", "in this folder", "named"])
def test_a_courses_own_exercise_is_checked_where_the_student_has_its_file(
    practice, tmp_path, monkeypatch, where
):
    path, exercises = practice
    if where == "named":
        assert told(check_file(path, None, exercises)[1]) == LEVER_TOLD
        return
    if where == "in this folder":
        (tmp_path / "elsewhere").mkdir()
        monkeypatch.chdir(tmp_path / "elsewhere")
    shutil.copytree(
        exercises,
        (path.parent if where == "beside the notebook" else tmp_path / "elsewhere") / "exercises",
    )
    assert told(check_file(path)[1]) == LEVER_TOLD


def test_without_the_file_it_says_where_it_looked(practice, tmp_path):
    path, _ = practice
    with pytest.raises(
        CourseError, match=r"none of its exercises is installed here: lever; nor is there a folder"
    ):
        check_file(path)
    (path.parent / "exercises").mkdir()
    with pytest.raises(
        CourseError, match=r"lever; nor in .*exercises \(--exercises DIR, if you were given"
    ):
        check_file(path)
    with pytest.raises(CourseError, match=r"nowhere is no folder; --exercises takes the one with"):
        check_file(path, None, tmp_path / "nowhere")


def test_a_file_of_the_course_that_cannot_be_run_is_named(practice):
    path, exercises = practice
    (exercises / "lever.py").write_text("EXERCISE = 1 / 0\n", encoding="utf-8")
    with pytest.raises(
        ExerciseError, match=r"lever.py: the exercise file stopped with ZeroDivisionError"
    ):
        check_file(path, None, exercises)


@pytest.mark.parametrize("inside", [False, True])
def test_an_exercise_file_that_was_handed_in_is_not_run(practice, tmp_path, monkeypatch, inside):
    path, exercises = practice
    theirs = tmp_path / "course" / "submitted" / "ada"
    (theirs / "exercises").mkdir(parents=True)
    (theirs / "exercises" / "lever.py").write_text(
        "raise RuntimeError('hostile')\nEXERCISE = 1\n", encoding="utf-8"
    )
    shutil.copy(path, theirs / "one.ipynb")
    monkeypatch.chdir(theirs if inside else exercises.parent)
    if inside:
        with pytest.raises(CourseError, match="none of its exercises is installed here"):
            check_file(theirs / "one.ipynb")
    else:  # the course's own file is found in the folder one is in
        assert told(check_file(theirs / "one.ipynb")[1]) == LEVER_TOLD


def test_the_command_takes_a_folder_of_exercises(practice, kinegrade):
    path, exercises = practice
    ran = kinegrade("check", path, "--exercises", exercises)
    assert (ran.code, ran.out.splitlines()[0].split(":")[0].split()) == (
        1,
        ["✗", "lever_p", "incorrect"],
    )


def test_files_that_cannot_be_read_are_named(tmp_path):
    with pytest.raises(CourseError, match=r"nowhere.ipynb cannot be read: No such file"):
        check_file(tmp_path / "nowhere.ipynb")
    with pytest.raises(CourseError, match=r"gone.ipynb cannot be read: No such file"):
        checked(tmp_path, solved("graded"), sheet=tmp_path / "gone.ipynb")
    with pytest.raises(
        CourseError,
        match=r"one.docx: a submission takes one of the endings .ipynb, .py, .json, .csv",
    ):
        checked(tmp_path, b"PK", name="one.docx")


def test_the_sheet_as_released_says_what_it_is(bundled_course):
    handout = read_handout(bundled_course.folder / "released" / "ada" / "one.ipynb")
    assert (handout.sheet, handout.mode, tuple(handout.numbers)) == ("one", "graded", BUNDLED)


def test_what_follows_from_a_wrong_answer_has_nothing_to_mend(tmp_path):
    exercise, v = EXERCISES["puma_velocities"], variant_of("puma_velocities", SEED)
    given = references(exercise, v)
    given["puma_velocities_J"] = np.negative(given["puma_velocities_J"])
    for part in exercise.parts:
        if part.needs:
            given[part.variable] = part.solve(v, given)
    cells = [answer_code(part, given[part.variable]) for part in exercise.asked]
    sheet = notebook("import numpy as np", *cells, about=about("practice", "puma_velocities"))
    wrong, *later = checked(tmp_path, sheet)[1]
    assert not wrong.ok
    assert all(remark.ok for remark in later)
    assert all(remark.text.startswith("right from your own answers") for remark in later)
