"""Deadlines, attempts, extensions, second opinions and publication, each on a small class."""

import json
import os
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from courses import hand_in, handed_out, make_course, right_answers
from kinegrade.course.ledger.gradebook import Gradebook
from kinegrade.course.marking.written import mark_and_write
from kinegrade.course.results.grades import SheetResults, totals
from kinegrade.course.results.result import recorded_results
from kinegrade.course.settings.asked import exercises_of
from kinegrade.course.settings.config import CourseError, Sheet, read_course
from kinegrade.course.settings.times import Lateness, lateness, read_time, rules_text, time_text
from kinegrade.course.term.received import read_receipts

DEADLINE = datetime(2026, 10, 8, 22, 0, tzinfo=UTC)
TIMES = "timezone = 'Europe/Berlin'\n"
RULE = """
deadline = 2026-10-08T22:00:00Z
grace_minutes = 15
late_percent = 10
late_most = 40
closes = 2026-10-15T22:00:00Z
"""


def timed(folder, rule=RULE):
    """A course whose sheet has a deadline, handed out."""
    make_course(folder, more=rule)
    return handed_out(folder)


def give(course, student, answers, at, name="one.json"):
    """Hands in answers at that time."""
    path = hand_in(course, student, answers, name)
    os.utime(path, (at.timestamp(), at.timestamp()))


def wrong(course, student):
    """Answers of which the second is wrong by much."""
    right = right_answers(course, student)
    return {**right, "lever_J": np.asarray(right["lever_J"]) + 0.37}


def marked(course):
    """Results by student, after all was marked."""
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        ((_, results),) = mark_and_write(course, gradebook, course.settings.sheet)
    return {result.student.id: result for result in results}


def recorded(course):
    with Gradebook(course.folder / "gradebook.sqlite") as gradebook:
        results = recorded_results(course, gradebook, course.settings.sheet[0])
    return {result.student.id: result for result in results}


def page(course, student):
    return (course.folder / "feedback" / student / "one.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("after", "late"),
    [
        (timedelta(minutes=-1), Lateness()),
        (timedelta(minutes=15), Lateness()),
        (timedelta(minutes=16), Lateness(1, 10)),
        (timedelta(days=1, minutes=15), Lateness(1, 10)),
        (timedelta(days=1, minutes=16), Lateness(2, 20)),
        (timedelta(days=6), Lateness(6, 40)),
        (timedelta(days=7, minutes=1), Lateness(7, 40, too_late=True)),
    ],
)
def test_late_days_begin_after_the_grace_and_are_capped(after, late):
    sheet = Sheet.model_validate(
        {
            "name": "one",
            "exercises": ["rrt"],
            "deadline": DEADLINE,
            "grace_minutes": 15,
            "late_percent": 10,
            "late_most": 40,
            "closes": DEADLINE + timedelta(days=7),
        }
    )
    assert lateness(sheet, DEADLINE + after, DEADLINE) == late


def test_an_extension_moves_the_closing_too():
    keys = {"deadline": DEADLINE, "closes": DEADLINE + timedelta(days=1), "late_percent": 10}
    sheet = Sheet.model_validate({"name": "one", "exercises": ["rrt"], **keys})
    later = DEADLINE + timedelta(days=5)
    assert lateness(sheet, later, later) == Lateness()
    assert lateness(sheet, later + timedelta(hours=1), later) == Lateness(1, 10)
    assert lateness(sheet, later + timedelta(days=2), later).too_late


def test_late_files_lose_what_the_rule_says_and_those_after_the_end_do_not_count(tmp_path):
    course = timed(tmp_path)
    give(course, "ada", right_answers(course, "ada"), DEADLINE)
    give(course, "ben", right_answers(course, "ben"), DEADLINE + timedelta(days=1, hours=1))
    give(course, "cyd", right_answers(course, "cyd"), DEADLINE + timedelta(days=30))
    results = marked(course)
    assert [results[one].points for one in ("ada", "ben", "cyd")] == [5, 4, None]
    assert results["cyd"].status == "no_submission"
    assert "after the sheet was closed" in results["cyd"].reason
    assert "late, 2 days begun; that takes 20 % off the points" in page(course, "ben")
    assert "days begun" not in page(course, "ada")
    assert recorded(course)["ben"].points == 4


