# Reads memory that is not there.
# Must: x is 1; y lost: Python itself crashed before the notebook finished
# %%
x = 1
reach()
# %%
ctypes.string_at(0)
# %%
y = 2
