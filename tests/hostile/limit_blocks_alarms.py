# Blocks all signals and sleeps.
# Must: x stopped
# Seconds: 2
# %%
import signal, time
signal.pthread_sigmask(signal.SIG_BLOCK, range(1, 65))
time.sleep(1000)
x = 1
