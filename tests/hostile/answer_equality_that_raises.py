# Hands in a dict, a list and a number whose comparisons raise.
# Must: x lost; y is [1.0]
# %%
class Angry:
    def __eq__(self, other): raise RuntimeError
    __lt__ = __gt__ = __ne__ = __bool__ = __len__ = __hash__ = __eq__
class Number(float):
    __eq__ = __lt__ = __gt__ = __ne__ = __bool__ = Angry.__eq__
    __hash__ = float.__hash__
x, y = Angry(), [Number(1)]
