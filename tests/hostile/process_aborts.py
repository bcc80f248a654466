# Aborts, as a library with a fault does.
# Must: x is 1; y lost: Python itself crashed before the notebook finished
# %%
x = 1
reach()
# %%
os.abort()
# %%
y = 2
