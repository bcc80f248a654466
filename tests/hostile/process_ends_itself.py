# Ends its own process by os._exit, with what it had handed over by then.
# Must: x is 1; y lost: the notebook ended its own process before it finished
# %%
x = 1
reach()
# %%
os._exit(0)
# %%
y = 2
