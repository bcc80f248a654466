# Makes files until there are no more to be had.
# Must: x lost: the notebook wrote more files than a sheet asks for
# Seconds: 30
# %%
reach()
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
