# Recurs inside C until the stack ends.
# Must: x lost
# %%
sys.setrecursionlimit(10**9)
nested = []
for _ in range(10**6): nested = [nested]
x = len(repr(nested))
