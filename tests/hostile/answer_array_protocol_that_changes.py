# Hands in an object whose __array__ gives other numbers each time, after a look at who asks.
# Must: x is [1.0]; y is 1
# %%
class Chameleon:
    def __array__(self, dtype=None, copy=None):
        reach()
        who = sys._getframe(1).f_globals
        return np.array([1.0 if "expected" not in who else who["expected"]])
x, y = Chameleon(), 1
