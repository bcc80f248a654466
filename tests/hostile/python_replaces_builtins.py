# Replaces open, len, isinstance, type, print and getattr for everybody in its process.
# Must: y is 1
# %%
import builtins
y = 1
reach()
# %%
for name in ("open", "len", "isinstance", "type", "print", "getattr", "hasattr", "sum", "dict", "list", "max"):
    setattr(builtins, name, lambda *a, **k: 1)
