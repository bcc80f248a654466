# Calls clone with flags of a process, of a thread with a namespace, and of one that shares all but its number.
# Must: x refused
# %%
x = [attempt(lambda: call("clone", ctypes.c_ulong(flags), 0, 0, 0, 0)) for flags in (17, 0, 0x100, 0x3D0F00 | 0x10000000, 0x4111, 0x8000)]
