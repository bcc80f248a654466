"""JUnit XML: a suite for every student and a case for every part."""

from xml.etree import ElementTree as ET

from ...grader.marking.verdict import STATUS_WORDS, Verdict
from ..results.result import Result
from .marked import Marked

PASSED = ("correct", "follows")
SKIPPED = ("missing", "not_graded")


def junit(marked: Marked) -> bytes:
    """The XML; what is not answered or not graded is skipped, neither passed nor failed."""
    root = ET.Element("testsuites", name=marked.title)
    for result in marked.results:
        if result.verdicts:
            root.append(_suite(marked, result))
    _count(root, list(root.iter("testcase")))
    ET.indent(root)
    return ET.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"


def _suite(marked: Marked, result: Result) -> ET.Element:
    suite = ET.Element("testsuite", name=f"{result.student.id}/{marked.sheet.name}")
    properties = ET.SubElement(suite, "properties")
    if result.points is not None:
        ET.SubElement(properties, "property", name="score", value=f"{result.points:g}")
    ET.SubElement(properties, "property", name="max_score", value=f"{result.out_of:g}")
    for verdict, line in zip(result.verdicts, marked.lines(result)[1:], strict=True):
        suite.append(_case(marked, verdict, line.partition(": ")[2]))
    _count(suite, list(suite.iter("testcase")))
    return suite


def _case(marked: Marked, verdict: Verdict, said: str) -> ET.Element:
    case = ET.Element("testcase", classname=marked.sheet.name, name=verdict.part, time="0")
    if verdict.status in PASSED:
        return case
    if verdict.status in SKIPPED:
        ET.SubElement(case, "skipped", message=STATUS_WORDS[verdict.status])
        return case
    message = STATUS_WORDS[verdict.status]
    if verdict.points is not None:
        message += f", {verdict.points:g} of {verdict.out_of:g} points"
    failure = ET.SubElement(case, "failure", type=verdict.status, message=message)
    failure.text = said
    return case


def _count(element: ET.Element, cases: list[ET.Element]) -> None:
    """Writes how many cases there are, and how many of them failed or were skipped."""
    failures = sum(case.find("failure") is not None for case in cases)
    skipped = sum(case.find("skipped") is not None for case in cases)
    counts = {"tests": len(cases), "failures": failures, "errors": 0, "skipped": skipped}
    for name, count in counts.items():
        element.set(name, str(count))