def test_a_late_file_that_costs_nothing_is_said_to_be_late(tmp_path):
    course = timed(tmp_path, "deadline = 2026-10-08T22:00:00Z\n")
    give(course, "ada", right_answers(course, "ada"), DEADLINE + timedelta(hours=3))
    assert marked(course)["ada"].points == 5
    assert "late, 1 day begun; that costs nothing here" in page(course, "ada")


def test_received_csv_goes_before_the_time_of_the_file(tmp_path):
    course = timed(tmp_path)
    give(course, "ada", right_answers(course, "ada"), DEADLINE + timedelta(days=2))
    assert marked(course)["ada"].points == 4
    received = tmp_path / "submitted" / "received.csv"
    received.write_text(
        "student,sheet,file,received\nada,one,one.json,2026-10-08T23:50+02:00\n", encoding="utf-8"
    )
    assert marked(course)["ada"].points == 5


def test_a_file_keeps_the_time_at_which_it_was_seen_first(tmp_path):
    course = timed(tmp_path)
    answers = right_answers(course, "ada")
    give(course, "ada", answers, DEADLINE)
    marked(course)
    give(course, "ada", answers, DEADLINE + timedelta(days=3))
    assert marked(course)["ada"].points == 5


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("student,sheet,received\nada,one,2026-10-08\n", "line 2: file is missing"),
        ("student,sheet,file,received\nada,one,one.json,yesterday\n", "line 2: a time takes"),
    ],
)
def test_what_received_csv_cannot_mean_is_named(tmp_path, text, said):
    (tmp_path / "submitted").mkdir()
    (tmp_path / "submitted" / "received.csv").write_text(text, encoding="utf-8")
    with pytest.raises(CourseError, match=said):
        read_receipts(tmp_path)


def test_an_extension_is_granted_and_taken_back(tmp_path, kinegrade):
    course = timed(tmp_path)
    give(course, "ada", right_answers(course, "ada"), DEADLINE + timedelta(days=2))
    at = ("--course", str(tmp_path))
    granted = kinegrade(
        "extend", "ada", "one", "--until", "2026-10-11T00:00", "--reason", "ill", *at
    )
    assert granted.code == 0, granted.err
    assert "Sunday, 11 October 2026" in granted.err
    assert marked(course)["ada"].points == 5
    kinegrade("extend", "ada", "one", "--until", "", *at)
    assert marked(course)["ada"].points == 4
    told = kinegrade("gradebook", "history", "ada", *at).out
    assert "until 2026-10-11T00:00:00+00:00" in told
    assert "(ill)" in told


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("extend", "eve", "one", "--until", "2026-10-11"), "roster.csv has no student 'eve'"),
        (("extend", "ada", "two", "--until", "2026-10-11"), "there is no sheet 'two'"),
        (("extend", "ada", "one", "--until", "soon"), "a time takes a form such as"),
        (("excuse", "bne", "one"), "did you mean 'ben'"),
    ],
)
def test_what_cannot_be_granted_is_said(tmp_path, kinegrade, arguments, said):
    timed(tmp_path)
    refused = kinegrade(*arguments, "--course", str(tmp_path))
    assert refused.code == 1
    assert said in refused.err


def test_who_is_excused_has_a_total_without_the_sheet(tmp_path, kinegrade):
    course = timed(tmp_path)
    for student in ("ada", "ben"):
        give(course, student, right_answers(course, student), DEADLINE)
    kinegrade("excuse", "ada", "one", "--course", str(tmp_path))
    results = marked(course)
    assert (results["ada"].status, results["ada"].points) == ("excused", None)
    sheet = course.settings.sheet[0]
    ada, ben, _ = totals([SheetResults(sheet, exercises_of(course, sheet), [*results.values()])])
    assert (ada.status, ada.out_of, ada.percent) == ("excused", 0, None)
    assert ben.percent == 100
    assert "You are excused from this sheet" in page(course, "ada")


