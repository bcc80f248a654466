# Maps memory by mmap, locks it, and asks the C library for more.
# Must: x refused; y is 0
# %%
import mmap
x = [attempt(lambda: mmap.mmap(-1, 1 << 34)), attempt(lambda: call("mlockall", 3))]
LIBC.malloc.restype = ctypes.c_void_p
y = LIBC.malloc(ctypes.c_size_t(1 << 34)) or 0
