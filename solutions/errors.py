"""The one base exception."""


class KinegradeError(Exception):
    """A sentence for the instructor: what, where, and what would be right."""
