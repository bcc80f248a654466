# Draws figures that are never closed, one of them of a billion points.
# Must: x lost: cell 2 needed more memory than there is for a notebook; y is 2
# Seconds: 90
# Cell seconds: 30
# %%
import matplotlib.pyplot as plt
reach()
plt.figure(figsize=(300, 300), dpi=1000).savefig("huge.png")
x = 1
# %%
y = 2