@pytest.mark.parametrize(("rule", "points"), [("best", 5), ("last", 2)])
def test_of_several_files_the_best_or_the_last_counts(tmp_path, rule, points):
    course = timed(tmp_path, f"{RULE}attempts = '{rule}'\n")
    give(course, "ada", right_answers(course, "ada"), DEADLINE)
    assert marked(course)["ada"].points == 5
    give(course, "ada", wrong(course, "ada"), DEADLINE + timedelta(minutes=1))
    result = marked(course)["ada"]
    assert result.points == points
    assert result.attempts.of == 2
    assert f"This is file {result.attempts.this} of 2." in page(course, "ada")


def test_a_better_file_that_is_late_counts_only_where_it_is_still_better(tmp_path):
    course = timed(tmp_path, f"{RULE}attempts = 'best'\n")
    give(course, "ada", wrong(course, "ada"), DEADLINE)
    give(course, "ben", wrong(course, "ben"), DEADLINE)
    first = {one: result.points for one, result in marked(course).items() if result.points}
    give(course, "ada", right_answers(course, "ada"), DEADLINE + timedelta(days=3))
    give(course, "ben", right_answers(course, "ben"), DEADLINE + timedelta(days=20))
    results = marked(course)
    assert results["ada"].points == 3.5
    assert results["ben"].points == first["ben"]


def test_no_more_files_count_than_are_allowed(tmp_path):
    course = timed(tmp_path, "most_attempts = 1\n")
    give(course, "ada", wrong(course, "ada"), DEADLINE)
    first = marked(course)["ada"].points
    give(course, "ada", right_answers(course, "ada"), DEADLINE)
    assert marked(course)["ada"].points == first


def test_a_late_file_after_one_in_time_leaves_that_one_standing(tmp_path):
    course = timed(tmp_path)
    give(course, "ada", right_answers(course, "ada"), DEADLINE)
    marked(course)
    give(course, "ada", wrong(course, "ada"), DEADLINE + timedelta(days=30))
    assert marked(course)["ada"].points == 5


def test_a_newer_file_that_cannot_be_read_waits_and_the_earlier_one_does_not_stand_for_it(tmp_path):
    course = timed(tmp_path)
    give(course, "ada", right_answers(course, "ada"), DEADLINE)
    marked(course)
    path = tmp_path / "submitted" / "ada" / "one.json"
    path.rename(tmp_path / "elsewhere.json")
    path.symlink_to(tmp_path / "elsewhere.json")
    result = marked(course)["ada"]
    assert (result.status, result.points) == ("not_graded", None)
    assert "is a link" in result.reason


def test_any_part_takes_a_mark_that_survives_marking_again(tmp_path, kinegrade):
    course = timed(tmp_path, "")
    give(course, "ada", wrong(course, "ada"), DEADLINE)
    at = ("--course", str(tmp_path))
    before = marked(course)["ada"].points
    done = kinegrade(
        "marks", "set", "ada", "lever_J", "2.5",
        "--comment", "You used the other axis.", "--reason", "talked", "--marker", "ann", *at,
    )  # fmt: skip
    assert done.code == 0, done.err
    assert recorded(course)["ada"].points == 4.5 != before
    regraded = kinegrade("grade", "--again", *at)
    assert regraded.code == 0
    assert recorded(course)["ada"].points == 4.5
    text = page(course, "ada")
    assert "Your marker writes:" in text
    assert "You used the other axis." in text
    assert "talked" not in text
    history = kinegrade("gradebook", "history", "ada", *at).out
    assert "ann  lever_J marked by hand: 2.5 points" in history
    assert "(talked)" in history


def test_a_mark_belongs_to_the_answer_that_was_read(tmp_path, kinegrade):
    course = timed(tmp_path, "")
    give(course, "ada", wrong(course, "ada"), DEADLINE)
    marked(course)
    kinegrade("marks", "set", "ada", "lever_J", "0", "--course", str(tmp_path))
    assert recorded(course)["ada"].points == 2
    give(course, "ada", right_answers(course, "ada"), DEADLINE)
    result = marked(course)["ada"]
    assert result.points == 5
    (note,) = [one for one in result.verdicts[1].findings if one.private]
    assert "for another answer" in note.text


