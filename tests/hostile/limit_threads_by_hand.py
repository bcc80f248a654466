# Starts thousands of threads with small stacks, past Python, and waits with them.
# Must: x is 1; y lost: the notebook started more threads than a sheet asks for
# Seconds: 20
# %%
x = 1
reach()
# %%
import ctypes, time
libc = ctypes.CDLL(None)
attributes = ctypes.create_string_buffer(64)
libc.pthread_attr_init(attributes)
libc.pthread_attr_setstacksize(attributes, ctypes.c_size_t(16384))
thread = ctypes.c_ulong()
for _ in range(3000): libc.pthread_create(ctypes.byref(thread), attributes, libc.sleep, ctypes.c_void_p(1000))
time.sleep(1000)
# %%
y = 2
