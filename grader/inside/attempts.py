"""Whether the walls hold: a process that is confined as a notebook tries what none may do."""

import os
import socket


def leaks(house, outside):
    """What was possible and must not be; empty where all walls hold."""
    found = []
    for name, attempt in (
        ("start processes", _fork),
        ("open sockets", socket.socket),
        (f"read {outside}", lambda: open(outside, "rb").close()),
        ("list the folders around it", lambda: os.listdir("/")),  # Landlock's alone to refuse
        ("write beside its folder", lambda: _write(os.path.dirname(house.scratch))),
        ("write to the packages", lambda: _write(house.packages)),
    ):
        if _succeeds(attempt):
            found.append(name)
    if not _succeeds(lambda: _write(house.scratch)):
        return "a notebook could not write to its own folder"
    return f"a notebook could {' and '.join(found)}" if found else ""


def _succeeds(attempt):
    try:
        attempt()
    except OSError:
        return False
    return True


def _fork():
    if os.fork() == 0:
        os._exit(0)


def _write(folder):
    path = os.path.join(folder, "attempt")
    with open(path, "wb") as file:
        file.write(b"x")
    os.unlink(path)
