"""The system calls that a notebook may make, as a filter that the kernel loads."""

import errno
import os
from functools import cache
from typing import Any

ALLOWED = """
    read write readv writev pread64 pwrite64 preadv pwritev close close_range fstat newfstatat lstat
    stat statx lseek mmap munmap mremap mprotect madvise msync brk futex
    rt_sigaction rt_sigprocmask rt_sigreturn rt_sigpending rt_sigtimedwait sigaltstack
    getpid getppid gettid getuid geteuid getgid getegid getresuid getresgid getgroups getpgrp
    getpgid getsid getpriority wait4 waitid
    clock_gettime clock_getres clock_nanosleep nanosleep gettimeofday time times getrusage
    sched_yield sched_getaffinity sched_getparam sched_getscheduler getcpu getrandom
    creat access faccessat faccessat2 readlink readlinkat getcwd chdir fchdir getdents64
    dup dup2 dup3 pipe pipe2 poll ppoll select pselect6
    epoll_create epoll_create1 epoll_ctl epoll_wait epoll_pwait epoll_pwait2 eventfd2
    recvfrom shutdown getsockname getsockopt
    uname sysinfo getrlimit exit exit_group set_robust_list get_robust_list set_tid_address rseq
    restart_syscall unlink unlinkat mkdir mkdirat rename renameat renameat2 rmdir ftruncate
    fallocate fadvise64 fsync fdatasync umask copy_file_range sendfile
    getitimer setitimer alarm membarrier arch_prctl statfs fstatfs
"""
"""Everything else fails with "operation not permitted", as it does for a user without rights."""
FATAL = """
    ptrace process_vm_readv process_vm_writev bpf perf_event_open userfaultfd
    io_uring_setup io_uring_enter io_uring_register keyctl add_key request_key
    kexec_load init_module finit_module delete_module mount umount2 pivot_root unshare setns
    move_mount open_tree fsopen fsconfig fsmount fspick mount_setattr open_by_handle_at
"""
"""Nobody calls these by accident: the process is stopped."""
NEW_THREAD = (0x3D0F00, 0x7D0F00)
"""The flags of pthread_create of two C libraries, and of nothing that makes a process."""
OF_DESCRIPTORS = (*range(5), 6, 7, 37, 38, 1030, 1032)
"""What fcntl may do: copies, flags, locks; not have the kernel send a signal to somebody else.

Nor ask who holds a lock: one on a file that all read would be seen by another notebook.
"""
NOT_THERE = ("clone3", "flock")
"""As in a kernel without them: the C library falls back to clone, HDF5 does without locks."""
TRUNCATE, FOR_WRITING = 0x200, 3
"""To open a file for reading and empty it on the way is nothing that older Landlocks forbid."""
QUESTIONS = (0x5401, 0x541B, 0x5421, 0x5451)  # a terminal? how much? do not wait; close on exec
UNKNOWN = -1  # what libseccomp says of a name
UNIX = 1  # the family of sockets that stay inside


class NoFilterError(RuntimeError):
    """No filter can be made here, with a sentence that says why."""


@cache
def filter_code() -> bytes:
    """The filter for this machine's processor.

    Raises:
        NoFilterError: libseccomp is not there.
    """
    try:
        import pyseccomp as seccomp  # pyright: ignore[reportMissingTypeStubs]
    except (ImportError, RuntimeError, OSError) as error:
        raise NoFilterError(f"libseccomp is missing ({error})") from error

    made = seccomp.SyscallFilter(seccomp.ERRNO(errno.EPERM))
    for action, names in ((seccomp.ALLOW, ALLOWED.split()), (seccomp.KILL_PROCESS, FATAL.split())):
        for name in names:
            _add(seccomp, made, action, name)
    for number in QUESTIONS:
        _add(seccomp, made, seccomp.ALLOW, "ioctl", (1, number))
    _add(seccomp, made, seccomp.ALLOW, "prlimit64", (2, 0))  # asks, sets nothing
    _add(seccomp, made, seccomp.ALLOW, "socketpair", (0, UNIX))  # wakes an event loop
    _add(seccomp, made, seccomp.ALLOW, "sendto", (4, 0))  # to the other end, nowhere else
    for flags in NEW_THREAD:
        _add(seccomp, made, seccomp.ALLOW, "clone", (0, flags))
    for number in OF_DESCRIPTORS:
        _add(seccomp, made, seccomp.ALLOW, "fcntl", (1, number))
    for name, place in (("open", 1), ("openat", 2)):
        _add(seccomp, made, seccomp.ALLOW, name, (place, 0), mask=TRUNCATE)
        for access in (1, 2):
            wanted = (place, TRUNCATE | access)
            _add(seccomp, made, seccomp.ALLOW, name, wanted, mask=TRUNCATE | FOR_WRITING)
    for name in NOT_THERE:
        _add(seccomp, made, seccomp.ERRNO(errno.ENOSYS), name)
    return _exported(made)


def _add(
    seccomp: Any, made: Any, action: int, name: str, *arguments: tuple[int, int], mask: int = 0
) -> None:
    """One rule, for some values of arguments, or of those bits of them that `mask` has.

    A call that this library does not know yet, or this processor has not, needs none.

    Raises:
        NoFilterError: the library refuses it.
    """
    if seccomp.resolve_syscall(seccomp.system_arch(), name) == UNKNOWN:
        return
    wanted: list[Any] = []
    for place, value in arguments:
        if mask:
            wanted.append(seccomp.Arg(place, seccomp.MASKED_EQ, mask, value))
        else:
            wanted.append(seccomp.Arg(place, seccomp.EQ, value))
    try:
        made.add_rule(action, name, *wanted)
    except OSError as error:
        raise NoFilterError(f"libseccomp refuses a rule for {name} ({error})") from error


def _exported(made: Any) -> bytes:
    descriptor = os.memfd_create("filter")
    with os.fdopen(descriptor, "w+b") as file:
        made.export_bpf(file)
        file.seek(0)
        return file.read()
