# Loops for ever in one cell; the others are not to suffer.
# Must: x lost: cell 2 ran longer than 1 s and was stopped; y is 2
# %%
reach()
while True: pass
x = 1
# %%
y = 2
