# Changes modules and constants in place, which the next notebook's process began with.
# Must: x lost: the notebook wrote more than its answers can hold; reached lost: the notebook wrote more than its answers can hold
# %%
reach()
# %%
import builtins, json, math, sympy
np.cross = np.array = np.pi = None
math.pi, json.dumps, sympy.diff = 3, None, None
builtins.float = builtins.len = lambda *a: 7
x = 1
