# Has source whose brackets stand in one another a hundred thousand times.
# Must: x lost: cell 2 is not Python: too many nested parentheses (line 1); y is 2
# %%
reach()
x = eval("(" * 100_000 + "1" + ")" * 100_000)
# %%
y = 2