def test_a_comment_alone_changes_no_points(tmp_path, kinegrade):
    course = timed(tmp_path, "")
    give(course, "ada", right_answers(course, "ada"), DEADLINE)
    marked(course)
    at = ("--course", str(tmp_path))
    assert kinegrade("marks", "set", "ada", "lever_p", "--comment", "Neat.", *at).code == 0
    kinegrade("report", *at)
    assert recorded(course)["ada"].points == 5
    assert "Neat." in page(course, "ada")
    assert kinegrade("marks", "set", "ada", "lever_p", *at).code == 2


def test_what_is_accepted_moves_everybody_whose_answer_is_like_it(tmp_path, kinegrade):
    course = timed(tmp_path, "")
    for student in ("ada", "ben"):
        right = right_answers(course, student)
        turned = {**right, "lever_J": -np.asarray(right["lever_J"])}
        give(course, student, turned, DEADLINE)
    give(course, "cyd", wrong(course, "cyd"), DEADLINE)
    at = ("--course", str(tmp_path))
    before = {one: result.points for one, result in marked(course).items()}
    accept = ("accept", "one", "lever_J", "--like", "ada", "--reason", "The sheet was unclear.")
    shown = kinegrade(*accept, "--dry-run", *at)
    assert shown.code == 0, shown.err
    lines = shown.out.splitlines()
    assert [line.split()[0] for line in lines] == ["ada", "ben"]
    assert lines[0].endswith("of 5  (lever_J 1.5 -> 3)")
    assert {one: result.points for one, result in recorded(course).items()} == before
    assert "--yes" in kinegrade(*accept, *at).err
    assert kinegrade(*accept, "--yes", *at).code == 0
    kinegrade("report", *at)
    after = {one: result.points for one, result in recorded(course).items()}
    assert after == {"ada": 5, "ben": 5, "cyd": before["cyd"]}
    assert "Your instructor accepts this answer: The sheet was unclear." in page(course, "ben")
    late = handed_out(tmp_path)  # who hands in later is treated alike
    right = right_answers(late, "cyd")
    give(late, "cyd", {**right, "lever_J": -np.asarray(right["lever_J"])}, DEADLINE)
    assert marked(late)["cyd"].points == 5
    kinegrade(*accept, "--no-longer", *at)
    assert recorded(course)["ada"].points == before["ada"]


def test_a_mark_for_one_student_goes_before_what_is_accepted_for_all(tmp_path, kinegrade):
    course = timed(tmp_path, "")
    right = right_answers(course, "ada")
    give(course, "ada", {**right, "lever_J": -np.asarray(right["lever_J"])}, DEADLINE)
    marked(course)
    at = ("--course", str(tmp_path))
    kinegrade("accept", "one", "lever_J", "--like", "ada", "--yes", *at)
    kinegrade("marks", "set", "ada", "lever_J", "1", *at)
    assert recorded(course)["ada"].points == 3


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("one", "lever_x", "--like", "ada"), "has no part 'lever_x'"),
        (("one", "lever_J", "--like", "eve"), "eve has no answer to lever_J"),
        (("too", "lever_J", "--like", "ada"), "there is no sheet 'too'"),
    ],
)
def test_what_cannot_be_accepted_is_said(tmp_path, kinegrade, arguments, said):
    course = timed(tmp_path, "")
    give(course, "ada", wrong(course, "ada"), DEADLINE)
    marked(course)
    refused = kinegrade("accept", *arguments, "--course", str(tmp_path))
    assert refused.code == 1
    assert said in refused.err


def test_published_marks_stay_until_they_are_published_again(tmp_path, kinegrade):
    course = timed(tmp_path, "")
    for student in ("ada", "ben"):
        give(course, student, wrong(course, student), DEADLINE)
    at = ("--course", str(tmp_path))
    told = marked(course)["ada"].points
    assert "2 results would be published" in kinegrade("publish", "one", "--dry-run", *at).err
    assert recorded(course)["ada"].published == ""
    done = kinegrade("publish", "one", *at)
    assert done.code == 0, done.err
    assert "2 results published" in done.err

    kinegrade("marks", "set", "ada", "lever_J", "3", *at)
    kinegrade("report", *at)
    result = recorded(course)["ada"]
    assert result.by_now is not None
    assert (result.points, result.by_now.points) == (told, 5)
    assert f"{told:g} / 5" in page(course, "ada")
    report = (tmp_path / "report" / "index.html").read_text(encoding="utf-8")
    assert "Changed since publishing" in report
    assert f"ada  one  {told:g} → 5 of 5" in report
    line = kinegrade("publish", "one", *at)
    assert line.out.startswith(f"ada  one  {told:g} -> 5 of 5")
    assert recorded(course)["ada"].points == 5
    assert "5 / 5" in page(course, "ada")


