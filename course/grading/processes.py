"""Worker processes on all cores of this machine, once there is enough to do for them."""

from collections.abc import Generator, Iterable
from concurrent.futures.process import BrokenProcessPool
from typing import TYPE_CHECKING, TypeVar

from ...grader.jail.jail import Jail
from ...grader.jail.level import Level
from ..machine.cores import cores, worker_processes
from .place import Here, LostWorkError, in_flight, received
from .task import Task, packed, there
from .work import Walls

if TYPE_CHECKING:
    from concurrent.futures import Future, ProcessPoolExecutor

K = TypeVar("K")
T = TypeVar("T")
R = TypeVar("R")
WORTH = 12  # pieces of work that are worth starting processes for
TRIES = 2  # of a piece by itself, before it is given up
KILLED = "the process that marked it was killed, twice"


class ThisMachine:
    """This process where there is little to do, else worker processes, which are kept."""

    def __init__(self, jail: Jail, packages: tuple[str, ...] = ()) -> None:
        """Takes a jail for what is done here; others are like it, and it is left open."""
        self._jail = jail
        self._packages = packages
        self._here = Here(jail)
        self._level: Level | None = None  # until somebody asks
        self._pool: ProcessPoolExecutor | None = None

    @property
    def walls(self) -> Walls:
        """Those of the jail here, whose level other processes need not find again."""
        return Walls(self._jail.permission, self._packages, self._level)

    @property
    def level(self) -> Level:
        """The level here."""
        self._level = self._jail.level
        return self._level

    def run(
        self, task: Task[T, R], pieces: Iterable[tuple[K, T]], expected: int
    ) -> Generator[tuple[K, R | BaseException]]:
        """See `Place`."""
        if cores() < 2 or expected < WORTH:
            yield from self._here.run(task, pieces, expected)
            return

        def submit(piece: T) -> "Future[bytes]":
            return self._submitted(task, piece)

        lost: list[tuple[K, T]] = []
        for key, piece, future in in_flight(submit, pieces, 2 * cores()):
            error = future.exception()
            if isinstance(error, BrokenProcessPool):
                lost.append((key, piece))
            else:
                yield key, error or received(task, future.result())
        # One of these may have ended its process, so each is tried by itself.
        for key, piece in lost:
            yield key, self._alone(task, piece)

    def _submitted(self, task: Task[T, R], piece: T) -> "Future[bytes]":
        data = packed(piece)
        if self._pool is not None:
            try:
                return self._pool.submit(there, task, data)
            except BrokenProcessPool:
                self._pool.shutdown()
        self._pool = worker_processes()
        return self._pool.submit(there, task, data)

    def _alone(self, task: Task[T, R], piece: T) -> R | BaseException:
        for _ in range(TRIES):
            future = self._submitted(task, piece)
            error = future.exception()
            if not isinstance(error, BrokenProcessPool):
                return error or received(task, future.result())
        return LostWorkError(KILLED)

    def close(self) -> None:
        """Ends the processes."""
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)
            self._pool = None
