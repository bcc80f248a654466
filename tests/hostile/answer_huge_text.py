# Hands in a text of fifty million letters.
# Must: x lost: too long: a text of 50000000 characters; 20000 can be read here; y is 1
# %%
reach()
x, y = "q" * 50_000_000, 1
