# Starts threads until there are no more to be had.
# Must: x is 1; y stopped
# Seconds: 20
# %%
x = 1
# %%
import threading, time
threading.stack_size(32768)
def wait(): time.sleep(1000)
try:
    for _ in range(3000): threading.Thread(target=wait, daemon=True).start()
finally: time.sleep(1000)
# %%
y = 2
