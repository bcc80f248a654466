"""Zygotes for as many notebooks at a time as there are threads that ask, kept until the end."""

import sys
from collections.abc import Sequence
from contextlib import suppress
from functools import cache, partial
from queue import Empty, SimpleQueue
from typing import Self

from .bubblewrap import NoBubblewrapError
from .level import ON_LINUX, JailError, Level, Permission
from .packages import compiled
from .starter import Starter
from .syscalls import NoFilterError
from .zygote import End, LostError, Order, Zygote

FOR_MANY = ("numpy", "sympy", "IPython.core.inputtransformer2", "matplotlib.pyplot")
NOT_TO_BE_HAD = (JailError, NoFilterError, NoBubblewrapError, OSError)
FOR_ONE = ("numpy",)  # loading what one notebook may not need takes longer than it saves
MENTIONS = (b"sympy", b"matplotlib", b"IPython", b'"%', b'"!')
"""What stands in the file of a notebook that loads more than numpy, be it by a magic."""


class Jail:
    """Runs notebooks at one level; a context manager, for several threads at once."""

    def __init__(
        self,
        permission: Permission | None = None,
        packages: Sequence[str] = (),
        *,
        level: Level | None = None,
        preload: Sequence[str] | None = None,
    ) -> None:
        """Takes the best permitted level when the first notebook comes, or a given one.

        `packages` can be imported besides the usual ones; those of `preload` are imported once for
        all notebooks. Without it, numpy is, and sympy and its like for those that mention it: to
        fork a process that holds them takes longer than most notebooks.
        """
        self.permission = permission or Permission()
        self._level = level
        self._packages = tuple(packages)
        self._preload = FOR_ONE if preload is None else tuple(preload)
        self._by_notebook = preload is None
        self._idle: SimpleQueue[Zygote] = SimpleQueue()
        self._idle_full: SimpleQueue[Zygote] = SimpleQueue()
        self._starter = Starter()  # a zygote dies with the thread that started it

    @property
    def level(self) -> Level:
        """The level of all its notebooks.

        Raises:
            JailError: none that is permitted works here; it names the way out.
        """
        if self._level is None:
            self._level = best_level(self.permission)
        return self._level

    def run(self, order: Order) -> End | None:
        """How a notebook ended; None where it was stopped from outside.

        Raises:
            JailError: no process for it can be started.
        """
        idle, preload = self._idle, self._preload
        if self._by_notebook and any(word in order.request for word in MENTIONS):
            idle, preload = self._idle_full, FOR_MANY
        zygote = self._taken(idle, preload)
        try:
            return zygote.run(order)
        except LostError:
            return None
        finally:
            if zygote.alive:
                idle.put(zygote)

    def _taken(self, idle: "SimpleQueue[Zygote]", preload: tuple[str, ...]) -> Zygote:
        try:
            return idle.get_nowait()
        except Empty:
            compiled(preload)
            return self._untried(preload) or self._started(self.level, preload)

    def _untried(self, preload: tuple[str, ...]) -> Zygote | None:
        """The first one at the best permitted level, before anything was tried out.

        A level that works need not be tried by a process of its own.
        """
        if self._level is not None or not on_linux():
            return None
        best, *_ = self.permission.levels()
        try:
            zygote = self._started(best, preload)
        except NOT_TO_BE_HAD:
            return None
        self._level = best
        return zygote

    def _started(self, level: Level, preload: tuple[str, ...]) -> Zygote:
        return self._starter.call(partial(Zygote, level, self._packages, preload))

    def close(self) -> None:
        """Ends all zygotes; the next notebook starts new ones."""
        for idle in (self._idle, self._idle_full):
            with suppress(Empty):
                while True:
                    idle.get_nowait().close()
        self._starter.close()
        self._starter = Starter()

    def __enter__(self) -> Self:
        """Itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Ends all zygotes."""
        self.close()


def best_level(permission: Permission) -> Level:
    """The best of the permitted levels that works here.

    Raises:
        JailError: none does; it says why, and how notebooks can run all the same.
    """
    if not on_linux():
        raise JailError(f"{ON_LINUX}; .json, .csv and .mat anywhere")
    reasons: list[str] = []
    for level in permission.levels():
        why = missing(level)
        if not why:
            return level
        reasons.append(f"level {level} is not to be had: {why}")
    raise JailError("; ".join([*reasons, _way_out(permission)]))


def on_linux() -> bool:
    """Whether this is Linux."""
    return sys.platform == "linux"


@cache
def missing(level: Level) -> str:
    """Why a level does not work on this machine, tried out; empty where it does."""
    try:
        Zygote(level, (), ()).close()
    except NOT_TO_BE_HAD as error:
        return str(error)
    return ""


def _way_out(permission: Permission) -> str:
    ways = ["install bubblewrap and libseccomp2 (apt install bubblewrap libseccomp2)"]
    if not permission.accept_medium and not missing(Level.MEDIUM):
        ways.append("or accept less with --accept-medium (docs/security.md says how much less)")
    ways.append("or mark in a virtual machine of its own and say so with --unsafe")
    return ", ".join(ways)
