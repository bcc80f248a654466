# Prints without end, to stdout, stderr, and the descriptors below.
# Must: x is 1; y is 2
# %%
for _ in range(20_000):
    print("flood" * 1000)
    sys.stderr.write("flood" * 1000)
    os.write(1, b"flood" * 1000)
    display("flood" * 1000)
reach()
x = 1
# %%
y = 2
