"""Landlock, by its three system calls: which files a process may reach, whoever it runs as."""

import ctypes
import os
import struct

CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446
ASK_VERSION = 1
BENEATH = 1
READ_FILE, READ_DIR, WRITE_FILE = 1 << 2, 1 << 3, 1 << 1
MAKE_CHAR, MAKE_SOCKET, MAKE_FIFO, MAKE_BLOCK, MAKE_LINK = 1 << 6, 1 << 9, 1 << 10, 1 << 11, 1 << 12
EXECUTE = 1 << 0
NEVER = EXECUTE | MAKE_CHAR | MAKE_SOCKET | MAKE_FIFO | MAKE_BLOCK | MAKE_LINK
OF_FILES = EXECUTE | WRITE_FILE | READ_FILE | 1 << 14  # and truncate; all others are of folders
RIGHTS = {1: (1 << 13) - 1, 2: (1 << 14) - 1, 3: (1 << 15) - 1, 5: (1 << 16) - 1}
"""What a version of the kernel's interface can forbid; later ones can all that earlier ones can."""
NETWORK = 3  # binding and connecting by TCP, from version 4 on
SCOPES = 3  # abstract sockets and signals, from version 6 on
SYSTEM = ctypes.CDLL(None, use_errno=True)


def version():
    """The version of the kernel's interface; 0 where there is none or it is switched off."""
    found = SYSTEM.syscall(CREATE_RULESET, None, ctypes.c_size_t(0), ASK_VERSION)
    return max(found, 0)


def ruleset(readable, writable, devices):
    """A descriptor of rules: trees to read, trees to read and write, single files for both.

    Everything else is forbidden, and so are new programs, links, sockets and pipes in folders.
    """
    known = version()
    rights = RIGHTS[max(old for old in RIGHTS if old <= known)]
    fields, size = [rights], 8
    if known >= 4:
        fields, size = [rights, NETWORK], 16
    if known >= 6:
        fields, size = [rights, NETWORK, SCOPES], 24
    attributes = struct.pack(f"{len(fields)}Q", *fields)
    rules = _call(CREATE_RULESET, attributes, ctypes.c_size_t(size), 0)

    for path in readable:
        _allow(rules, path, READ_FILE | READ_DIR)
    for path in writable:
        _allow(rules, path, rights & ~NEVER)
    for path in devices:
        _allow(rules, path, READ_FILE | WRITE_FILE)
    return rules


def restrict(rules):
    """Holds the process to the rules for the rest of its life."""
    _call(RESTRICT_SELF, rules, 0)
    os.close(rules)


def _allow(rules, path, rights):
    handle = os.open(path, os.O_PATH | os.O_CLOEXEC)
    try:
        if not os.path.isdir(path):
            rights &= OF_FILES
        _call(ADD_RULE, rules, BENEATH, struct.pack("=Qi", rights, handle), 0)
    finally:
        os.close(handle)


def _call(number, *arguments):
    found = SYSTEM.syscall(number, *arguments)
    if found < 0:
        code = ctypes.get_errno()
        raise OSError(code, f"Landlock: {os.strerror(code)}")
    return found
