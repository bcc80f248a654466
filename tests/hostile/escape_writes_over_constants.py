# Writes over small integers and numpy's code in its memory by ctypes.
# Must: y is 1
# %%
y = 1
# %%
reach()
target = id(0.5)
ctypes.memset(id(np.float64(3)), 0, 8)
ctypes.c_long.from_address(id(257) + 24).value = 12
LIBC.mprotect(ctypes.c_void_p(ctypes.cast(LIBC.getpid, ctypes.c_void_p).value & ~0xFFF), 4096, 7)
