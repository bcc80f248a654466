# Hands in numbers that compare with nothing: not a number, and infinity.
# Must: y is 1
# %%
reach()
x, y = [float("nan"), float("inf"), -float("inf")], 1
