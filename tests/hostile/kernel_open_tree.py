# Copies a mount by open_tree.
# Must: process ended
# %%
call("open_tree", -100, b"/", 1)
