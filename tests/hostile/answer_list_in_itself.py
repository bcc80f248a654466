# Hands in a list that holds itself, and one with 100 000 lists in one another.
# Must: x lost: could not be read (RecursionError); y lost: could not be read (RecursionError)
# %%
reach()
x = []
x.append(x)
y = 1.0
for _ in range(100_000): y = [y]
