# Hands in an object that ends the program when an attribute is asked for.
# Must: x lost; y is 1
# %%
class Exit:
    def __getattr__(self, name): raise SystemExit(0)
x, y = Exit(), 1
