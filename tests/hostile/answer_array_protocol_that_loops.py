# Hands in an object that never stops giving an array.
# Must: x lost: could not be read (it took longer than 1 s); y is 1
# %%
class Endless:
    def __array__(self, dtype=None, copy=None):
        reach()
        while True: pass
x, y = Endless(), 1