def test_a_request_is_listed_until_somebody_answers_it(tmp_path, kinegrade):
    course = timed(tmp_path, "")
    give(course, "ada", wrong(course, "ada"), DEADLINE)
    asked = "- lever_J: I used the axis\n  of the drawing.\x1b[31m\nlever_q: nothing\n"
    hand_in(course, "ada", asked.encode(), "one.request.txt")
    marked(course)
    at = ("--course", str(tmp_path))
    report = (tmp_path / "report" / "index.html").read_text(encoding="utf-8")
    assert "Asked to look again" in report
    listed = kinegrade("marks", "requests", *at).out
    assert "ada  one  lever_J  open: I used the axis of the drawing." in listed
    assert "\x1b" not in listed
    kinegrade("marks", "set", "ada", "lever_J", "--comment", "The drawing is right.", *at)
    assert kinegrade("marks", "requests", *at).out == ""
    assert "answered" in kinegrade("marks", "requests", "--all", *at).out


@pytest.mark.parametrize("kind", ["link", "second name", "folder"])
def test_a_request_that_leads_to_somebody_elses_file_asks_for_nothing(tmp_path, kinegrade, kind):
    course = make_course(tmp_path)
    own = course / "submitted" / "ada"
    path = own / "one.request.txt"
    own.parent.mkdir()
    if kind == "folder":
        other = course / "other"
        other.mkdir()
        (other / path.name).write_text("Private.", encoding="utf-8")
        own.symlink_to(other)
    elif kind == "link":
        own.mkdir()
        path.symlink_to(course / "secret")
    else:
        own.mkdir()
        path.hardlink_to(course / "secret")
    assert kinegrade("marks", "requests", "--course", course).out == ""


def test_a_request_that_cannot_be_read_is_listed_as_such(tmp_path, kinegrade, monkeypatch):
    course = make_course(tmp_path)
    path = course / "submitted" / "ada" / "one.request.txt"
    path.parent.mkdir(parents=True)
    path.write_text("Please.", encoding="utf-8")
    opened = Path.open

    def refuses(self, *args, **more):
        if self == path:
            raise PermissionError(13, "Permission denied")
        return opened(self, *args, **more)

    monkeypatch.setattr("pathlib.Path.open", refuses)
    listed = kinegrade("marks", "requests", "--course", course).out
    assert "one.request.txt cannot be read: Permission denied" in listed


def test_a_request_file_is_no_submission(tmp_path):
    course = timed(tmp_path, "")
    hand_in(course, "ada", b"lever_J: please\n", "one.request.txt")
    assert marked(course)["ada"].reason == "no submission"


def test_marking_again_says_whose_marks_change_and_a_dry_run_changes_nothing(tmp_path, kinegrade):
    course = timed(tmp_path, "")
    right = right_answers(course, "ada")
    nearly = {**right, "lever_J": np.asarray(right["lever_J"]) + 0.02}
    give(course, "ada", nearly, DEADLINE)
    before = marked(course)["ada"].points
    make_course(tmp_path, more="[sheet.exercise.lever]\ntolerance = 1000\n")
    at = ("--course", str(tmp_path))
    dry = kinegrade("regrade", "--dry-run", *at)
    assert dry.code == 0, dry.err
    assert dry.out.startswith(f"ada  one  {before:g} -> ")
    assert "Nothing was changed." in dry.err
    assert recorded(read_course(tmp_path))["ada"].points == before
    assert kinegrade("regrade", *at).out == dry.out
    assert recorded(read_course(tmp_path))["ada"].points != before
    assert "Marks of 0 students change." in kinegrade("regrade", *at).err


