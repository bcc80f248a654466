"""The code on the pages of a sheet: one for every variant, and read back as people type it."""

import pytest
from kinegrade.course.variants.variant import Record
from kinegrade.course.variants.variant_code import ALPHABET, read_code, variant_code, variant_codes


def record(student="ada", exercise="lever", attempt=0, **numbers):
    return Record(student, "one", exercise, attempt, numbers or {"L": 0.5}, {})


def test_a_code_is_eight_letters_that_are_not_misread():
    code = variant_code([record()])
    assert len(code) == 9
    assert code[4] == "-"
    assert set(code) <= {*ALPHABET, "-"}
    assert not set("ILOU") & set(ALPHABET)


def test_every_variant_has_a_code_of_its_own():
    others = [
        record(student="ben"),
        record(attempt=1),
        record(L=0.6),
        record(exercise="rrt"),
        *[record(student=f"s{i}") for i in range(500)],
    ]
    codes = {variant_code([one]) for one in (record(), *others)}
    assert len(codes) == 1 + len(others)


def test_the_order_of_the_records_and_new_answers_change_no_code():
    first, second = record(), record(exercise="rrt")
    assert variant_code([first, second]) == variant_code([second, first])
    answered = Record("ada", "one", "lever", 0, {"L": 0.5}, {"lever_p": [1.0]})
    assert variant_code([answered]) == variant_code([record()])
    assert variant_codes([first, record(student="ben"), second]) == {
        "ada": variant_code([first, second]),
        "ben": variant_code([record(student="ben")]),
    }


@pytest.mark.parametrize(
    ("typed", "code"),
    [
        ("K7M3-QXB9", "K7M3-QXB9"),
        (" k7m3qxb9 ", "K7M3-QXB9"),
        ("K7M3 QXB9", "K7M3-QXB9"),
        ("O0Il-0123", "0011-0123"),
        ("K7M3-QXB", ""),
        ("K7M3-QXB99", ""),
        ("ada", ""),
        ("K7M3-QX#9", ""),
    ],
)
def test_a_code_is_read_as_people_type_it(typed, code):
    assert read_code(typed) == code
