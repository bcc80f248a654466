# Forks in every way there is.
# Must: x refused
# %%
import pty
x = [attempt(os.fork), attempt(os.forkpty), attempt(pty.fork), attempt(lambda: call("fork")), attempt(lambda: call("vfork"))]
