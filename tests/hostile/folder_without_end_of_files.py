# Makes files until there are no more to be had.
# Must: x lost
# Seconds: 30
# %%
import time
for bell in (14, 27):
    import signal
    signal.signal(bell, signal.SIG_IGN)
i = 0
while True:
    try: open(f"{i}", "w").close()
    except OSError: break
    i += 1
