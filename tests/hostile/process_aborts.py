# Aborts, as a library with a fault does.
# Must: x is 1; y lost
# %%
x = 1
# %%
os.abort()
# %%
y = 2
