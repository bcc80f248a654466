# Leaves two thousand folders in one another.
# Must: x is 1
# %%
for _ in range(2000):
    os.mkdir("d")
    os.chdir("d")
reach()
x = 1
