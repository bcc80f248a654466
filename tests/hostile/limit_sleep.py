# Sleeps for ever in one cell.
# Must: x stopped; y is 2
# %%
import time
time.sleep(10**6)
x = 1
# %%
y = 2
