"""Where work is done: here, with a bounded number of pieces at a time."""

from collections.abc import Callable, Collection, Generator, Iterable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from functools import partial
from itertools import islice
from typing import Any, Protocol, TypeVar

from ...grader.jail.jail import Jail
from ...grader.jail.level import Level
from ...solutions.errors import KinegradeError
from ..machine.cores import cores
from .overheard import repeat
from .task import Task, unpacked
from .work import Walls

K = TypeVar("K")
T = TypeVar("T")
R = TypeVar("R")


class LostWorkError(KinegradeError):
    """A piece of work came to nothing, as the processes that did it were killed."""


class Place(Protocol):
    """Somewhere where pieces of work are done."""

    @property
    def walls(self) -> Walls:
        """Behind what notebooks are run there."""
        ...

    @property
    def level(self) -> Level:
        """The weakest level at which notebooks are run there.

        Raises:
            JailError: none that is permitted works.
        """
        ...

    def run(
        self, task: Task[T, R], pieces: Iterable[tuple[K, T]], expected: int
    ) -> Generator[tuple[K, R | BaseException]]:
        """Does pieces of work as they are taken in, and gives back each with its key.

        They come as they are done. About `expected` of them will be there, or more.
        """
        ...

    def close(self) -> None:
        """Ends what was started for it."""
        ...


class Here:
    """This process, in as many threads as there are cores: notebooks run beside each other."""

    def __init__(self, jail: Jail) -> None:
        """Runs notebooks in a jail, which is left open."""
        self._jail = jail

    @property
    def walls(self) -> Walls:
        """Those of the jail."""
        return Walls(self._jail.permission)

    @property
    def level(self) -> Level:
        """That of the jail."""
        return self._jail.level

    def run(
        self, task: Task[T, R], pieces: Iterable[tuple[K, T]], expected: int
    ) -> Generator[tuple[K, R | BaseException]]:
        """See `Place`; threads are started as they are needed."""
        del expected
        with ThreadPoolExecutor(cores()) as pool:
            submit = partial(_submitted, pool, task, self._jail)
            for key, _, future in in_flight(submit, pieces, 2 * cores()):
                yield key, future.exception() or future.result()

    def close(self) -> None:
        """Leaves the jail to whoever made it."""


def _submitted(pool: ThreadPoolExecutor, task: Task[T, R], jail: Jail, piece: T) -> Future[R]:
    return pool.submit(task.does, piece, lambda _: jail)


def _first(futures: Collection[Future[Any]]) -> Collection[Future[Any]]:
    return wait(futures, return_when=FIRST_COMPLETED).done


def in_flight(
    submit: Callable[[T], Any],
    pieces: Iterable[tuple[K, T]],
    most: int,
    first: Callable[[Collection[Any]], Collection[Any]] = _first,
) -> Generator[tuple[K, T, Any]]:
    """Keeps up to `most` pieces submitted, and gives back each that is done, with its future.

    `first` waits for the first of some futures. Whoever stops listening cancels the others.
    """
    source = iter(pieces)
    waiting: dict[Any, tuple[K, T]] = {}
    try:
        while True:
            for key, piece in islice(source, most - len(waiting)):
                waiting[submit(piece)] = (key, piece)
            if not waiting:
                return
            done = first(waiting)
            for future in [one for one in waiting if one in done]:
                key, piece = waiting.pop(future)
                yield key, piece, future
    finally:
        for future in waiting:
            future.cancel()


def received(task: Task[T, R], text: bytes) -> R:
    """What another process sent, with its complaints said here."""
    result: Any = unpacked(task.gives, text)
    for complaint in result.complaints:
        repeat(complaint)
    return result
