# Puts itself before all imports, and breaks the import statement.
# Must: y is 1
# %%
import builtins
y = 1
# %%
class Finder:
    def find_spec(self, *a): raise RuntimeError
sys.meta_path.insert(0, Finder())
sys.path[:] = []
reach()
builtins.__import__ = None