def test_of_a_sheet_and_its_resit_the_better_counts(tmp_path):
    resit = '[[sheet]]\nname = "two"\nresit_of = "one"\nexercises = ["lever"]\npoints = 10\n'
    course = timed(tmp_path, resit)
    for student in ("ada", "ben"):
        give(course, student, wrong(course, student), DEADLINE)
    give(course, "ada", right_answers(course, "ada", "two"), DEADLINE, "two.json")
    with Gradebook(tmp_path / "gradebook.sqlite") as gradebook:
        results = mark_and_write(course, gradebook, course.settings.sheet)
    sheets = [SheetResults(sheet, exercises_of(course, sheet), found) for sheet, found in results]
    ada, ben, cyd = totals(sheets)
    assert (ada.points, ada.out_of) == (5, 5)
    assert (ben.points, ben.status) == (results[0][1][1].points, "graded")
    assert cyd.status == "no_submission"
    one, two = ({r.student: r.numbers for r in _records(tmp_path, name)} for name in ("one", "two"))
    assert one["ada"] != two["ada"]


def _records(folder, sheet):
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        return gradebook.records(sheet)


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("deadline = 2026-10-08T22:00:00Z\nrelease = 2026-10-09T22:00:00Z\n", "before its release"),
        ("late_percent = 10\n", "takes a deadline"),
        ('resit_of = "two"\n', "is a resit of 'two'"),
        ("attempts = 'first'\n", "sheet.1.attempts"),
        ("late_percent = 120\n", "from 0 to 100"),
    ],
)
def test_times_that_cannot_be_meant_are_refused(tmp_path, more, said):
    make_course(tmp_path, more=more)
    with pytest.raises(CourseError) as error:
        read_course(tmp_path)
    assert said in str(error.value)


def test_times_without_a_zone_are_those_of_the_course(tmp_path):
    make_course(tmp_path, more="deadline = 2026-10-08T23:59:00\n")
    text = (tmp_path / "course.toml").read_text(encoding="utf-8")
    (tmp_path / "course.toml").write_text(f"timezone = 'Europe/Berlin'\n{text}", encoding="utf-8")
    (sheet,) = read_course(tmp_path).settings.sheet
    assert sheet.deadline == datetime(2026, 10, 8, 21, 59, tzinfo=UTC)
    assert time_text(sheet.deadline) == "Thursday, 8 October 2026, 23:59 (Europe/Berlin)"
    (tmp_path / "course.toml").write_text(f"timezone = 'Berlin'\n{text}", encoding="utf-8")
    with pytest.raises(CourseError, match="Europe/Berlin"):
        read_course(tmp_path)


def test_a_sheet_says_until_when_and_what_being_late_costs(tmp_path):
    course = timed(tmp_path, f'{RULE}instructions = "Work **alone**."\nminutes = 45\n')
    text = (tmp_path / "released" / "ada" / "one.ipynb").read_text(encoding="utf-8")
    assert "Hand in until Thursday, 8 October 2026, 22:00 (UTC)." in text
    assert "takes 10 % off the points, at most 40 %" in text
    assert "Work **alone**." in text
    assert "about 45 minutes" in text
    assert rules_text(course.settings.sheet[0]).endswith("counts.")


def test_one_student_is_marked_alone_and_the_others_stay_as_they_are(tmp_path, kinegrade):
    course = timed(tmp_path, "")
    for student in ("ada", "ben"):
        give(course, student, wrong(course, student), DEADLINE)
    before = marked(course)
    for student in ("ada", "ben"):
        give(course, student, right_answers(course, student), DEADLINE)
    at = ("--course", str(tmp_path))
    ran = kinegrade("grade", "--student", "ada", "--json", *at)
    assert ran.code == 0, ran.err
    (alone,) = json.loads(ran.out)
    assert (alone["student"], alone["points"]) == ("ada", 5)
    assert recorded(course)["ben"].points == before["ben"].points
    assert marked(course)["ben"].points == 5
    assert "roster.csv has no student 'eve'" in kinegrade("grade", "--student", "eve", *at).err


def test_a_time_that_names_no_zone_is_in_the_one_given():
    assert read_time("2026-10-08T23:59") == datetime(2026, 10, 8, 23, 59, tzinfo=UTC)
    assert read_time("2026-10-08T23:59+02:00") == datetime(2026, 10, 8, 21, 59, tzinfo=UTC)
    with pytest.raises(CourseError, match="a time takes a form"):
        read_time("8.10.2026")
