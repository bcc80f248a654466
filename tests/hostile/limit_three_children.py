# Starts three children that take 400 MB each, so that each stays below the limit.
# Must: x refused
# %%
def child():
    if os.fork() == 0:
        held = bytearray(400 << 20)
        os._exit(0)
x = [attempt(child) for _ in range(3)]
