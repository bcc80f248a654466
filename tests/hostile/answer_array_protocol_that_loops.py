# Hands in an object that never stops giving an array.
# Must: x lost; y is 1
# %%
class Endless:
    def __array__(self, dtype=None, copy=None):
        while True: pass
x, y = Endless(), 1
