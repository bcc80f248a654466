# Hides another number in the imaginary part.
# Must: x is [(1+1e+300j)]; y is 1
# %%
reach()
x, y = np.array([1 + 1e300j]), 1
