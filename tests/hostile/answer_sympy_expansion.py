# Hands in a formula whose text is without end: a power of a sum.
# Must: x stopped; y is 1
# %%
import sympy
y = 1
x = 0
del x
# %%
x = sympy.expand((sum(sympy.symbols("a:40")) + 1) ** 60)
