# Blocks all signals and sleeps.
# Must: x again: after 2 s the notebook had computed for * s only: it waited, or this machine was busy; it will be run again
# Seconds: 2
# %%
reach()
# %%
import signal, time
signal.pthread_sigmask(signal.SIG_BLOCK, range(1, 65))
time.sleep(1000)
x = 1
