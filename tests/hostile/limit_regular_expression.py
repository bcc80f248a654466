# Searches by a regular expression that takes for ever.
# Must: x lost: cell 2 ran longer than 1 s and was stopped; y is 2
# %%
import re
reach()
x = re.match(r"(a+)+$", "a" * 60 + "b")
# %%
y = 2
