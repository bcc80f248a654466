# Hands in a generator that gives numbers for ever.
# Must: x lost; y is 1
# %%
import itertools
x, y = (float(i) for i in itertools.count()), 1
