"""The life of one student's process, from the fork to its end."""

import json
import os
import signal
import sys
import warnings

from . import alarms
from .confine import confine, die_with_parent, limit
from .marked_run import run
from .reader import DUMPS
from .scratch import fill


def live(request, answers, order, house):
    """Confines itself, runs the notebook of a request and writes frames. Never returns."""
    try:
        die_with_parent(house.pid)
        _silence()
        about, notebook, files = read_request(request)
        os.chdir(house.scratch)
        fill(house.scratch, files)
        settle(order, house)
        run(about, notebook, _writer(answers))
    finally:
        os._exit(0)


def _silence():
    nowhere = os.open(os.devnull, os.O_RDWR)
    for descriptor in range(3):
        os.dup2(nowhere, descriptor)
    os.close(nowhere)


def read_request(descriptor):
    """What is asked, the notebook, and what lies beside it by name, from one file.

    Its first line says how long each of them is.
    """
    with os.fdopen(descriptor, "rb") as file:
        file.seek(0)
        about = json.loads(file.readline())
        notebook = file.read(about["size"])
        files = {name: file.read(size) for name, size in about["beside"]}
    return about, notebook, files


def settle(order, house):
    """Gives up what a notebook has no use for."""
    os.setsid()
    for name in ("SIGINT", "SIGTERM", "SIGPIPE"):
        signal.signal(getattr(signal, name), signal.SIG_DFL)
    random = sys.modules.get("numpy.random")
    if random is not None:
        random.seed()  # else all notebooks draw the same numbers
    sys.path.insert(0, house.scratch)  # as Jupyter does: modules beside the notebook
    alarms.listen()
    warnings.simplefilter("ignore")
    limit(order)
    if house.confined:
        confine(house.rules, house.filter)


def _writer(descriptor):
    """Writes frames: eight bytes of length, then JSON."""
    write_bytes = os.write  # bound here for the same reason as DUMPS

    def write(frame):
        text = DUMPS(frame).encode()
        data = len(text).to_bytes(8, "little") + text
        while data:
            data = data[write_bytes(descriptor, data) :]

    return write
