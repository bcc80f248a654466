# Loads a program into the kernel.
# Must: process ended
# %%
call("bpf", 5, 0, 0)
