# Becomes dumpable, outlives its parent, adopts orphans, and takes capabilities by prctl.
# Must: x refused
# %%
x = [attempt(lambda: call("prctl", option, value, 0, 0, 0)) for option, value in ((4, 1), (1, 0), (36, 1), (47, 2), (8, 1))]
