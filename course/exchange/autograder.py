"""An autograder for Gradescope: Kinegrade, the course's exercises, and the records of one sheet.

It holds what was drawn for everybody, and so every answer; the code of a submission runs behind
walls that keep it from reading them. It holds no secret, no mark and no submission.
"""

import json
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ...grader.jail.level import Permission
from ..errors import CourseError
from ..ledger.gradebook import FILE, Gradebook
from ..machine.files import write_atomically
from ..settings.asked import exercises_of
from ..settings.config import Course, Sheet
from ..variants.variant import Record
from .packing import packed
from .wheel import wheel

ABOUT = "course.json"
FOR_ITS_OWNER = 0o600  # as the gradebook is
PROGRAMS = frozenset({"setup.sh", "run_autograder"})
TIMELESS = {
    "deadline": None,
    "closes": None,
    "attempts": "last",
    "most_attempts": None,
    "resit_of": "",
}
SETUP = """#!/bin/sh
# bubblewrap and libseccomp2 are the walls around the code of a submission.
set -e
apt-get update
apt-get install -y bubblewrap libseccomp2 python3-pip
python3 -m pip install --break-system-packages uv || python3 -m pip install uv
export UV_PYTHON_INSTALL_DIR=/opt/python
uv venv --python 3.12 /opt/kinegrade
uv pip install --python /opt/kinegrade/bin/python /autograder/source/{wheel} {packages}
"""
RUN = """#!/bin/sh
exec /opt/kinegrade/bin/python -I -m kinegrade.course.exchange.autograder_run /autograder
"""


def write_autograder(
    course: Course, gradebook: Gradebook, sheet: Sheet, path: Path, permission: Permission
) -> Path:
    """Writes the zip that Gradescope takes as the autograder of a sheet; its path.

    `permission` says how far the walls around submissions may go down there.

    Raises:
        CourseError: nothing of the sheet was drawn.
    """
    exercises_of(course, sheet)  # one that cannot be loaded is named here, not there
    records = gradebook.records(sheet.name)
    if not records:
        raise CourseError(
            f"nothing of sheet {sheet.name} was drawn yet; `kinegrade generate` comes first"
        )
    name, package = wheel()
    allowed = " ".join(course.settings.packages.allow)
    contents = {
        name: package,
        "setup.sh": SETUP.format(wheel=name, packages=allowed).encode(),
        "run_autograder": RUN.encode(),
        ABOUT: json.dumps(_about(course, sheet, permission), indent=2).encode(),
        FILE: _records_alone(records),
    }
    data = packed(contents | _own_exercises(course.folder), PROGRAMS)
    write_atomically(path, data, mode=FOR_ITS_OWNER)
    return path


def _about(course: Course, sheet: Sheet, permission: Permission) -> dict[str, Any]:
    """Settings without the secret and the place of the gradebook, and the roster.

    Times are left to Gradescope, which has deadlines and extensions of its own.
    """
    timeless = course.settings.model_copy(update={"sheet": (sheet.model_copy(update=TIMELESS),)})
    settings = timeless.model_dump(mode="json", exclude={"secret", "gradebook"})
    students = [[one.id, one.name, [*map(list, one.more)]] for one in course.students]
    return {
        "settings": settings,
        "students": students,
        "sheet": sheet.name,
        "accept_medium": permission.accept_medium,
    }


def _records_alone(records: Sequence[Record]) -> bytes:
    """A gradebook with what was drawn, and nothing that anybody handed in or got."""
    of_student: dict[str, list[Record]] = {}
    for record in records:
        of_student.setdefault(record.student, []).append(record)
    with TemporaryDirectory() as folder:
        place = Path(folder) / FILE
        with Gradebook(place) as gradebook:
            for these in of_student.values():
                gradebook.save_records(these)
        return place.read_bytes()


def _own_exercises(folder: Path) -> dict[str, bytes]:
    """The course's own exercise files, with the modules beside them."""
    found: dict[str, bytes] = {}
    for path in sorted((folder / "exercises").rglob("*.py")):
        found[path.relative_to(folder).as_posix()] = path.read_bytes()
    return found
