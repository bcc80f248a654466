"""Results as the reporter of GitHub Classroom takes them: a list of tests that it adds up."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ..results.result import Result
from .marked import Marked


@dataclass(frozen=True)
class Test:
    """One line of the reporter's table."""

    name: str
    passed: bool
    score: float
    message: str


def classroom_results(tests: Sequence[Test], max_score: float) -> dict[str, Any]:
    """What the reporter reads; the whole has passed when all of it has."""
    listed: list[dict[str, Any]] = []
    for test in tests:
        line: dict[str, Any] = {
            "name": test.name,
            "status": "pass" if test.passed else "fail",
            "score": test.score,
            "message": None if test.passed else test.message,
        }
        listed.append(line | {"test_code": "", "filename": "", "line_no": 0, "duration": 0})
    passed = all(test.passed for test in tests)
    return {
        "version": 1,
        "status": "pass" if passed else "fail",
        "max_score": max_score,
        "tests": listed,
    }


def of_result(marked: Marked, result: Result) -> dict[str, Any]:
    """The recorded marks of a student; all of them are there."""
    tests: list[Test] = []
    for verdict, line in zip(result.verdicts, marked.lines(result)[1:], strict=True):
        passed = verdict.status in ("correct", "follows")
        score = round((verdict.points or 0.0) * result.late.share, 2)
        tests.append(Test(verdict.part, passed, score, line.partition(": ")[2]))
    return classroom_results(tests, result.out_of)
