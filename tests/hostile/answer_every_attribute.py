# Hands in an object that has every attribute, and itself as each.
# Must: x lost: could not be read (TypeError); y is 1
# %%
class Everything:
    def __getattr__(self, name):
        reach()
        return self
    def __call__(self, *a, **k): return self
    def __iter__(self): return iter([self])
x, y = Everything(), 1
