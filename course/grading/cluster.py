# pyright: basic
"""A Dask cluster: the same work on other machines, which are asked what they are before."""

import asyncio
import logging
from collections import Counter
from collections.abc import Collection, Generator, Iterable, Mapping
from concurrent import futures
from importlib.metadata import version
from typing import Any, TypeVar

from ...grader.jail.jail import best_level
from ...grader.jail.level import JailError, Level, Permission
from ...solutions.errors import KinegradeError
from ..machine.code import code_hash
from ..machine.console import say
from .place import LostWorkError, in_flight, received
from .task import Task, packed, there
from .work import Walls

K = TypeVar("K")
T = TypeVar("T")
R = TypeVar("R")
ANSWER_SECONDS = 10  # for a scheduler on this side of the world
LOOK_SECONDS = 5
ALONE_SECONDS = 60  # without any worker, until we stop waiting for one
NOT_INSTALLED = "marking on a cluster takes Dask: pip install 'kinegrade[cluster]'"
KILLED = "the workers that marked it were killed, one after the other"
CANCELLED = (asyncio.CancelledError, futures.CancelledError)  # by a scheduler that goes
CHATTY = ("distributed", "tornado.application", "asyncio")
"""Loggers that say at length what is a sentence of ours."""
ORDER = [Level.STRONG, Level.MEDIUM, Level.UNSAFE]


class ClusterError(KinegradeError):
    """A cluster cannot be used as it is."""


def about() -> tuple[str, str]:
    """What this machine is, as plain data."""
    return version("kinegrade"), code_hash()


def level_there(*, accept_medium: bool, unsafe: bool) -> tuple[str, str]:
    """The best permitted level of this machine, tried out; or none, and why."""
    try:
        return str(best_level(Permission(accept_medium, unsafe))), ""
    except JailError as error:
        return "", str(error)


def there_by(code: str, task: Task[Any, Any], text: bytes) -> bytes:
    """Does a piece of work, unless this machine would do it by other code.

    Raises:
        ClusterError: it would.
    """
    if code_hash() != code:
        raise ClusterError("a worker that came later has another kinegrade")
    return there(task, text)


