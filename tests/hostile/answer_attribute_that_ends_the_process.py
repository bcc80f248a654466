# Hands in an object that ends the process by os._exit when it is read.
# Must: x lost: the notebook ended its own process before it finished; y lost: the notebook ended its own process before it finished
# %%
reach()
# %%
class End:
    @property
    def free_symbols(self): os._exit(0)
x, y = End(), 1
