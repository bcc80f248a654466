"""A process that waits with numpy loaded, and starts a process for every notebook it is given."""

import json
import os
import select
import signal
import socket
import subprocess
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from .folders import remove
from .level import JailError, Level
from .walls import Surroundings, surroundings

MAX_FRAME = 2 << 20
MAX_MESSAGE = 1 << 16
MAX_STREAM = 512 << 20  # of all frames of one notebook
MAX_FRAMES = 100_000  # of one notebook, which sends one after every cell and every call
START_SECONDS = 120  # a busy machine loads sympy slowly
FULL = "the notebook wrote more files than a sheet asks for"
TOO_MUCH = "the notebook wrote more than its answers can hold"
TOO_MANY = "the notebook started more threads than a sheet asks for"
MOST_THREADS = 64  # beside the one that runs the cells
LOOK_SECONDS = 0.1  # at the threads: a process may have any number, and they are the machine's
SHUT = "a cell closed the pipe that answers take"
GONE_SECONDS = 5  # from the end of its pipe to that of a process that ends by itself
END_SECONDS = 60  # until a killed process is gone and its folder is empty


class LostError(RuntimeError):
    """The zygote is no more; its notebook was stopped from outside."""


@dataclass(frozen=True)
class Order:
    """What one notebook may use, and what its process reads."""

    request: bytes
    notebook_seconds: float
    memory_mb: int
    file_mb: int


@dataclass(frozen=True)
class End:
    """How the process of a notebook ended.

    Attributes:
        frame: The last complete frame.
        clock: Whether we stopped it at its time.
        stopped: Why else we stopped it; empty where we did not.
        signal: The signal that ended it; 0 for none.
        cpu: What it used of the processor [s].
    """

    frame: bytes
    clock: bool = False
    stopped: str = ""
    signal: int = 0
    cpu: float = 0.0


class Zygote:
    """One started process, for one notebook at a time."""

    def __init__(self, level: Level, packages: tuple[str, ...], preload: Sequence[str]) -> None:
        """Starts it and waits until it is ready.

        Raises:
            JailError: it does not start, or its walls do not hold.
        """
        self.alive = True
        self._surroundings = surroundings(level, packages, preload)
        self._channel, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self.process = _started(self._surroundings, theirs.fileno())
        try:
            self._make_ready()
        except BaseException:
            self.close()
            raise

    def _make_ready(self) -> None:
        self._channel.settimeout(START_SECONDS)
        try:
            self._channel.send(self._surroundings.message)
            said = self._channel.recv(MAX_MESSAGE)
        except OSError:
            said = b""
        if not said:
            self.process.kill()
            assert self.process.stderr is not None  # noqa: S101 - Popen was given a pipe
            why = self.process.stderr.read().decode(errors="replace").strip()
            raise JailError(why.splitlines()[-1] if why else "the process did not start")
        problem = json.loads(said)["problem"]
        if problem:
            raise JailError(problem)

    def run(self, order: Order) -> End:
        """Runs one notebook to its end.

        Raises:
            LostError: the zygote was stopped; it is closed then.
        """
        ours, theirs = os.pipe()
        handle = -1
        try:
            handle = self._begin(order, theirs)
            os.close(theirs)
            theirs = -1
            end = _frames(ours, handle, order.notebook_seconds)
            if not (end.clock or end.stopped or _is_gone(handle)):
                end = replace(end, stopped=SHUT)
            with suppress(ProcessLookupError):
                signal.pidfd_send_signal(handle, signal.SIGKILL)
            return self._ended(end)
        except (OSError, ValueError, LookupError, TypeError) as error:
            self.close()
            raise LostError(str(error)) from error
        finally:
            for descriptor in (ours, theirs, handle):
                if descriptor >= 0:
                    os.close(descriptor)

    def _begin(self, order: Order, answers: int) -> int:
        """Hands an order over; a handle of the process that runs it."""
        limits = {
            "notebook_seconds": order.notebook_seconds,
            "memory_mb": order.memory_mb,
            "file_mb": order.file_mb,
        }
        request = os.memfd_create("request", os.MFD_CLOEXEC)
        try:
            _write(request, order.request)
            socket.send_fds(self._channel, [json.dumps(limits).encode()], [request, answers])
        finally:
            os.close(request)
        self._channel.settimeout(END_SECONDS)
        _, handles, _, _ = socket.recv_fds(self._channel, MAX_MESSAGE, 1)
        (handle,) = handles
        return handle

    def _ended(self, end: End) -> End:
        """With what the zygote says of a process that is gone."""
        said: Mapping[str, Any] = json.loads(self._channel.recv(MAX_MESSAGE))
        if not said["clean"]:
            self.close()
        status = said["status"]
        by_signal = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
        stopped = FULL if said["full"] else end.stopped
        return replace(end, stopped=stopped, signal=by_signal, cpu=said["cpu"])

    def close(self) -> None:
        """Ends it and all that it started, and removes what it wrote."""
        if not self.alive:
            return
        self.alive = False
        self._channel.close()
        with suppress(subprocess.TimeoutExpired):
            self.process.wait(timeout=1)  # it empties its folder and goes
        self.process.kill()
        self.process.wait()
        assert self.process.stderr is not None  # noqa: S101 - Popen was given a pipe
        self.process.stderr.close()
        remove(self._surroundings.folder)


