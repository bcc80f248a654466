# Attaches to its parent as a debugger does.
# Must: process ended
# %%
LIBC.ptrace(16, os.getppid(), 0, 0)
x = 1
