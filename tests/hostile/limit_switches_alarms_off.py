# Switches the alarms off and loops.
# Must: x stopped
# Seconds: 2
# %%
import signal
for which in range(3): signal.setitimer(which, 0)
while True: pass
x = 1
