"""Exercises on the robot Jacobian; the packages of Kinegrade stand beside this folder."""

from typing import Any


def load_ipython_extension(shell: Any) -> None:
    """`%load_ext kinegrade` in a notebook gives `%check`."""
    from kinegrade.course.student.magic import check

    shell.register_magic_function(check, "line", "check")
