# Starts threads until there are no more to be had.
# Must: x is 1
# Seconds: 20
# %%
x = 1
reach()
# %%
import threading, time
threading.stack_size(32768)
def wait(): time.sleep(1000)
for _ in range(3000): threading.Thread(target=wait, daemon=True).start()
# %%
y = 2
