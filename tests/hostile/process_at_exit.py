# Registers what to do at the end: a loop, a file in the course, and a thread.
# Must: x is 1
# %%
import atexit, threading
def last():
    open(f"{COURSE}/{MARK}", "w")
    while True: pass
atexit.register(last)
threading._register_atexit(last)
reach()
x = 1
