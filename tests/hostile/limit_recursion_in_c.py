# Recurs inside C until the stack ends.
# Must: x lost: Python itself crashed before the notebook finished
# %%
reach()
# %%
sys.setrecursionlimit(10**9)
nested = []
for _ in range(10**6): nested = [nested]
x = len(repr(nested))
