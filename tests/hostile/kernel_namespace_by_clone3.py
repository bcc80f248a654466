# Makes a process in a user namespace by clone3 and by clone.
# Must: x refused
# %%
flags = (ctypes.c_uint64 * 11)(0x10000000, 0, 0, 0, 17)
x = [
    attempt(lambda: call("clone3", flags, 88)),
    attempt(lambda: call("clone", ctypes.c_ulong(0x10000011), 0, 0, 0, 0)),
]
