# Hands in a short program for a formula of 2**60 terms, each step twice the one before.
# Must: x stopped; y is 1
# %%
import sympy
y, x = 1, sympy.Symbol("a")
for i in range(60): x = sympy.Add(sympy.sin(x), sympy.cos(x), evaluate=False)
