"""The unit of work: plain data in, plain data out, and nothing lost on the way."""

import logging
import math
import pickle

import numpy as np
import pytest
from courses import LEVER, notebook
from kinegrade.course.grading import task
from kinegrade.course.grading.check import Check, Checked
from kinegrade.course.grading.overheard import overheard, repeat
from kinegrade.course.grading.task import CHECK, MARK, packed, there, unpacked
from kinegrade.course.grading.values import from_text, to_text
from kinegrade.course.grading.work import Came, Done, Walls, Work, do
from kinegrade.course.variants.record import Record, fingerprint
from kinegrade.exercises.exercise import ExerciseError
from kinegrade.exercises.files import text as texts
from kinegrade.exercises.files.finding import exercise_files, load
from kinegrade.exercises.files.text import exercise_of, exercise_text
from kinegrade.grader.collecting.ask import Limits
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.jail.level import ANY, Level
from kinegrade.grader.marking.price import Price
from kinegrade.grader.marking.verdict import Finding, Verdict
from pydantic import ValidationError

V = {"L": 0.5, "q": [0.3]}
RIGHT = {"lever_p": [0.5 * math.cos(0.3), 0.5 * math.sin(0.3)]}


@pytest.fixture
def lever(tmp_path):
    path = tmp_path / "lever.py"
    path.write_text(LEVER, encoding="utf-8")
    return path


def work(path, data, name="one.json", **more):
    plain = {
        "student": "ada", "sheet": "one", "name": name, "data": data, "beside": {},
        "exercises": (exercise_text(path),), "numbers": (V,), "limits": Limits(), "price": Price(),
        "walls": Walls(ANY), "others": {}, "peers": {}, "adjustments": {},
    }  # fmt: skip
    return Work(**(plain | more))


def no_jail(_):
    pytest.fail("a file of matrices is run nowhere")


VALUES = {
    "numbers": Raw("num", np.array([[1.0, -0.0], [2.5, math.inf]]), "cell 3 stopped"),
    "one number": Raw("num", np.array(0.1)),
    "complex numbers": Raw("num", np.array([1 + 2j, 3])),
    "text": Raw("text", [["a", "b"], ["ç", "\ud800"]]),
    "nothing": Raw("missing", "", absent="pandas"),
    "calls": Raw("calls", [Raw("num", np.ones(2)), Raw("error", "no")], "n", listed=True),
}


@pytest.mark.parametrize("kind", VALUES)
def test_values_come_back_from_text_as_they_were(kind):
    raw = VALUES[kind]
    back = from_text(to_text({"x": raw}))["x"]
    assert (back.kind, back.note, back.listed, back.absent) == (
        raw.kind, raw.note, raw.listed, raw.absent,
    )  # fmt: skip
    if kind == "calls":
        assert [one.kind for one in back.value] == ["num", "error"]
        assert np.array_equal(back.value[0].value, np.ones(2))
    elif raw.kind == "num":
        assert back.value.shape == raw.value.shape
        assert back.value.dtype == raw.value.dtype
        assert back.value.tobytes() == raw.value.tobytes()
    else:
        assert back.value == raw.value


def test_work_and_what_is_done_come_back_from_their_text_as_they_were(lever):
    data = bytes(range(256))
    one = work(
        lever, data, beside={"a.csv": data}, came=Came("{}", Level.STRONG),
        numbers=({"x": [1.5, 1e-300, -0.1], "n": 3, "s": "é"},), peers={"ben": {"p": [[0.1]]}},
    )  # fmt: skip
    assert unpacked(Work, packed(one)) == one
    verdict = Verdict("p", "partly", 0.1, 2.0, (Finding("x", private=True),), "r", [True], [0.1])
    done = Done((verdict,), "", Came("{}", Level.UNSAFE), ("pandas",))
    assert unpacked(Done, packed(done)) == done
    nan = Done((Verdict("p", "failed", None, 2.0, answer=[math.nan, math.inf]),))
    back = unpacked(Done, packed(nan)).verdicts[0].answer
    assert math.isnan(back[0])
    assert back[1] == math.inf


def test_half_a_character_becomes_a_question_mark_as_in_the_gradebook():
    verdict = Verdict("p", "failed", 0.0, 2.0, (Finding("\ud800 is no matrix"),), answer="\udfff")
    (back,) = unpacked(Done, packed(Done((verdict,)))).verdicts
    assert (back.findings[0].text, back.answer) == ("? is no matrix", "?")


