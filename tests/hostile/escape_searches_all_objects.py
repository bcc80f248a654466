# Searches everything that the garbage collector knows for answers, a secret, or records.
# Must: x is 0; y is 0
# %%
import gc
words = ("reference", "expected", "gradebook", "secret for tests")
x = 0
for found in gc.get_objects():
    if type(found) is dict and set(found) != set(globals()):
        x += sum(type(v) is str and words[3] in v for v in list(found.values()))
reach()
y = sum("kinegrade" in name or "sqlalchemy" in name for name in sys.modules)
