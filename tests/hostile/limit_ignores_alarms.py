# Ignores every signal that can be ignored, and loops.
# Must: x stopped
# Seconds: 2
# %%
import signal
for bell in range(1, 65):
    try: signal.signal(bell, signal.SIG_IGN)
    except (OSError, ValueError): pass
while True: pass
x = 1