@pytest.mark.parametrize("text", [b"", b"[]", b'{"verdicts": [{"part": "p"}]}', b"\x80\x04."])
def test_what_is_not_done_work_is_refused(text):
    with pytest.raises(ValidationError):
        unpacked(Done, text)


def test_a_submission_is_marked_from_its_data_alone_where_the_course_is_not(lever):
    one = work(lever, b'{"lever_p": [9, 9]}')
    lever.unlink()
    here = do(one, no_jail)
    assert [verdict.status for verdict in here.verdicts] == ["incorrect", "missing"]
    elsewhere = unpacked(MARK.gives, there(MARK, packed(one)))
    assert elsewhere == here


def test_a_notebook_is_run_with_the_files_that_travelled_beside_it(lever, jail):
    cell = "import numpy as np\nlever_p = np.loadtxt('tip.csv', delimiter=',')"
    tip = ",".join(map(str, RIGHT["lever_p"])).encode()
    one = work(lever, notebook(cell), "one.ipynb", beside={"tip.csv": tip})
    done = do(one, lambda _: jail)
    assert [verdict.status for verdict in done.verdicts] == ["correct", "missing"]
    assert done.came.level is jail.level


def test_what_came_out_is_marked_again_without_being_run(lever):
    first = do(work(lever, b'{"lever_p": [9, 9]}'), no_jail)
    again = do(work(lever, b"", "one.ipynb", came=first.came), no_jail)
    assert again == first


def test_one_of_our_exercises_is_named_and_not_sent_and_another_text_is_refused(monkeypatch):
    path = exercise_files()["rrt"]
    text = exercise_text(path)
    assert (text.text, text.ours) == (b"", True)
    assert exercise_of(text) is load(path)
    monkeypatch.setattr(texts, "HOME", path.parent)
    other = type(text)("rrt.py", ours=True, hash="0", text=b"", beside={})
    with pytest.raises(ExerciseError, match="every machine takes the same kinegrade"):
        exercise_of(other)


def test_an_exercise_takes_the_modules_beside_it_along(tmp_path, lever):
    (tmp_path / "arms.py").write_text("share = 1.0\n", encoding="utf-8")
    text = lever.read_text(encoding="utf-8").replace("import numpy", "import arms\nimport numpy")
    lever.write_text(text, encoding="utf-8")
    sent = exercise_text(lever)
    lever.unlink()
    (tmp_path / "arms.py").unlink()
    assert exercise_of(sent).slug == "lever"


def test_complaints_of_another_process_are_repeated_here(lever, caplog):
    broken = LEVER.replace("x, y = given", "x, y = given['nothing'], given")
    lever.write_text(broken, encoding="utf-8")
    found = there(MARK, packed(work(lever, b'{"lever_J": [1, 2]}')))
    done = unpacked(Done, found)
    (complaint, *_) = done.complaints
    assert "could not be marked" in complaint.said
    assert "KeyError" in complaint.said
    caplog.clear()
    repeat(complaint)
    assert caplog.messages == [complaint.said]
    assert caplog.records[0].complaint == complaint.kind


def test_nothing_is_overheard_that_is_no_warning():
    with overheard() as heard:
        logging.getLogger("x").info("fine")
        logging.getLogger("x").warning("%s is odd", "this")
    assert [one.said for one in heard] == ["this is odd"]


def test_records_are_checked_elsewhere_as_here(lever):
    exercise = load(lever)
    fresh = Record("ada", "one", "lever", 0, V, fingerprint(exercise, V))
    moved = Record("ben", "one", "lever", 0, V, fresh.answers | {"lever_p": [1.0, 2.0]})
    broken = Record("cyd", "one", "lever", 0, {"L": 1.0}, fresh.answers)
    text = packed(Check(exercise_text(lever), (fresh, moved, broken)))
    found = unpacked(Checked, there(CHECK, text))
    assert found.moved == ((), ("lever_p",), ("lever_p", "lever_J"))
    assert "fails on the numbers of cyd" in found.complaints[0].said


@pytest.mark.parametrize("task", [MARK, CHECK])
def test_a_kind_of_work_travels_by_name(task):
    sent = pickle.dumps(task)
    assert len(sent) < 400
    assert pickle.loads(sent) == task  # noqa: S301 - our own


def test_a_process_keeps_one_jail_for_all_its_notebooks():
    walls = Walls(ANY, (), Level.MEDIUM)
    assert task.jail_there(walls) is task.jail_there(Walls(ANY, (), Level.MEDIUM))
    assert task.jail_there(walls).level is Level.MEDIUM
