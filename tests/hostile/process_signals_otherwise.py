# Sends signals by tgkill, by a queue, by a pidfd, and by a descriptor that the kernel watches.
# Must: x refused
# %%
import fcntl
one, two = os.pipe()
x = [
    attempt(lambda: call("tgkill", GRADER, GRADER, 9)), attempt(lambda: call("rt_sigqueueinfo", GRADER, 9, bytes(128))),
    attempt(lambda: call("pidfd_send_signal", 3, 9, 0, 0)), attempt(lambda: fcntl.fcntl(one, fcntl.F_SETOWN, GRADER)),
    attempt(lambda: fcntl.fcntl(one, 10, 9)), attempt(lambda: fcntl.ioctl(one, 0x8901, GRADER)),
]
