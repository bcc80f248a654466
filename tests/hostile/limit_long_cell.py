# Has a cell of two hundred thousand lines.
# Must: y is 2
# Seconds: 30
# %%
reach()
exec("a = 1\n" * 200_000)
# %%
y = 2
