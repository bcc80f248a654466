# Seizes the grader as a debugger does.
# Must: process ended
# %%
LIBC.ptrace(0x4206, GRADER, 0, 0)
x = 1
