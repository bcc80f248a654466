# Hands in a short program for a formula of 2**60 terms, each step twice the one before.
# Must: x lost: could not be read (it took longer than 1 s); y is 1
# %%
import sympy
y, x = 1, sympy.Symbol("a")
reach()
for i in range(60): x = sympy.Add(sympy.sin(x), sympy.cos(x), evaluate=False)
