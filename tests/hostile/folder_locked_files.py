# Locks files of its own and holds them open to the end.
# Must: x is 1
# %%
import fcntl
held = open("held", "w")
fcntl.lockf(held, fcntl.LOCK_EX)
reach()
x = 1