class Cluster:
    """The workers of a Dask scheduler."""

    def __init__(
        self, address: str, permission: Permission, packages: tuple[str, ...] = ()
    ) -> None:
        """Finds the scheduler and asks its workers what they are.

        Raises:
            ClusterError: Dask is not installed here, no scheduler answers at the address, or a
                worker has another kinegrade.
        """
        self.walls = Walls(permission, packages)
        self._address = address
        self._client = _client(address)
        self._level: Level | None = None
        try:
            self._refuse_others(self._asked(about))
        except BaseException:
            self.close()
            raise

    def _asked(self, question: Any, **more: bool) -> Mapping[str, Any]:
        """What every worker answers.

        Raises:
            ClusterError: there is none, or one of them cannot.
        """
        if not self._workers():
            raise ClusterError(
                f"the scheduler at {self._address} has no workers yet; start some with "
                f"`dask worker {self._address}`"
            )
        try:
            return self._client.run(question, **more)
        except Exception as error:  # whatever a machine raises that has no kinegrade
            raise ClusterError(
                f"a worker at {self._address} cannot answer with {type(error).__name__}: {error}; "
                "every worker takes the kinegrade that is installed here"
            ) from error

    def _workers(self) -> Mapping[str, Any]:
        try:
            return self._client.scheduler_info(n_workers=-1)["workers"]
        except (OSError, *CANCELLED) as error:
            raise self._gone() from error

    def _refuse_others(self, answers: Mapping[str, Any]) -> None:
        own_version, own_code = about()
        for worker, (its_version, its_code) in answers.items():
            if its_version != own_version:
                raise ClusterError(
                    f"the worker {worker} has kinegrade {its_version}, and here is {own_version}; "
                    "every worker takes the same"
                )
            if its_code != own_code:
                raise ClusterError(
                    f"the worker {worker} has another kinegrade {its_version} than is installed "
                    "here: some of its files differ; every worker takes the same"
                )

    @property
    def level(self) -> Level:
        """The weakest level of a worker; it is said how many have which.

        Raises:
            JailError: a worker has none that is permitted.
        """
        if self._level is None:
            permission = self.walls.permission
            found = self._asked(level_there, **vars(permission))
            self._level = _weakest(found)
        return self._level

    def run(
        self, task: Task[T, R], pieces: Iterable[tuple[K, T]], expected: int
    ) -> Generator[tuple[K, R | BaseException]]:
        """See `Place`; what a killed worker was at, another does, as often as the scheduler allows.

        Raises:
            ClusterError: the scheduler is gone, or all workers are.
        """
        del expected
        threads = sum(worker["nthreads"] for worker in self._workers().values())
        lost: list[tuple[K, T]] = []
        for key, piece, result in self._done(task, pieces, 2 * max(threads, 1)):
            if isinstance(result, LostWorkError):
                lost.append((key, piece))
            else:
                yield key, result
        # What shared a worker with the one that ended it is not to blame: each is tried by itself.
        for key, _, result in self._done(task, lost, 1):
            yield key, result

    def _done(
        self, task: Task[T, R], pieces: Iterable[tuple[K, T]], most: int
    ) -> Generator[tuple[K, T, R | BaseException]]:
        from distributed import KilledWorker

        def submit(piece: T) -> Any:
            data = packed(piece)
            return self._client.submit(there_by, code_hash(), task, data, pure=False)

        for key, piece, future in in_flight(submit, pieces, most, self._first):
            if future.status in ("cancelled", "lost"):
                raise self._gone()
            error, result = self._fetched(future)
            if isinstance(error, KilledWorker):
                yield key, piece, LostWorkError(KILLED)
            elif isinstance(error, ClusterError):
                raise error
            else:
                yield key, piece, error or received(task, result)

    def _fetched(self, future: Any) -> tuple[BaseException | None, Any]:
        """What a piece of work failed with, or what came of it.

        Raises:
            ClusterError: it cannot be brought here any more.
        """
        try:
            error = future.exception()
            return error, None if error else future.result()
        except (OSError, *CANCELLED) as gone:
            raise self._gone() from gone

    def _first(self, futures: Collection[Any]) -> Collection[Any]:
        """Those that are done, when the first is.

        Raises:
            ClusterError: nobody is there any more who could do them.
        """
        from distributed import wait

        alone = 0
        while True:
            try:
                found: Any = wait([*futures], timeout=LOOK_SECONDS, return_when="FIRST_COMPLETED")
            except TimeoutError:
                pass
            except (OSError, *CANCELLED) as error:
                raise self._gone() from error
            else:
                return found.done
            if self._client.status != "running":
                raise self._gone()
            alone = 0 if self._workers() else alone + LOOK_SECONDS
            if alone >= ALONE_SECONDS:
                raise ClusterError(
                    f"all workers at {self._address} are gone; what was marked is kept, "
                    "and the same command goes on from there"
                )

    def _gone(self) -> ClusterError:
        return ClusterError(
            f"the scheduler at {self._address} is gone; what was marked is kept, "
            "and the same command goes on from there"
        )

    def close(self) -> None:
        """Leaves the cluster as it was."""
        self._client.close()


def _client(address: str) -> Any:
    try:
        from distributed import Client
    except ModuleNotFoundError as error:
        raise ClusterError(NOT_INSTALLED) from error
    for name in CHATTY:
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        return Client(address, timeout=ANSWER_SECONDS)
    except (OSError, TimeoutError, ValueError) as error:
        raise ClusterError(
            f"no Dask scheduler answers at {address}; `dask scheduler` starts one and prints its "
            "address, such as tcp://127.0.0.1:8786"
        ) from error


def _weakest(found: Mapping[str, tuple[str, str]]) -> Level:
    counts: Counter[Level] = Counter()
    for worker, (level, why) in found.items():
        if why:
            raise JailError(f"the worker {worker} runs no notebooks: {why}")
        counts[Level(level)] += 1
    told = [f"{counts[level]} at level {level}" for level in ORDER if level in counts]
    say(f"Workers: {', '.join(told)}.")
    return max(counts, key=ORDER.index)
