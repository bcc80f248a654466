"""Worker processes, as many as there are cores; they end with the process that started them."""

import os
import signal
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context, parent_process
from threading import Thread


def worker_processes() -> ProcessPoolExecutor:
    """A pool of as many processes as there are cores, which are started as work comes in.

    They are started anew and not forked: typst does not survive a fork, nor do threads.
    """
    return ProcessPoolExecutor(cores(), get_context("spawn"), _left_to_the_parent)


def cores() -> int:
    """Those that this process may use, where the system says which."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _left_to_the_parent() -> None:
    """Ctrl-C ends the parent, which lets its processes finish the sheets at hand.

    A parent that is killed takes them with it: they would wait for it for ever.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_the_parent, daemon=True).start()


def _end_with_the_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
