"""How and where a class is marked."""

from collections.abc import Generator
from contextlib import closing, contextmanager
from dataclasses import dataclass

from ...grader.jail.jail import Jail
from ...grader.jail.level import Permission
from ..grading.place import Place
from ..grading.processes import ThisMachine
from ..settings.config import Course

STRONG = Permission()


@dataclass(frozen=True)
class How:
    """How sheets are marked.

    Attributes:
        accept_change: Whether moved references become the recorded ones.
        again: Whether marked files are marked anew.
        permission: How far down the walls around notebooks may go.
        cluster: The address of a Dask scheduler that it is marked by; else here.
        students: Ids of those whose files are marked; of all where none is named.
    """

    accept_change: bool = False
    again: bool = False
    permission: Permission = STRONG
    cluster: str = ""
    students: tuple[str, ...] = ()


AS_USUAL = How()


@contextmanager
def this_machine(course: Course, permission: Permission | None = None) -> Generator[ThisMachine]:
    """This machine, with all that is started on it ended at the end."""
    allowed = course.settings.packages.allow
    with Jail(permission, allowed) as jail, closing(ThisMachine(jail, allowed)) as machine:
        yield machine


@contextmanager
def marking_place(course: Course, how: How, machine: Place) -> Generator[Place]:
    """Where submissions are marked; pages are written on this machine in any case."""
    if not how.cluster:
        yield machine
        return
    from ..grading.cluster import Cluster

    allowed = course.settings.packages.allow
    with closing(Cluster(how.cluster, how.permission, allowed)) as cluster:
        yield cluster
