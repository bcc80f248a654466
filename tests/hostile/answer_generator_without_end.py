# Hands in a generator that gives numbers for ever.
# Must: x lost: not a matrix of numbers: a value of type generator (TypeError); y is 1
# %%
import itertools
reach()
x, y = (float(i) for i in itertools.count()), 1
