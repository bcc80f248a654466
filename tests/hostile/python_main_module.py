# Replaces the module that cells run in, and the list of modules.
# Must: y lost: could not be read (AttributeError); reached lost: could not be read (AttributeError)
# %%
import types
y = 1
# %%
reach()
sys.modules["__main__"] = types.ModuleType("other")
sys.modules.clear()
