# Ignores every signal that can be ignored, and loops.
# Must: x lost: the notebook was stopped after 2 s
# Seconds: 2
# %%
reach()
# %%
import signal
for bell in range(1, 65):
    try: signal.signal(bell, signal.SIG_IGN)
    except (OSError, ValueError): pass
while True: pass
x = 1
