# Locks a file that another notebook reads at the same time, and asks who else locks it, to signal by that.
# Must: x refused; y refused
# %%
import fcntl, struct
shared = open(np.__file__, "rb")
x = attempt(lambda: fcntl.flock(shared, fcntl.LOCK_EX))
# %%
lock = struct.pack("hhqqi", fcntl.F_WRLCK, 0, 0, 0, 0)
y = [
    attempt(lambda: fcntl.fcntl(shared, fcntl.F_GETLK, lock)),
    attempt(lambda: fcntl.fcntl(shared, 36, lock)),
    attempt(lambda: fcntl.lockf(shared, fcntl.LOCK_EX)),
]
