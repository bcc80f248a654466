# Sets a hundred thousand variables.
# Must: x is 1; y is 2
# %%
for i in range(100_000): globals()[f"v{i}"] = i
reach()
x = 1
# %%
y = 2
