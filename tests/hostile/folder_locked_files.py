# Locks files and holds them open to the end.
# Must: x is 1
# %%
import fcntl
held = open("held", "w")
fcntl.flock(held, fcntl.LOCK_EX)
reach()
x = 1
