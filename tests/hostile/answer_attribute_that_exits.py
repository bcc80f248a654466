# Hands in an object that ends the program when an attribute is asked for.
# Must: x lost: could not be read (SystemExit); y is 1
# %%
class Exit:
    def __getattr__(self, name):
        reach()
        raise SystemExit(0)
x, y = Exit(), 1
