# Warns without end.
# Must: x is 1
# %%
import warnings, logging
warnings.simplefilter("always")
for i in range(3000): warnings.warn(f"flood {i}")
for i in range(3000): logging.error("flood")
reach()
x = 1
