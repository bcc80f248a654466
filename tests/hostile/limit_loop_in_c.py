# Computes for ever inside one call, where no alarm is heard.
# Must: x lost: the notebook was stopped after 3 s
# Seconds: 3
# %%
reach()
# %%
import itertools
x = all(itertools.repeat(True))
