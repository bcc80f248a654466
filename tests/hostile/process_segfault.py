# Reads memory that is not there.
# Must: x is 1; y lost
# %%
x = 1
# %%
ctypes.string_at(0)
# %%
y = 2
