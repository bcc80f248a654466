"""Numbers of a class: held against values worked out by hand."""

import pytest
from courses import lever, sheet
from kinegrade.course.pages.histogram import histogram
from kinegrade.course.results.grades import SheetResults
from kinegrade.course.results.result import Result
from kinegrade.course.results.statistics import part_numbers, sheet_shares, spread
from kinegrade.course.settings.config import Student
from kinegrade.grader.marking.verdict import Verdict, not_graded


def results(folder, *pairs):
    """Points of lever_p (of 2) and lever_J (of 3) for each student; None waits."""
    found = []
    for i, pair in enumerate(pairs):
        verdicts = [
            not_graded(name, of, "wait") if points is None else Verdict(name, "partly", points, of)
            for name, of, points in zip(("lever_p", "lever_J"), (2.0, 3.0), pair, strict=True)
        ]
        found.append(Result(Student(f"s{i}", f"S{i}"), "one", tuple(verdicts)))
    return SheetResults(sheet(exercises=("lever",)), [lever(folder)], found)


def test_shares_fall_into_tenths_and_the_full_points_into_the_last():
    found = spread([0.0, 0.1, 0.55, 0.999, 1.0])
    assert found.bins == (1, 1, 0, 0, 0, 1, 0, 0, 0, 2)
    assert (found.count, found.median) == (5, 0.55)
    assert found.mean == pytest.approx(0.5298)


def test_a_class_without_points_has_no_mean():
    assert spread([]).mean is None
    assert "nobody has points yet" in histogram(spread([]).bins, "points")


def test_what_waits_is_in_no_share(tmp_path):
    assert sheet_shares(results(tmp_path, (2, 3), (1, None), (1, 1))) == [1.0, 0.4]


def test_facility_is_the_mean_over_the_points(tmp_path):
    p, J = part_numbers(results(tmp_path, (2, 3), (1, 0), (0, None)))
    assert (p.count, p.mean, p.facility) == (3, 1.0, 0.5)
    assert (J.count, J.mean, J.facility) == (2, 1.5, 0.5)


@pytest.mark.parametrize(
    ("pairs", "wanted"),
    [
        ([(0, 0), (1, 1), (2, 2), (1, 1), (0, 0)], 1.0),
        ([(0, 2), (1, 1), (2, 0), (1, 1), (0, 2)], -1.0),
        ([(2, 0), (2, 1), (2, 2), (2, 1), (2, 0)], None),
        ([(0, 0), (1, 1), (2, 2), (1, 1)], None),
    ],
)
def test_discrimination_is_the_correlation_with_the_rest_of_the_sheet(tmp_path, pairs, wanted):
    found = part_numbers(results(tmp_path, *pairs))[0].discrimination
    assert found == (wanted if wanted is None else pytest.approx(wanted))


def test_a_histogram_says_in_words_what_it_shows():
    drawn = histogram((2, 0, 0, 0, 0, 0, 0, 0, 0, 5), "points of one")
    assert (
        "<title>Histogram of points of one: 2 from 0 to 10 %, 5 from 90 to 100 %</title>" in drawn
    )
    assert drawn.count("<rect") == 2
