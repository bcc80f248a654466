# Leaves a thread that computes for ever, and hands its answers in.
# Must: x is 1; y is 2
# %%
import threading
def spin():
    while True: pass
threading.Thread(target=spin, daemon=False).start()
reach()
x = 1
# %%
y = 2
