"""results.json as Gradescope reads it: a total of its own, and a test for every part."""

from typing import Any

from ...grader.marking.verdict import Verdict
from ..results.result import Result
from .marked import Marked

PASSED = ("correct", "follows")


def gradescope_results(marked: Marked, result: Result) -> dict[str, Any]:
    """What a student gets and reads.

    The total is given, so that Gradescope does not add it up, and no test is hidden, as one hidden
    test hides the total. A part that waits for its mark has no score, and the text says so.
    """
    lines = marked.lines(result)
    waiting = [verdict.part for verdict in result.verdicts if verdict.points is None]
    output = lines[0]
    if waiting:
        output = f"Not graded yet, and not in this score: {', '.join(waiting)}."
    tests: list[dict[str, Any]] = []
    for number, (verdict, line) in enumerate(zip(result.verdicts, lines[1:], strict=True), 1):
        tests.append(_test(number, verdict, line))
    return {
        "score": result.so_far,
        "output": output,
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": tests,
        "extra_data": {
            "sheet": marked.sheet.name,
            "student": result.student.id,
            "status": result.status,
            "out_of": marked.out_of,
        },
    }


def _test(number: int, verdict: Verdict, line: str) -> dict[str, Any]:
    test: dict[str, Any] = {
        "name": verdict.part,
        "number": f"{number}",
        "output": line.partition(": ")[2],
        "visibility": "visible",
        "extra_data": {"status": verdict.status},
    }
    if verdict.points is not None:
        test |= {"score": verdict.points, "max_score": verdict.out_of}
        test["status"] = "passed" if verdict.status in PASSED else "failed"
    return test
