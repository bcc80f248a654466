# Recurs without end, with the limit lifted.
# Must: x lost: cell 2 stopped with RecursionError: maximum recursion depth exceeded
# %%
sys.setrecursionlimit(100_000)
def deeper(n): return deeper(n + 1) + 1
reach()
x = deeper(0)
