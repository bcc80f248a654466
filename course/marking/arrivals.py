"""When the files of a sheet came in: kept by hash, so that copying a file changes nothing."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..ledger.gradebook import Gradebook
from ..settings.config import Course, Sheet
from ..term.received import file_time, listed_times

if TYPE_CHECKING:
    from datetime import datetime


def note_arrivals(
    course: Course, gradebook: Gradebook, sheet: Sheet, files: Mapping[tuple[str, str], Path]
) -> None:
    """Keeps when files, by student and hash, came in.

    What received.csv says counts; else it is the time of the file when it was first seen.

    Raises:
        CourseError: received.csv cannot be read.
    """
    listed = listed_times(course.folder, course.settings.zone)
    known = gradebook.term.arrivals(sheet.name)
    times: dict[tuple[str, str], datetime] = {}
    for (student, submission), path in files.items():
        said = listed.get((student, sheet.name, path.name))
        if said is not None:
            times[student, submission] = said
        elif (student, submission) not in known:
            times[student, submission] = file_time(path)
    gradebook.term.note_arrivals(sheet.name, times)
