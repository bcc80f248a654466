# Hands in a formula whose text is without end: a power of a sum.
# Must: x lost: cell 3 ran longer than 1 s and was stopped; y is 1
# %%
import sympy
y = 1
x = 0
del x
# %%
reach()
x = sympy.expand((sum(sympy.symbols("a:40")) + 1) ** 60)
