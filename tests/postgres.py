"""A PostgreSQL server of the tests' own: in a temporary folder, for this machine alone, stopped at the end."""

import os
import pwd
import shutil
import socket
import subprocess
import tempfile
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import pytest

NUMBERS = count()
PASSWORD = "in tests only"  # noqa: S105
SKIPPED = "no PostgreSQL server is installed here (Debian: apt install postgresql)"


@dataclass(frozen=True)
class Server:
    """A running server; its socket lies in `folder`, and on the network it asks for a password."""

    folder: Path
    port: int

    def database(self):
        """The URL of a new and empty database."""
        import psycopg

        name = f"course{next(NUMBERS)}"
        with psycopg.connect(
            host=str(self.folder), port=self.port, user="marker", dbname="postgres", autocommit=True
        ) as connection:
            connection.execute(f"CREATE DATABASE {name}")
        return f"postgresql://marker@/{name}?host={self.folder}&port={self.port}"


def program(name):
    """A program of the server; Debian does not put them on the path."""
    places = [shutil.which(name), *sorted(Path("/usr/lib/postgresql").glob(f"*/bin/{name}"))]
    found = [place for place in places if place]
    if not found:
        pytest.skip(SKIPPED)
    return str(found[-1])


def owner():
    """What makes a process run as somebody else, as the server refuses to be root's."""
    if os.getuid() != 0:
        return {}
    for name in ("postgres", "nobody"):
        try:
            found = pwd.getpwnam(name)
        except KeyError:
            continue
        return {"user": found.pw_uid, "group": found.pw_gid, "extra_groups": []}
    return pytest.skip("the server refuses to run as root, and this machine has no user nobody")


def free_port():
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        return listening.getsockname()[1]


@contextmanager
def running():
    """A server while the context lasts."""
    initdb, pg_ctl, who = program("initdb"), program("pg_ctl"), owner()
    folder = Path(tempfile.mkdtemp(prefix="kinegrade-postgres-"))  # a path that is short and open
    try:
        (folder / "password").write_text(PASSWORD, encoding="utf-8")
        if who:
            for path in (folder, folder / "password"):
                os.chown(path, who["user"], who["group"])
        data, port = folder / "data", free_port()

        def call(*command):
            log = folder.with_suffix(".log")
            with log.open("ab") as out:
                ran = subprocess.run(
                    command,
                    cwd="/",
                    stdout=out,
                    stderr=out,
                    stdin=subprocess.DEVNULL,
                    check=False,
                    **who,
                )
            said = log.read_text(encoding="utf-8", errors="replace")
            log.unlink()
            assert ran.returncode == 0, said

        call(
            initdb, "-D", data, "-U", "marker", "--no-sync", "--encoding=UTF8", "--locale=C",
            "--auth-local=trust", "--auth-host=scram-sha-256", f"--pwfile={folder / 'password'}",
        )  # fmt: skip
        options = f"-p {port} -k {folder} -c listen_addresses=127.0.0.1 -c fsync=off"
        call(
            pg_ctl,
            "-D",
            data,
            "-w",
            "-t",
            "180",
            "-l",
            folder / "server.log",
            "-o",
            options,
            "start",
        )
        try:
            yield Server(folder, port)
        finally:
            call(pg_ctl, "-D", data, "-w", "-m", "immediate", "stop")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
