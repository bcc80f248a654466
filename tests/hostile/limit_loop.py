# Loops for ever in one cell; the others are not to suffer.
# Must: x stopped; y is 2
# %%
while True: pass
x = 1
# %%
y = 2
