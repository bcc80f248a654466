# Sleeps for ever in one cell.
# Must: x lost: cell 2 ran longer than 1 s and was stopped; y is 2
# %%
import time
reach()
time.sleep(10**6)
x = 1
# %%
y = 2
