# Leaves five thousand files.
# Must: x is 1
# Cell seconds: 5
# %%
for i in range(5000): open(f"f{i}", "w").close()
reach()
x = 1
