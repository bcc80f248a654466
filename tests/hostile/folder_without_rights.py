# Leaves folders and files that nobody may look into.
# Must: x is 1
# %%
os.umask(0o777)
os.makedirs("a")
os.mkdir("shut", 0)
open("shut file", "w").close()
reach()
x = 1
