# Searches by a regular expression that takes for ever.
# Must: x stopped; y is 2
# %%
import re
x = re.match(r"(a+)+$", "a" * 60 + "b")
# %%
y = 2
