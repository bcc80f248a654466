# Lists all processes.
# Must: x refused
# %%
x = attempt(lambda: os.listdir("/proc"))
