# Hands in an object that ends the process by os._exit when it is read.
# Must: x lost; y lost
# %%
class End:
    @property
    def free_symbols(self): os._exit(0)
x, y = End(), 1
