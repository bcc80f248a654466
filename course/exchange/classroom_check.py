"""What the workflow of a student's repository runs: `kinegrade check`, told to GitHub Classroom.

Students may change the workflow of their repository and read all that it holds, so it is given no
secret and no records: it looks at a sheet by the numbers that are printed on it.
"""

import json
import sys
from pathlib import Path

from ...solutions.errors import KinegradeError
from ..machine.files import write_atomically
from ..student.check import check_file
from ..text.escape import printable
from .classroom_results import Test, classroom_results


def main(notebook: Path, output: Path) -> int:
    """Writes a test for every part: passed where `check` has nothing to say against it."""
    try:
        _, remarks = check_file(notebook)
        tests = [
            Test(remark.part, remark.ok, float(remark.ok), printable(remark.text))
            for remark in remarks
        ]
    except KinegradeError as error:
        tests = [Test(notebook.name, passed=False, score=0.0, message=str(error))]
    results = classroom_results(tests, len(tests))
    write_atomically(output, json.dumps(results, indent=2))
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
