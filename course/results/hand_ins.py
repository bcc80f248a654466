"""The files that students handed in for one sheet of a course, as they lie in submitted/."""

from ..settings.config import Course, Sheet
from ..sheet.handed_in import find_submission, misnamed, named_below, unread
from ..sheet.submissions import Submission
from ..term.received import listed_times


class HandIns:
    """Whichever file counts for a sheet, by the names of all sheets and the times that are known.

    Everybody who looks for a file does it here: the file that is marked is the one that is looked
    at elsewhere.
    """

    def __init__(self, course: Course, sheet: Sheet) -> None:
        """Reads submitted/received.csv.

        Raises:
            CourseError: a line of it cannot be meant.
        """
        self._folder = course.folder
        self._sheet = sheet.name
        self._names = [one.name for one in course.settings.sheet]
        self._received = listed_times(course.folder, course.settings.zone)

    def of(self, student: str) -> Submission | None:
        """The file that counts; None where there is none.

        Raises:
            CourseError: it cannot be read, or is a link to some other file.
        """
        return find_submission(self._folder, student, self._sheet, self._names, self._received)

    def beside(self, submission: Submission) -> dict[str, bytes]:
        """The files that go with one, by name.

        Raises:
            CourseError: one of them cannot be read.
        """
        with named_below(self._folder):
            return submission.beside()

    def unread(self, student: str) -> tuple[str, ...]:
        """Names of the files that look like versions of the one that counts."""
        return unread(self._folder, student, self._sheet, self._names, self._received)

    def misnamed(self, student: str) -> str:
        """The first file that is for no sheet; empty where there is none."""
        return misnamed(self._folder, student, self._names)
