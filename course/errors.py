"""What is wrong with a course folder or one of its files."""

from ..solutions.errors import KinegradeError


class CourseError(KinegradeError):
    """course.toml, roster.csv or the course folder is not as it should be."""
