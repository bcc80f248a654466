# Replaces the module that cells run in, and the list of modules.
# Must: y lost
# %%
import types
y = 1
# %%
sys.modules["__main__"] = types.ModuleType("other")
sys.modules.clear()
