# Opens the secret by O_PATH and openat2, and then again by its descriptor.
# Must: x refused
# %%
def by_descriptor():
    found = os.open(f"{COURSE}/secret", os.O_PATH)
    return os.open(f"/proc/self/fd/{found}", os.O_RDONLY)
how = (ctypes.c_uint64 * 3)(0, 0, 0)
x = [attempt(by_descriptor), attempt(lambda: call("openat2", -100, f"{COURSE}/secret".encode(), how, 24))]
