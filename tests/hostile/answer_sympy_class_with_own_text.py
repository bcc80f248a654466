# Hands in a sympy symbol whose text is another formula each time.
# Must: x is 'q1'; y is 1
# %%
import sympy
class Sly(sympy.Symbol):
    said = []
    def __str__(self):
        self.said.append(1)
        return "q1" if len(self.said) % 2 else "__import__('os')"
    __repr__ = _sympystr = __str__
reach()
x, y = "q1", 1
z = Sly("q1")
