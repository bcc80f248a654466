# Leaves by sys.exit, quit and a bare SystemExit, which Jupyter survives.
# Must: x is 1; y is 2
# %%
x = 1
reach()
sys.exit(3)
# %%
raise SystemExit
# %%
y = 2
