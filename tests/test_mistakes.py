"""Mistakes of a class: counted by student, wherever in a matrix they stand, the most frequent first."""

import pytest
from courses import lever, sheet
from kinegrade.course.results.grades import SheetResults
from kinegrade.course.results.mistakes import (
    UNNAMED,
    absent,
    mistakes,
    private_notes,
    to_talk_about,
    waiting,
)
from kinegrade.course.results.result import Result
from kinegrade.course.settings.config import Student
from kinegrade.grader.marking.verdict import ASIDES, Finding, Verdict, not_graded


@pytest.fixture
def marked(tmp_path):
    """Makes a sheet of which everybody has one verdict, with these sentences."""

    def made(*told, part="lever_p", status="partly"):
        results = []
        for i, sentences in enumerate(told):
            found = tuple(Finding(text) for text in sentences)
            verdict = Verdict(part, status, 1.0, 2.0, found)
            results.append(Result(Student(f"s{i}", f"S{i}"), "one", (verdict,)))
        return SheetResults(sheet(exercises=("lever",)), [lever(tmp_path)], results)

    return made


@pytest.mark.parametrize(
    ("one", "other", "listed"),
    [
        ("Only a sign is wrong: row 1, column 2.", "Only a sign is wrong: matrix 3, row 1, column 1.", "Only a sign is wrong."),
        ("Only row 1, column 2 is wrong; all the rest is right.", "Only row 3 is wrong; all the rest is right.", "Only one entry is wrong; all the rest is right."),
        ("Takes shape (6, 3), got (3, 6): rows and columns look exchanged.", "Takes shape (2, 3), got (3, 2): rows and columns look exchanged.", "Rows and columns look exchanged."),
        ("Takes finite numbers, got NaN, first at row 1, column 5.", "Takes finite numbers, got NaN, first at row 2, column 2.", "Takes finite numbers, got NaN."),
    ],
)  # fmt: skip
def test_the_same_mistake_elsewhere_is_the_same_mistake(marked, one, other, listed):
    (found,) = mistakes(marked([one], [other]))
    assert (found.sentence, found.parts, found.students) == (listed, ("lever_p",), ("s0", "s1"))


def test_the_row_of_a_table_is_part_of_the_mistake(marked):
    found = mistakes(
        marked(["Row 1: alpha has the wrong sign."], ["Row 2: alpha has the wrong sign."])
    )
    assert len(found) == 2


def test_the_most_frequent_stand_first_and_what_has_no_name_last(marked):
    found = mistakes(marked(["Rare"], [], [], [], ["Often"], ["Often"]))
    assert [one.sentence for one in found] == ["Often", "Rare", UNNAMED]
    assert [len(one.students) for one in found] == [2, 1, 3]


@pytest.mark.parametrize("start", ASIDES)
def test_what_an_answer_was_compared_with_is_no_mistake(marked, start):
    assert [one.sentence for one in mistakes(marked([f"{start} it."]))] == [UNNAMED]


@pytest.mark.parametrize("status", ["correct", "follows", "missing", "not_graded"])
def test_what_is_right_or_not_there_is_no_mistake(marked, status):
    assert mistakes(marked(["In your file: all is well."], status=status)) == []


def test_typed_lines_behind_a_sentence_are_not_listed(marked):
    assert [one.sentence for one in mistakes(marked(["Not closed.\nsin(\n   ^"]))] == [
        "Not closed."
    ]


def test_sheets_are_taken_together(marked):
    one, two = marked(["A sign."], ["A row."]), marked(["A row."], ["A row."], part="lever_J")
    (first, second) = to_talk_about([one, two], 5)
    assert (first.sentence, first.parts, first.students) == (
        "A row.",
        ("lever_p", "lever_J"),
        ("s0", "s1"),
    )
    assert second.sentence == "A sign."
    assert to_talk_about([one, two], 1) == [first]


def test_what_waits_who_is_away_and_what_is_private_are_told_apart(tmp_path):
    private = Verdict("lever_p", "incorrect", 0.0, 2.0, (Finding("like ben's", private=True),))
    results = [
        Result(Student("ada", "Ada"), "one", (private, not_graded("lever_J", 3, "By hand."))),
        Result(Student("ben", "Ben"), "one", reason="no submission"),
    ]
    found = SheetResults(sheet(exercises=("lever",)), [lever(tmp_path)], results)
    assert [(one.sentence, one.parts, one.students) for one in waiting(found)] == [
        ("By hand.", ("lever_J",), ("ada",))
    ]
    assert [one.sentence for one in private_notes(found)] == ["like ben's"]
    assert [one.sentence for one in mistakes(found)] == [UNNAMED]
    assert absent(found) == {"no submission": ["ben"]}
