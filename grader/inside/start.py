"""The zygote: started once with a clean environment, it forks a process for every notebook.

It never sees an answer, reads no notebook, and talks over one socket: an order with two
descriptors comes in; a pidfd goes out, and when that process has ended, how it did.
"""

import contextlib
import gc
import importlib
import json
import os
import select
import shutil
import signal
import socket
import sys

from . import landlock
from .attempts import leaks
from .scratch import empty, is_too_full
from .student import live, settle

MAX_MESSAGE = 1 << 17
LOOK_SECONDS = 0.5


class House:
    """What all notebooks of a zygote have in common."""

    def __init__(self, about):
        self.pid = os.getpid()
        self.scratch = about["scratch"]
        self.packages = about["packages"]
        self.confined = about["confined"]
        self.filter = bytes.fromhex(about["filter"])
        self.rules = -1
        if self.confined:
            paths = about["readable"], [self.scratch], about["devices"]
            self.rules = landlock.ruleset(*paths)


def main(descriptor):
    """Makes ready, says so, and serves orders until the other side is gone."""
    channel = socket.socket(fileno=descriptor)
    about = json.loads(channel.recv(MAX_MESSAGE))
    for name in about["preload"]:
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    house = House(about)
    problem = _tried(house, about["outside"]) if house.confined else ""
    empty(house.scratch)  # matplotlib leaves a list of fonts, which is nobody's file
    channel.send(json.dumps({"problem": problem}).encode())

    _forget_ourselves()
    gc.collect()
    gc.freeze()  # pages that no collection touches stay shared with all notebooks
    try:
        while not problem and _serve(channel, house):
            pass
    finally:
        empty(house.scratch)
        if about["folder"]:  # the other side may be gone, and nobody else remove it
            shutil.rmtree(about["folder"], ignore_errors=True)
    os._exit(0)  # there is nothing left to end in order, and somebody waits for it


def _serve(channel, house):
    """One notebook; False when there is nobody to serve any more, or the folder is not clean."""
    message, descriptors, _, _ = socket.recv_fds(channel, MAX_MESSAGE, 2)
    if not message:
        return False
    request, answers = descriptors
    pid = os.fork()
    if pid == 0:
        channel.close()
        live(request, answers, json.loads(message), house)
    os.close(request)
    os.close(answers)

    handle = os.pidfd_open(pid)
    with contextlib.suppress(OSError):
        socket.send_fds(channel, [b"started"], [handle])
    full = _wait(channel, handle, house)
    os.close(handle)
    _, status, usage = os.wait4(pid, 0)
    with contextlib.suppress(OSError):  # without walls, it may have left others behind
        os.killpg(pid, signal.SIGKILL)
    clean = empty(house.scratch)
    end = {"status": status, "cpu": usage.ru_utime + usage.ru_stime, "clean": clean, "full": full}
    with contextlib.suppress(OSError):
        channel.send(json.dumps(end).encode())
    return clean


def _wait(channel, handle, house):
    """Until the process ends, or the other side does, which speaks only between two notebooks.

    True where it was stopped because it filled its folder.
    """
    ready = []
    while not ready:
        ready, _, _ = select.select([channel, handle], [], [], LOOK_SECONDS)
        full = not ready and is_too_full(house.scratch)
        if full or (ready and handle not in ready):
            signal.pidfd_send_signal(handle, signal.SIGKILL)
            return full
    return False


def _tried(house, outside):
    """What the walls let through, tried out by a process of its own."""
    ours, theirs = os.pipe()
    pid = os.fork()
    if pid == 0:
        said = "the process that tried the walls died"
        try:
            settle({"notebook_seconds": 10, "memory_mb": 2048, "file_mb": 1}, house)
            said = leaks(house, outside)
        except BaseException as error:
            said = f"{type(error).__name__}: {error}"
        finally:
            os.write(theirs, said.encode() or b" ")
            os._exit(0)
    os.close(theirs)
    with os.fdopen(ours, "rb") as pipe:
        said = pipe.read().decode()
    os.waitpid(pid, 0)
    return said.strip() if said else "the process that tried the walls was stopped"


def _forget_ourselves():
    """A notebook may have modules of its own with our names."""
    for name in [name for name in sys.modules if name.partition(".")[0] == __package__]:
        del sys.modules[name]
