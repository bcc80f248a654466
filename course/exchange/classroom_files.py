"""For GitHub Classroom: what an assignment's template repository takes, and recorded results."""

import json
from pathlib import Path

from ..machine.files import write_atomically
from ..settings.config import Sheet
from .classroom_results import of_result
from .marked import Marked
from .wheel import wheel

WORKFLOW = """\
# Looks at a sheet on every push, by the numbers that are printed on it; these are no marks.
name: Autograding Tests
on: [push, workflow_dispatch]
permissions: {{contents: read, actions: read, checks: write}}
jobs:
  autograding:
    runs-on: ubuntu-latest
    if: github.actor != 'github-classroom[bot]'
    steps:
      - uses: actions/checkout@v4
      - uses: actions/setup-python@v5
        with: {{python-version: "3.12"}}
      - id: kinegrade
        run: |
          python -m pip install .kinegrade/{wheel}
          python -m kinegrade.course.exchange.classroom_check {sheet}.ipynb result.json
          echo "result=$(base64 -w0 result.json)" >> "$GITHUB_OUTPUT"
      - uses: classroom-resources/autograding-grading-reporter@v1
        env:
          KINEGRADE_RESULTS: "${{{{ steps.kinegrade.outputs.result }}}}"
        with:
          runners: kinegrade
"""


def write_template(sheet: Sheet, folder: Path) -> list[Path]:
    """Writes the workflow and the Kinegrade that it installs; their paths.

    It holds no secret, no records and no exercise of the course's own: students read all of it.
    """
    name, package = wheel()
    workflow = folder / ".github" / "workflows" / "classroom.yml"
    write_atomically(workflow, WORKFLOW.format(wheel=name, sheet=sheet.name))
    place = folder / ".kinegrade" / name
    write_atomically(place, package)
    return [workflow, place]


def write_results(marked: Marked, folder: Path) -> list[Path]:
    """Writes the marks of everybody whose marks are complete, a file each; their paths."""
    paths: list[Path] = []
    for result in marked.results:
        if result.points is None:
            continue
        path = folder / f"{result.student.id}.json"
        write_atomically(path, json.dumps(of_result(marked, result), indent=2))
        paths.append(path)
    return paths
