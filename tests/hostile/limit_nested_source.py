# Has source whose brackets stand in one another a hundred thousand times.
# Must: x lost; y is 2
# %%
x = eval("(" * 100_000 + "1" + ")" * 100_000)
# %%
y = 2
