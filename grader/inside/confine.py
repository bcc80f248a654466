"""What a process gives up before it runs a notebook: rights, reach and system calls."""

import ctypes
import os
import resource
import signal
import struct

from . import landlock

SET_DEATH_SIGNAL, DROP_CAPABILITY, NO_NEW_PRIVILEGES, SET_SECCOMP = 1, 24, 38, 22
FILTER = 2
CAPABILITIES_VERSION = 0x20080522
MEGABYTE = 1 << 20
MAX_FILES = 64


class _Filter(ctypes.Structure):
    _fields_ = [("length", ctypes.c_ushort), ("code", ctypes.c_void_p)]


def limit(limits):
    """Bounds for the process, which nothing can raise again."""
    seconds = int(limits["notebook_seconds"]) + 1
    bounds = {
        resource.RLIMIT_CPU: seconds,
        resource.RLIMIT_AS: limits["memory_mb"] * MEGABYTE,
        resource.RLIMIT_FSIZE: limits["file_mb"] * MEGABYTE,
        resource.RLIMIT_NOFILE: MAX_FILES,
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_MEMLOCK: 0,
        resource.RLIMIT_MSGQUEUE: 0,
    }
    for what, most in bounds.items():
        resource.setrlimit(what, (most, most))


def confine(rules, code):
    """No capabilities, no new privileges, no files beyond the rules, no calls beyond the filter."""
    for capability in range(64):
        if landlock.SYSTEM.prctl(DROP_CAPABILITY, capability, 0, 0, 0):
            break  # behind the last one, or without the right to drop any
    header = struct.pack("Ii", CAPABILITIES_VERSION, 0)
    _must(landlock.SYSTEM.capset(header, bytes(24)), "capabilities")
    _must(landlock.SYSTEM.prctl(NO_NEW_PRIVILEGES, 1, 0, 0, 0), "no new privileges")
    landlock.restrict(rules)

    buffer = ctypes.create_string_buffer(code, len(code))
    program = _Filter(len(code) // 8, ctypes.addressof(buffer))
    loaded = landlock.SYSTEM.prctl(SET_SECCOMP, FILTER, ctypes.byref(program), 0, 0)
    _must(loaded, "seccomp")


def die_with_parent(parent):
    """No notebook outlives the process that started it."""
    landlock.SYSTEM.prctl(SET_DEATH_SIGNAL, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(0)


def _must(failed, what):
    if failed:
        code = ctypes.get_errno()
        raise OSError(code, f"{what}: {os.strerror(code)}")
