# Hands in a million numbers, and one number seen a billion times.
# Must: x lost: too large: an array of shape (1000000,); y lost: too large: an array of shape (1000, 1000, 1000)
# %%
reach()
x = np.arange(1e6)
y = np.broadcast_to(1.0, (1000, 1000, 1000))
