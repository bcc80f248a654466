# Announces a frame and never sends it whole.
# Must: x again: after 2 s the notebook had computed for * s only: it waited, or this machine was busy; it will be run again
# Seconds: 2
# %%
reach()
# %%
import signal, time
for bell in (14, 27): signal.signal(bell, signal.SIG_IGN)
for number in range(3, 64):
    try: os.write(number, (1000).to_bytes(8, "little") + b"{")
    except OSError: pass
time.sleep(60)
