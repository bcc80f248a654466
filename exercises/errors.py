"""What is wrong with an exercise file."""

from ..solutions.errors import KinegradeError


class ExerciseError(KinegradeError):
    """An exercise file breaks the contract."""
