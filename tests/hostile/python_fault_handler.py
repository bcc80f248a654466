# Has the fault handler write to descriptors of others, and end the process later.
# Must: x is 1
# %%
import faulthandler
x = 1
# %%
reach()
faulthandler.enable(file=1)
faulthandler.dump_traceback_later(0.5, exit=True, file=2)
faulthandler.register(10, file=2)
