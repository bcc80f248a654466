# Recurs without end, with the limit lifted.
# Must: x lost
# %%
sys.setrecursionlimit(100_000)
def deeper(n): return deeper(n + 1) + 1
x = deeper(0)
