# Hands in a dict, a list and a number whose comparisons raise.
# Must: x lost: not a matrix of numbers: a value of type Angry (TypeError); y is [1.0]
# %%
class Angry:
    def __eq__(self, other): raise RuntimeError
    __lt__ = __gt__ = __ne__ = __bool__ = __len__ = __hash__ = __eq__
class Number(float):
    __eq__ = __lt__ = __gt__ = __ne__ = __bool__ = Angry.__eq__
    __hash__ = float.__hash__
reach()
x, y = Angry(), [Number(1)]
