# Switches the alarms off and loops.
# Must: x lost: the notebook was stopped after 2 s
# Seconds: 2
# %%
reach()
# %%
import signal
for which in range(3): signal.setitimer(which, 0)
while True: pass
x = 1