def _started(around: Surroundings, descriptor: int) -> "subprocess.Popen[bytes]":
    command = [word.replace("{descriptor}", str(descriptor)) for word in around.command]
    return subprocess.Popen(  # noqa: S603 - our own command
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        pass_fds=(descriptor,),
        env=around.environment,
        cwd=around.folder or "/",
        start_new_session=True,  # Ctrl-C is for the grader, which ends it in order
    )


def _is_gone(handle: int) -> bool:
    """Whether a process whose pipe has ended ends as well: one that stays has closed it."""
    ready, _, _ = select.select([handle], [], [], GONE_SECONDS)
    return bool(ready)


def _write(descriptor: int, data: bytes) -> None:
    with os.fdopen(os.dup(descriptor), "wb") as file:
        file.write(data)


def _threads(handle: int) -> int:
    """How many threads the process of a handle has; none when it is gone."""
    try:
        about = Path(f"/proc/self/fdinfo/{handle}").read_text(encoding="ascii")
        pid = int(_field(about, "Pid:"))
        return int(_field(Path(f"/proc/{pid}/status").read_text(encoding="utf-8"), "Threads:"))
    except (OSError, ValueError):
        return 0


def _field(text: str, name: str) -> str:
    return text.partition(f"{name}\t")[2].partition("\n")[0]


def _frames(ours: int, handle: int, seconds: float) -> End:
    """The newest complete frame when the process ends or has to be stopped, and why it has."""
    begin = time.monotonic()
    end, look = begin + seconds, begin + LOOK_SECONDS
    buffer = newest = b""
    total = count = 0
    while True:
        now = time.monotonic()
        if now >= end:
            return End(newest, clock=True)
        if now >= look:
            look = now + LOOK_SECONDS
            if _threads(handle) > 1 + MOST_THREADS:
                return End(newest, stopped=TOO_MANY)
        ready, _, _ = select.select([ours], [], [], max(0.0, min(look, end) - now))
        if not ready:
            continue

        chunk = os.read(ours, 1 << 16)
        total += len(chunk)
        if not chunk:
            return End(newest)
        buffer += chunk

        # A frame is eight bytes of length and as many bytes as they say.
        while len(buffer) >= 8:
            length = int.from_bytes(buffer[:8], "little")
            if length > MAX_FRAME or total > MAX_STREAM or count > MAX_FRAMES:
                return End(newest, stopped=TOO_MUCH)
            if len(buffer) < 8 + length:
                break
            count += 1
            newest = buffer[8 : 8 + length]
            buffer = buffer[8 + length :]
