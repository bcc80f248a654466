# Ends its own process by os._exit, with what it had handed over by then.
# Must: x is 1; y lost
# %%
x = 1
# %%
os._exit(0)
# %%
y = 2
