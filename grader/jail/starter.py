"""A thread that lasts: what it starts ends with it, and so has to be started by one that stays."""

from collections.abc import Callable
from concurrent.futures import Future
from queue import SimpleQueue
from threading import Lock, Thread
from typing import Any, TypeVar

T = TypeVar("T")


class Starter:
    """Calls functions in one thread, one after the other.

    Threads of a pool are ended before functions that `atexit` knows are called: processes that end
    with them would be gone before they can be ended in order.
    """

    def __init__(self) -> None:
        """Starts the thread with the first call; it ends with the process at the latest."""
        self._calls: SimpleQueue[tuple[Callable[[], Any], Future[Any]] | None] = SimpleQueue()
        self._thread: Thread | None = None
        self._starting = Lock()

    def call(self, function: Callable[[], T]) -> T:
        """What the function returns, or raises, in that thread."""
        with self._starting:
            if self._thread is None:
                self._thread = Thread(target=self._serve, daemon=True)
                self._thread.start()
        result: Future[T] = Future()
        self._calls.put((function, result))
        return result.result()

    def close(self) -> None:
        """Ends the thread once it has done what was asked of it."""
        self._calls.put(None)

    def _serve(self) -> None:
        while (call := self._calls.get()) is not None:
            function, result = call
            try:
                result.set_result(function())
            except BaseException as error:  # noqa: BLE001 - it is for whoever asked
                result.set_exception(error)
